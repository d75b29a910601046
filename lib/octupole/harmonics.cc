#include "octupole/harmonics.h"

#include <cmath>

namespace octupole {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

template <>
Octupole EvaluateBasis<3>(const Eigen::Vector3d& direction) {
  static const double k3 = std::sqrt(35 / (32 * kPi));
  static const double k2 = std::sqrt(105 / (16 * kPi));
  static const double k1 = std::sqrt(21 / (32 * kPi));
  static const double k0 = std::sqrt(7 / (16 * kPi));
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const double xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  Octupole basis;
  basis << k3 * y * (3 * xx - yy),  //
      k2 * 2 * x * y * z,           //
      k1 * y * (5 * zz - rr),       //
      k0 * z * (5 * zz - 3 * rr),   //
      k1 * x * (5 * zz - rr),       //
      k2 * z * (xx - yy),           //
      k3 * x * (xx - 3 * yy);
  return basis;
}

template <>
Hexadecapole EvaluateBasis<4>(const Eigen::Vector3d& direction) {
  static const double k4 = 3. / 16 * std::sqrt(35 / kPi);
  static const double k3 = 3. / 4 * std::sqrt(35 / (2 * kPi));
  static const double k2 = 3. / 8 * std::sqrt(5 / kPi);
  static const double k1 = 3. / 4 * std::sqrt(5 / (2 * kPi));
  static const double k0 = 3. / 16 * std::sqrt(1 / kPi);
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const double xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  Hexadecapole basis;
  basis << k4 * 4 * x * y * (xx - yy),               //
      k3 * y * z * (3 * xx - yy),                    //
      k2 * 2 * x * y * (7 * zz - rr),                //
      k1 * y * z * (7 * zz - 3 * rr),                //
      k0 * ((35 * zz - 30 * rr) * zz + 3 * rr * rr), //
      k1 * x * z * (7 * zz - 3 * rr),                //
      k2 * (xx - yy) * (7 * zz - rr),                //
      k3 * x * z * (xx - 3 * yy),                    //
      k4 * (xx * (xx - 3 * yy) - yy * (3 * xx - yy));
  return basis;
}

template <>
Octupole ReferenceHarmonic<3>() {
  return Octupole::Unit(1);
}

template <>
Hexadecapole ReferenceHarmonic<4>() {
  return std::sqrt(7. / 12) * Hexadecapole::Unit(4) + std::sqrt(5. / 12) * Hexadecapole::Unit(8);
}

}  // namespace octupole
