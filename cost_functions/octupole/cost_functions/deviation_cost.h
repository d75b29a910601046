#pragma once

#include <ceres/autodiff_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/quadrics.h"

namespace octupole {

/// Draws a harmonic to octahedral symmetry: the root of the deviation d(a) as a smooth vector (theory.md, section 2),
///
///   r_k = sqrt(weight) a^T N_k a,  k = 1..5,   |r|^2 = weight d(a).
///
/// Parameters: a (kDimension). Residuals: 5, one per quadric, in the order of Quadrics(). Polynomial, without
/// degenerate points. Gauss-Newton sees the exact Hessian where d = 0.
template <int kDegree>
class DeviationCost {
 public:
  explicit DeviationCost(double weight) : root_(RootOfWeight("DeviationCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) {
    return new ceres::AutoDiffCostFunction<DeviationCost, 5, kDimension<kDegree>>(new DeviationCost(weight));
  }

  template <typename T>
  bool operator()(const T* a, T* residuals) const {
    const Eigen::Map<const Eigen::Matrix<T, kDimension<kDegree>, 1>> harmonic(a);
    Eigen::Map<Eigen::Matrix<T, 5, 1>> values(residuals);
    values = T(root_) * QuadricValues<kDegree, T>(harmonic);
    return true;
  }

 private:
  double root_;
};

}  // namespace octupole
