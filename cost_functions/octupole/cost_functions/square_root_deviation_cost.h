#pragma once

#include <ceres/autodiff_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/quadrics.h"

namespace octupole {

/// The paper's scalar form of the deviation (eq. 4.1, second term):
///
///   r = sqrt(weight d(a)),   |r|^2 = weight d(a).
///
/// Parameters: a (kDimension). Residuals: 1. It has no derivative where d = 0, which is where every solve ends: there
/// the Jacobian is set to zero, a subgradient. Gauss-Newton knows only one direction of the three in which d grows; use
/// DeviationCost unless you mean to compare with the paper.
template <int kDegree>
class SquareRootDeviationCost {
 public:
  explicit SquareRootDeviationCost(double weight) : root_(RootOfWeight("SquareRootDeviationCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) {
    return new ceres::AutoDiffCostFunction<SquareRootDeviationCost, 1, kDimension<kDegree>>(
        new SquareRootDeviationCost(weight));
  }

  template <typename T>
  bool operator()(const T* a, T* residual) const {
    using std::sqrt;
    const Eigen::Map<const Eigen::Matrix<T, kDimension<kDegree>, 1>> harmonic(a);
    const T deviation = QuadricValues<kDegree, T>(harmonic).squaredNorm();
    *residual = deviation > T(0) ? T(root_ * sqrt(deviation)) : T(0);
    return true;
  }

 private:
  double root_;
};

}  // namespace octupole
