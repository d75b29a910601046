#include "octupole/frames/frame.h"

#include <algorithm>

#include "octupole/harmonics/rotation.h"

namespace octupole {

namespace {

// A multiple of the frame's harmonic. Basis functions at a direction d are, as a harmonic, a multiple of the Legendre
// polynomial of d . x. In degree 3, 24 xyz is the sum of the cubes of the four diagonals, each times the product of its
// coordinates' signs, in which what is linear cancels; in degree 4, what is harmonic of x^4 + y^4 + z^4 is a sum over
// the axes.
template <int kDegree>
Harmonic<kDegree> SumOverFrame(const Eigen::Matrix3d& frame) {
  const Eigen::Vector3d a = frame.col(0), b = frame.col(1), c = frame.col(2);
  if constexpr (kDegree == 3) {
    return EvaluateBasis<3>(a + b + c) - EvaluateBasis<3>(a + b - c) - EvaluateBasis<3>(a - b + c) -
           EvaluateBasis<3>(b + c - a);
  } else {
    return EvaluateBasis<4>(a) + EvaluateBasis<4>(b) + EvaluateBasis<4>(c);
  }
}

}  // namespace

template <int kDegree>
Harmonic<kDegree> HarmonicFromFrame(const Eigen::Matrix3d& frame) {
  CheckRotation("HarmonicFromFrame", frame);
  static const double factor = 1 / SumOverFrame<kDegree>(Eigen::Matrix3d::Identity()).norm();
  return factor * SumOverFrame<kDegree>(frame);
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
