#include "octupole/harmonics/axis_rotation.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace octupole {
namespace {

template <int kDegree>
HarmonicMatrix<kDegree> TurnAboutZ(const char* caller, double angle) {
  if (!std::isfinite(angle)) {
    std::ostringstream message;
    message << caller << ": not an angle: " << angle;
    throw std::invalid_argument(message.str());
  }
  constexpr int l = kDegree;
  HarmonicMatrix<l> d = HarmonicMatrix<l>::Identity();
  for (int m = 1; m <= l; ++m) {
    d(l - m, l - m) = d(l + m, l + m) = std::cos(m * angle);
    d(l - m, l + m) = std::sin(m * angle);
    d(l + m, l - m) = -d(l - m, l + m);
  }
  return d;
}

}  // namespace

template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationZ(double angle) {
  return TurnAboutZ<kDegree>("HarmonicRotationZ", angle);
}

template <int kDegree>
const HarmonicMatrix<kDegree>& HarmonicQuarterTurnX() {
  static const HarmonicMatrix<kDegree> turn =
      HarmonicRotation<kDegree>((Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());
  return turn;
}

template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationY(double angle) {
  const HarmonicMatrix<kDegree>& quarter = HarmonicQuarterTurnX<kDegree>();
  return quarter.transpose() * TurnAboutZ<kDegree>("HarmonicRotationY", angle) * quarter;
}

template <int kDegree>
HarmonicMatrix<kDegree> PaperRotationY(double angle) {
  const HarmonicMatrix<kDegree>& quarter = HarmonicQuarterTurnX<kDegree>();
  return quarter * TurnAboutZ<kDegree>("PaperRotationY", angle) * quarter.transpose();
}

template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationX(double angle) {
  // Takes x to z.
  static const HarmonicMatrix<kDegree> quarter = PaperRotationY<kDegree>(M_PI / 2);
  return quarter.transpose() * TurnAboutZ<kDegree>("HarmonicRotationX", angle) * quarter;
}

template HarmonicMatrix<3> HarmonicRotationZ<3>(double);
template HarmonicMatrix<4> HarmonicRotationZ<4>(double);
template const HarmonicMatrix<3>& HarmonicQuarterTurnX<3>();
template const HarmonicMatrix<4>& HarmonicQuarterTurnX<4>();
template HarmonicMatrix<3> HarmonicRotationY<3>(double);
template HarmonicMatrix<4> HarmonicRotationY<4>(double);
template HarmonicMatrix<3> PaperRotationY<3>(double);
template HarmonicMatrix<4> PaperRotationY<4>(double);
template HarmonicMatrix<3> HarmonicRotationX<3>(double);
template HarmonicMatrix<4> HarmonicRotationX<4>(double);

}  // namespace octupole
