#include "octupole/alignment/alignment.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "octupole/harmonics/rotation.h"

namespace octupole {

Alignment Alignment::Axis(const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  // Written so that a NaN fails, too.
  if (!(length > 0 && std::isfinite(length))) {
    std::ostringstream message;
    message << "Alignment::Axis: not a direction: [" << direction.transpose() << "]";
    throw std::invalid_argument(message.str());
  }
  Alignment alignment;
  alignment.kind_ = AlignmentKind::kAxis;
  // Any frame with this third column will do.
  Eigen::Matrix3d frame;
  frame.col(2) = direction / length;
  frame.col(0) = frame.col(2).unitOrthogonal();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  alignment.rotation_ = Eigen::Quaterniond(frame).normalized();
  return alignment;
}

Alignment Alignment::Frame(const Eigen::Matrix3d& axes) {
  CheckRotation("Alignment::Frame", axes);
  Alignment alignment;
  alignment.kind_ = AlignmentKind::kFrame;
  alignment.rotation_ = Eigen::Quaterniond(axes).normalized();
  return alignment;
}

Alignment Alignment::TwoAxes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d u = Axis(a).frame().col(2), v = Axis(b).frame().col(2);
  constexpr double kLargestCosine = 0.0175;
  if (std::abs(u.dot(v)) > kLargestCosine) {
    std::ostringstream message;
    message << "Alignment::TwoAxes: [" << a.transpose() << "] and [" << b.transpose() << "] are at "
            << std::acos(u.dot(v)) * 180 / EIGEN_PI << " degrees";
    throw std::invalid_argument(message.str());
  }
  // Sum and difference of unit vectors are at a right angle.
  const Eigen::Vector3d sum = (u + v).normalized(), difference = (u - v).normalized();
  Eigen::Matrix3d axes;
  axes.col(0) = (sum + difference) / std::sqrt(2.);
  axes.col(1) = (sum - difference) / std::sqrt(2.);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Frame(axes);
}

template <int kDegree>
AlignedSubspace<kDegree>::AlignedSubspace(const Alignment& alignment) {
  if (alignment.kind() == AlignmentKind::kFree) {
    basis = HarmonicMatrix<kDegree>::Identity();
    return;
  }
  const HarmonicMatrix<kDegree> rotation = HarmonicRotation<kDegree>(alignment.frame());
  if (alignment.kind() == AlignmentKind::kFrame) {
    basis = rotation * ReferenceHarmonic<kDegree>();
    return;
  }
  // The part of the reference that turning about z leaves alone is the offset; the rest has order +-m.
  constexpr int m = kDegree == 3 ? 2 : 4;
  basis.resize(Eigen::NoChange, 2);
  basis << rotation.col(kDegree - m), rotation.col(kDegree + m);
  offset = ReferenceHarmonic<kDegree>()[kDegree] * rotation.col(kDegree);
}

template struct AlignedSubspace<3>;
template struct AlignedSubspace<4>;

}  // namespace octupole
