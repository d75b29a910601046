#include "octupole/frames/frame.h"

#include <algorithm>

#include "octupole/harmonics/rotation.h"

namespace octupole {

template <int kDegree>
Harmonic<kDegree> HarmonicFromFrame(const Eigen::Matrix3d& frame) {
  // For the message; HarmonicRotation would name itself.
  CheckRotation("HarmonicFromFrame", frame);
  return HarmonicRotation<kDegree>(frame) * ReferenceHarmonic<kDegree>();
}

double Permanent(const Eigen::Matrix3d& q) {
  return q(0, 0) * (q(1, 1) * q(2, 2) + q(1, 2) * q(2, 1)) + q(0, 1) * (q(1, 0) * q(2, 2) + q(1, 2) * q(2, 0)) +
         q(0, 2) * (q(1, 0) * q(2, 1) + q(1, 1) * q(2, 0));
}

double SumOfFourthPowers(const Eigen::Matrix3d& q) { return q.array().square().square().sum(); }

template <>
double FrameDifference<3>(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const double permanent = Permanent(a.transpose() * b);
  // Not below zero by rounding.
  return std::max(0., 4 * (1 - permanent * permanent));
}

template <>
double FrameDifference<4>(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::max(0., 5. / 3 * (3 - SumOfFourthPowers(a.transpose() * b)));
}

template Octupole HarmonicFromFrame<3>(const Eigen::Matrix3d&);
template Hexadecapole HarmonicFromFrame<4>(const Eigen::Matrix3d&);

}  // namespace octupole
