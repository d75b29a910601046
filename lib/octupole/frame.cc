#include "octupole/frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "octupole/random_rotation.h"
#include "octupole/rotation.h"

namespace octupole {
namespace {

// Rotations spread evenly over the frames, with the harmonics that they give. Neighbours serve to find the local maxima
// of h . harmonic, from which Newton's method is started.
template <int kDegree>
class Covering {
 public:
  static const Covering& Instance() {
    static const Covering covering;
    return covering;
  }

  std::vector<Eigen::Quaterniond> LocalMaxima(const Harmonic<kDegree>& h) const {
    const Eigen::Matrix<double, 1, kSize> values = h.transpose() * harmonics_;
    std::vector<Eigen::Quaterniond> maxima;
    for (int i = 0; i < kSize; ++i) {
      const auto is_lower = [&](int j) { return values[j] <= values[i]; };
      if (std::all_of(neighbours_[i].begin(), neighbours_[i].end(), is_lower)) maxima.push_back(rotations_[i]);
    }
    return maxima;
  }

 private:
  static constexpr int kSize = 96;
  static constexpr int kNumNeighbours = 8;

  // Each point is the candidate farthest from all points before it.
  Covering() {
    constexpr int kNumCandidates = 4000;
    std::mt19937 generator(1);
    std::vector<Eigen::Quaterniond> rotations;
    Eigen::Matrix<double, kDimension<kDegree>, Eigen::Dynamic> harmonics(kDimension<kDegree>, kNumCandidates);
    for (int i = 0; i < kNumCandidates; ++i) {
      rotations.push_back(RandomRotation(&generator));
      harmonics.col(i) = HarmonicFromFrame<kDegree>(rotations.back().toRotationMatrix());
    }
    Eigen::VectorXd nearest = Eigen::VectorXd::Constant(kNumCandidates, -1);
    for (int i = 0; i < kSize; ++i) {
      int farthest = 0;
      nearest.minCoeff(&farthest);
      rotations_[i] = rotations[farthest];
      harmonics_.col(i) = harmonics.col(farthest);
      nearest = nearest.cwiseMax(harmonics.transpose() * harmonics_.col(i));
    }
    for (int i = 0; i < kSize; ++i) {
      const Eigen::Matrix<double, 1, kSize> values = harmonics_.col(i).transpose() * harmonics_;
      std::array<int, kSize> order;
      for (int j = 0; j < kSize; ++j) order[j] = j;
      std::swap(order[0], order[i]);
      std::partial_sort(order.begin() + 1, order.begin() + 1 + kNumNeighbours, order.end(),
                        [&](int j, int k) { return values[j] > values[k]; });
      std::copy_n(order.begin() + 1, kNumNeighbours, neighbours_[i].begin());
    }
  }

  std::array<Eigen::Quaterniond, kSize> rotations_;
  Eigen::Matrix<double, kDimension<kDegree>, kSize> harmonics_;
  std::array<std::array<int, kNumNeighbours>, kSize> neighbours_;
};

// The first and second derivatives of D(exp(w)) reference at w = 0.
template <int kDegree>
struct ReferenceDerivatives {
  static const ReferenceDerivatives& Instance() {
    static const ReferenceDerivatives derivatives;
    return derivatives;
  }

  ReferenceDerivatives() {
    const auto& generators = RotationGenerators<kDegree>();
    const Harmonic<kDegree> reference = ReferenceHarmonic<kDegree>();
    for (int k = 0; k < 3; ++k) {
      first.col(k) = generators[k] * reference;
      for (int l = 0; l < 3; ++l) {
        second.col(3 * k + l) =
            (generators[k] * (generators[l] * reference) + generators[l] * (generators[k] * reference)) / 2;
      }
    }
  }

  Eigen::Matrix<double, kDimension<kDegree>, 3> first;
  Eigen::Matrix<double, kDimension<kDegree>, 9> second;
};

// Climbs h . D(R) reference from a start to a local maximum, for a unit h.
template <int kDegree>
Eigen::Quaterniond Climb(const Harmonic<kDegree>& h, Eigen::Quaterniond rotation) {
  constexpr int kMaxIterations = 40;
  constexpr double kMaxStep = 0.3;
  // Curvatures below this are rounding; the gradient along them is, too.
  constexpr double kMinCurvature = 1e-8;
  const auto& derivatives = ReferenceDerivatives<kDegree>::Instance();
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Harmonic<kDegree> body =
        HarmonicRotation<kDegree>(rotation.toRotationMatrix()).transpose() * h;
    const Eigen::Vector3d gradient = derivatives.first.transpose() * body;
    const Eigen::Matrix<double, 9, 1> second = derivatives.second.transpose() * body;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Eigen::Map<const Eigen::Matrix3d>(second.data()));
    // Dividing by the curvatures' magnitudes makes saddles and minima repel.
    const Eigen::Vector3d curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(kMinCurvature);
    Eigen::Vector3d step =
        eigen.eigenvectors() * (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature);
    const double length = step.norm();
    if (length < 1e-14) break;
    if (length > kMaxStep) step *= kMaxStep / length;
    rotation = (rotation * Eigen::Quaterniond(Eigen::AngleAxisd(step.norm(), step.normalized()))).normalized();
    // Convergence is quadratic: the step after one of 1e-8 is below rounding.
    if (length < 1e-8) break;
  }
  return rotation;
}

}  // namespace

template <int kDegree>
Harmonic<kDegree> HarmonicFromFrame(const Eigen::Matrix3d& frame) {
  return HarmonicRotation<kDegree>(frame) * ReferenceHarmonic<kDegree>();
}

template <int kDegree>
Eigen::Matrix3d NearestFrame(const Harmonic<kDegree>& h) {
  const double norm = h.stableNorm();
  // Written so that a NaN fails, too.
  if (!(norm > 0 && std::isfinite(norm))) {
    std::ostringstream message;
    message << "NearestFrame: no frame is nearest to [" << h.transpose() << "]";
    throw std::invalid_argument(message.str());
  }
  const Harmonic<kDegree> unit = h / norm;
  double best = -std::numeric_limits<double>::infinity();
  Eigen::Matrix3d nearest;
  for (const Eigen::Quaterniond& start : Covering<kDegree>::Instance().LocalMaxima(unit)) {
    const Eigen::Matrix3d frame = Climb<kDegree>(unit, start).toRotationMatrix();
    const double value = unit.dot(HarmonicFromFrame<kDegree>(frame));
    if (value <= best) continue;
    best = value;
    nearest = frame;
  }
  return nearest;
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
template Eigen::Matrix3d NearestFrame<3>(const Octupole&);
template Eigen::Matrix3d NearestFrame<4>(const Hexadecapole&);

}  // namespace octupole
