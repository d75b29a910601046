#include "octupole/harmonics/harmonics.h"

#include <cmath>

namespace octupole {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The factors of the polynomials of order 0, +-1, +-2, ...
const double kOctupoleScales[] = {std::sqrt(7 / (16 * kPi)), std::sqrt(21 / (32 * kPi)), std::sqrt(105 / (16 * kPi)),
                                  std::sqrt(35 / (32 * kPi))};
const double kHexadecapoleScales[] = {3. / 16 * std::sqrt(1 / kPi), 3. / 4 * std::sqrt(5 / (2 * kPi)),
                                      3. / 8 * std::sqrt(5 / kPi), 3. / 4 * std::sqrt(35 / (2 * kPi)),
                                      3. / 16 * std::sqrt(35 / kPi)};

}  // namespace

template <>
Octupole EvaluateBasis<3>(const Eigen::Vector3d& direction) {
  const auto& [k0, k1, k2, k3] = kOctupoleScales;
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
  const auto& [k0, k1, k2, k3, k4] = kHexadecapoleScales;
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const double xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  Hexadecapole basis;
  basis << k4 * 4 * x * y * (xx - yy),                //
      k3 * y * z * (3 * xx - yy),                     //
      k2 * 2 * x * y * (7 * zz - rr),                 //
      k1 * y * z * (7 * zz - 3 * rr),                 //
      k0 * ((35 * zz - 30 * rr) * zz + 3 * rr * rr),  //
      k1 * x * z * (7 * zz - 3 * rr),                 //
      k2 * (xx - yy) * (7 * zz - rr),                 //
      k3 * x * z * (xx - 3 * yy),                     //
      k4 * (xx * (xx - 3 * yy) - yy * (3 * xx - yy));
  return basis;
}

template <>
Eigen::Vector3d EvaluateGradient<3>(const Octupole& h, const Eigen::Vector3d& point) {
  const auto& [k0, k1, k2, k3] = kOctupoleScales;
  const double x = point.x(), y = point.y(), z = point.z();
  const double xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, xz = x * z;
  const double a3 = 3 * k3 * h[0], a2 = 2 * k2 * h[1], a1 = k1 * h[2], c0 = 3 * k0 * h[3], c1 = k1 * h[4],
               c2 = k2 * h[5], c3 = 3 * k3 * h[6];
  return {
      2 * a3 * xy + a2 * yz - 2 * a1 * xy - 2 * c0 * xz + c1 * (4 * zz - 3 * xx - yy) + 2 * c2 * xz + c3 * (xx - yy),
      a3 * (xx - yy) + a2 * xz + a1 * (4 * zz - xx - 3 * yy) - 2 * c0 * yz - 2 * c1 * xy - 2 * c2 * yz - 2 * c3 * xy,
      a2 * xy + 8 * a1 * yz + c0 * (2 * zz - xx - yy) + 8 * c1 * xz + c2 * (xx - yy)};
}

template <>
Eigen::Vector3d EvaluateGradient<4>(const Hexadecapole& h, const Eigen::Vector3d& point) {
  const auto& [k0, k1, k2, k3, k4] = kHexadecapoleScales;
  const double x = point.x(), y = point.y(), z = point.z();
  const double xx = x * x, yy = y * y, zz = z * z, xyz = x * y * z;
  const double a4 = 4 * k4 * h[0], a3 = 3 * k3 * h[1], a2 = 2 * k2 * h[2], a1 = 3 * k1 * h[3], c0 = k0 * h[4],
               c1 = 3 * k1 * h[5], c2 = 4 * k2 * h[6], c3 = 3 * k3 * h[7], c4 = 4 * k4 * h[8];
  return {a4 * y * (3 * xx - yy) + 2 * a3 * xyz + a2 * y * (6 * zz - 3 * xx - yy) - 2 * a1 * xyz +
              12 * c0 * x * (xx + yy - 4 * zz) + c1 * z * (4. / 3 * zz - 3 * xx - yy) + c2 * x * (3 * zz - xx) +
              c3 * z * (xx - yy) + c4 * x * (xx - 3 * yy),
          a4 * x * (xx - 3 * yy) + a3 * z * (xx - yy) + a2 * x * (6 * zz - xx - 3 * yy) +
              a1 * z * (4. / 3 * zz - xx - 3 * yy) + 12 * c0 * y * (xx + yy - 4 * zz) - 2 * c1 * xyz -
              c2 * y * (3 * zz - yy) - 2 * c3 * xyz + c4 * y * (yy - 3 * xx),
          a3 * y * (xx - yy / 3) + 12 * a2 * xyz + a1 * y * (4 * zz - xx - yy) +
              16 * c0 * z * (2 * zz - 3 * xx - 3 * yy) + c1 * x * (4 * zz - xx - yy) + 3 * c2 * z * (xx - yy) +
              c3 * x * (xx / 3 - yy)};
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
