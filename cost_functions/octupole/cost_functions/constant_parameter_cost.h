#pragma once

#include <ceres/autodiff_cost_function.h>

#include <stdexcept>
#include <string>

#include "octupole/cost_functions/cost_weight.h"

namespace octupole {

/// Draws one parameter of a map to be constant on a boundary face, that of the axis along its normal:
///
///   r = sqrt(weight) (a_k - c_k, b_k - c_k),   |r|^2 = weight ((a_k - c_k)^2 + (b_k - c_k)^2).
///
/// Parameters: the parameters of the face's corners a, b, c (3 each). Residuals: 2. Linear.
class ConstantParameterCost {
 public:
  ConstantParameterCost(int axis, double weight) : axis_(axis), root_(RootOfWeight("ConstantParameterCost", weight)) {
    if (axis < 0 || axis > 2) {
      throw std::invalid_argument("ConstantParameterCost: the axis is " + std::to_string(axis) + ", not 0, 1 or 2");
    }
  }

  /// \throw std::invalid_argument when there is no such axis, or `weight` is negative or not finite.
  static ceres::CostFunction* Create(int axis, double weight) {
    return new ceres::AutoDiffCostFunction<ConstantParameterCost, 2, 3, 3, 3>(new ConstantParameterCost(axis, weight));
  }

  template <typename T>
  bool operator()(const T* a, const T* b, const T* c, T* residuals) const {
    residuals[0] = root_ * (a[axis_] - c[axis_]);
    residuals[1] = root_ * (b[axis_] - c[axis_]);
    return true;
  }

 private:
  int axis_;
  double root_;
};

}  // namespace octupole
