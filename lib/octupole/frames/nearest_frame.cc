#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "octupole/frames/frame.h"
#include "octupole/frames/internal/nearest_rotation.h"
#include "octupole/frames/random_rotation.h"
#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

// The square of the reach of the octahedral unit harmonics in the Euclidean metric: 2/3 in degree 3, sqrt(5/12) in
// degree 4 (frame_test.cc computes it). A stationary frame nearer than that is the nearest of all (Federer, Curvature
// measures, 1959, theorem 4.8).
template <int kDegree>
constexpr double kSquaredReach = kDegree == 3 ? 4. / 9 : 5. / 12;

// Rotations spread evenly over the frames, with the harmonics that they give: the starts of Newton's method.
template <int kDegree>
class Covering {
 public:
  static constexpr int kSize = 128;
  using Values = Eigen::Matrix<double, kSize, 1>;

  static const Covering& Instance() {
    static const Covering covering;
    return covering;
  }

  // The products of h with the harmonics of the rotations.
  Values Evaluate(const Harmonic<kDegree>& h) const {
    Values values = h[0] * harmonics_.col(0);
    for (int i = 1; i < kDimension<kDegree>; ++i) values += h[i] * harmonics_.col(i);
    return values;
  }

  bool IsLocalMaximum(const Values& values, int i) const {
    const auto is_lower = [&](int j) { return values[j] <= values[i]; };
    return std::all_of(neighbours_[i].begin(), neighbours_[i].end(), is_lower);
  }

  const Eigen::Quaterniond& rotation(int i) const { return rotations_[i]; }

 private:
  static constexpr int kNumNeighbours = 4;

  // Each point is the candidate farthest from all points before it.
  Covering() {
    constexpr int kNumCandidates = 4000;
    std::mt19937 generator(1);
    std::vector<Eigen::Quaterniond> rotations;
    Eigen::Matrix<double, Eigen::Dynamic, kDimension<kDegree>> harmonics(kNumCandidates, kDimension<kDegree>);
    for (int i = 0; i < kNumCandidates; ++i) {
      rotations.push_back(RandomRotation(&generator));
      harmonics.row(i) = HarmonicFromFrame<kDegree>(rotations.back().toRotationMatrix());
    }
    Eigen::VectorXd nearest = Eigen::VectorXd::Constant(kNumCandidates, -1);
    for (int i = 0; i < kSize; ++i) {
      int farthest = 0;
      nearest.minCoeff(&farthest);
      rotations_[i] = rotations[farthest];
      harmonics_.row(i) = harmonics.row(farthest);
      nearest = nearest.cwiseMax(harmonics * harmonics_.row(i).transpose());
    }
    for (int i = 0; i < kSize; ++i) {
      const Values values = Evaluate(harmonics_.row(i));
      std::array<int, kSize> order;
      for (int j = 0; j < kSize; ++j) order[j] = j;
      std::swap(order[0], order[i]);
      std::partial_sort(order.begin() + 1, order.begin() + 1 + kNumNeighbours, order.end(),
                        [&](int j, int k) { return values[j] > values[k]; });
      std::copy_n(order.begin() + 1, kNumNeighbours, neighbours_[i].begin());
    }
  }

  std::array<Eigen::Quaterniond, kSize> rotations_;
  // One row for each rotation.
  Eigen::Matrix<double, kSize, kDimension<kDegree>> harmonics_;
  std::array<std::array<int, kNumNeighbours>, kSize> neighbours_;
};

// h . D(F exp(w)) reference and its first and second derivatives at w = 0, for a frame F and w in its coordinates.
struct Expansion {
  double value;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
};

// They are linear in the components, in the frame, of the symmetric tensor t of the polynomial f of h, and as t has no
// traces, few components suffice: those that f and its gradient have on the axes (theory.md, section 5).
template <int kDegree>
Eigen::Matrix3d GradientsOnAxes(const Harmonic<kDegree>& h, const Eigen::Matrix3d& frame) {
  Eigen::Matrix3d gradients;
  for (int i = 0; i < 3; ++i) gradients.col(i) = EvaluateGradient<kDegree>(h, frame.col(i));
  return frame.transpose() * gradients / kDegree;
}

// The product is 6 t_123 divided by that of the reference. b_ji = t_iij.
Expansion Expand(const Octupole& h, const Eigen::Matrix3d& frame) {
  static const double scale = std::sqrt(48 * M_PI / 35);
  const Eigen::Matrix3d b = GradientsOnAxes<3>(h, frame);
  const Eigen::Vector3d diagonal = frame.col(1) + frame.col(2);
  const double t_123 = (frame.col(0).dot(EvaluateGradient<3>(h, diagonal)) / 3 - b(0, 1) - b(0, 2)) / 2;
  Expansion expansion;
  expansion.value = scale * t_123;
  expansion.gradient = scale * Eigen::Vector3d(b(0, 2) - b(0, 1), b(1, 0) - b(1, 2), b(2, 1) - b(2, 0));
  expansion.hessian << 8 * t_123, 5 * b(2, 2), 5 * b(1, 1),  //
      5 * b(2, 2), 8 * t_123, 5 * b(0, 0),                   //
      5 * b(1, 1), 5 * b(0, 0), 8 * t_123;
  expansion.hessian *= -scale / 2;
  return expansion;
}

// The product is the sum of the values of f on the axes divided by that of the reference. b_ji = t_iiij.
Expansion Expand(const Hexadecapole& h, const Eigen::Matrix3d& frame) {
  static const double scale = std::sqrt(16 * M_PI / 189);
  const Eigen::Matrix3d b = GradientsOnAxes<4>(h, frame);
  Expansion expansion;
  expansion.value = scale * b.trace();
  expansion.gradient = 4 * scale * Eigen::Vector3d(b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1));
  expansion.hessian = scale * (14 * (b + b.transpose()) - 16 * b.trace() * Eigen::Matrix3d::Identity());
  return expansion;
}

// The lowest eigenvalue of a symmetric matrix (Smith, Eigenvalues of a symmetric 3 x 3 matrix, CACM 4, 1961).
double LowestEigenvalue(const Eigen::Matrix3d& matrix) {
  const double mean = matrix.trace() / 3;
  const Eigen::Matrix3d deviator = matrix - mean * Eigen::Matrix3d::Identity();
  const double spread = deviator.norm() / std::sqrt(6.);
  if (spread == 0) return mean;
  const double cosine = std::clamp(deviator.determinant() / (2 * spread * spread * spread), -1., 1.);
  return mean + 2 * spread * std::cos((std::acos(cosine) + 2 * M_PI) / 3);
}

// The step of Newton's method towards a maximum. Where the curvature is not positive it is shifted until it is: a
// little for a flat direction, along which the gradient is rounding, and beyond the most negative curvature near
// saddles and minima.
Eigen::Vector3d AscentStep(const Eigen::Vector3d& gradient, const Eigen::Matrix3d& hessian) {
  // Of a unit harmonic the curvatures are at most about 7.
  constexpr double kFlat = 1e-7;
  Eigen::Matrix3d curvature = -hessian;
  const double minor = curvature(0, 0) * curvature(1, 1) - curvature(0, 1) * curvature(1, 0);
  const bool is_positive = curvature(0, 0) > 0 && minor > 0 && curvature.determinant() > 10 * kFlat;
  if (!is_positive) curvature.diagonal().array() += 2 * std::max(0., -LowestEigenvalue(curvature)) + kFlat;
  return curvature.inverse() * gradient;
}

struct Maximum {
  Eigen::Quaterniond rotation;
  double value;
};

// Climbs h . D(R) reference from a start to a local maximum, for a unit h.
template <int kDegree>
Maximum Climb(const Harmonic<kDegree>& h, Eigen::Quaterniond rotation) {
  constexpr int kMaxIterations = 40;
  constexpr double kMaxStep = 0.3;
  double value = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Expansion expansion = Expand(h, rotation.toRotationMatrix());
    value = expansion.value;
    Eigen::Vector3d step = AscentStep(expansion.gradient, expansion.hessian);
    const double length = step.norm();
    if (length > kMaxStep) step *= kMaxStep / length;
    // A rotation by the step, to second order.
    rotation = (rotation * Eigen::Quaterniond(1, step[0] / 2, step[1] / 2, step[2] / 2)).normalized();
    // Convergence is quadratic: the step after one of 1e-8 is below rounding.
    if (length < 1e-8) break;
  }
  return {rotation, value};
}

// Whether a maximum is global for certain. The distance to the best on the ray of h is sqrt(1 - value^2).
template <int kDegree>
bool IsWithinReach(const Maximum& maximum) {
  return maximum.value > 0 && 1 - maximum.value * maximum.value < kSquaredReach<kDegree>;
}

}  // namespace

template <int kDegree>
internal::NearestRotation internal::FindNearestRotation(const Harmonic<kDegree>& h) {
  const auto& covering = Covering<kDegree>::Instance();
  const typename Covering<kDegree>::Values values = covering.Evaluate(h);
  int first = 0;
  values.maxCoeff(&first);
  Maximum best = Climb<kDegree>(h, covering.rotation(first));
  int num_climbs = 1;
  for (int i = 0; i < covering.kSize; ++i) {
    if (IsWithinReach<kDegree>(best)) break;
    if (i == first || !covering.IsLocalMaximum(values, i)) continue;
    const Maximum other = Climb<kDegree>(h, covering.rotation(i));
    ++num_climbs;
    if (other.value > best.value) best = other;
  }
  return {best.rotation, num_climbs};
}

namespace {

template <int kDegree>
Harmonic<kDegree> Normalized(const char* caller, const Harmonic<kDegree>& h) {
  const double norm = h.stableNorm();
  // Written so that a NaN fails, too.
  if (norm > 0 && std::isfinite(norm)) return h / norm;
  std::ostringstream message;
  message << caller << ": no frame is nearest to [" << h.transpose() << "]";
  throw std::invalid_argument(message.str());
}

}  // namespace

template <int kDegree>
Eigen::Matrix3d NearestFrame(const Harmonic<kDegree>& h) {
  return internal::FindNearestRotation<kDegree>(Normalized<kDegree>("NearestFrame", h)).rotation.toRotationMatrix();
}

template <int kDegree>
Eigen::Matrix3d NearestFrame(const Harmonic<kDegree>& h, const Eigen::Matrix3d& guess) {
  const Harmonic<kDegree> unit = Normalized<kDegree>("NearestFrame", h);
  const Maximum near = Climb<kDegree>(unit, Eigen::Quaterniond(guess));
  if (IsWithinReach<kDegree>(near)) return near.rotation.toRotationMatrix();
  return internal::FindNearestRotation<kDegree>(unit).rotation.toRotationMatrix();
}

template <int kDegree>
double DistanceToFrames(const Harmonic<kDegree>& h) {
  const Eigen::Quaterniond nearest =
      internal::FindNearestRotation<kDegree>(Normalized<kDegree>("DistanceToFrames", h)).rotation;
  return (h - HarmonicFromFrame<kDegree>(nearest.toRotationMatrix())).norm();
}

template internal::NearestRotation internal::FindNearestRotation<3>(const Octupole&);
template internal::NearestRotation internal::FindNearestRotation<4>(const Hexadecapole&);
template Eigen::Matrix3d NearestFrame<3>(const Octupole&);
template Eigen::Matrix3d NearestFrame<4>(const Hexadecapole&);
template Eigen::Matrix3d NearestFrame<3>(const Octupole&, const Eigen::Matrix3d&);
template Eigen::Matrix3d NearestFrame<4>(const Hexadecapole&, const Eigen::Matrix3d&);
template double DistanceToFrames<3>(const Octupole&);
template double DistanceToFrames<4>(const Hexadecapole&);

}  // namespace octupole
