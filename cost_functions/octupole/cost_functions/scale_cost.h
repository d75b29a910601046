#pragma once

#include <ceres/autodiff_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// Keeps a harmonic on the unit sphere (paper, eq. 4.1, first term):
///
///   r = sqrt(weight) (|a|^2 - 1),   |r|^2 = weight (|a|^2 - 1)^2.
///
/// Parameters: a (kDimension). Residuals: 1. Polynomial, without degenerate points; its gradient vanishes at a = 0,
/// which is a maximum.
template <int kDegree>
class ScaleCost {
 public:
  explicit ScaleCost(double weight) : root_(RootOfWeight("ScaleCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) {
    return new ceres::AutoDiffCostFunction<ScaleCost, 1, kDimension<kDegree>>(new ScaleCost(weight));
  }

  template <typename T>
  bool operator()(const T* a, T* residual) const {
    T squared_norm(0);
    for (int i = 0; i < kDimension<kDegree>; ++i) squared_norm += a[i] * a[i];
    *residual = root_ * (squared_norm - 1.);
    return true;
  }

 private:
  double root_;
};

}  // namespace octupole
