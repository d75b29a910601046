#pragma once

#include <ceres/autodiff_cost_function.h>

#include <cmath>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// The smoothness term of an edge, between the harmonics a and b at its ends.
///
/// Parameters: a (kDimension), b (kDimension). Residuals: kDimension.
///
/// Degree 3 (paper, eq. 5.1; theory.md, section 3): with s = a . b,
///
///   r = sqrt(weight) |a + b| (a - b)   where s >= 0,
///   r = sqrt(weight) |a - b| (a + b)   where s < 0,
///
/// so that |r|^2 = weight |a - b|^2 |a + b|^2, which does not see the signs of a and b. The vector r changes form at
/// s = 0, its squared norm and their gradient do not. At a = b = 0 the root has no derivative but r has: zero.
///
/// Degree 4: r = sqrt(weight) (a - b).
template <int kDegree>
class SmoothnessCost;

template <>
class SmoothnessCost<3> {
 public:
  explicit SmoothnessCost(double weight) : root_(RootOfWeight("SmoothnessCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) {
    return new ceres::AutoDiffCostFunction<SmoothnessCost, 7, 7, 7>(new SmoothnessCost(weight));
  }

  template <typename T>
  bool operator()(const T* a, const T* b, T* residuals) const {
    using std::sqrt;
    T dot(0);
    T squared_norms(0);
    for (int i = 0; i < 7; ++i) {
      dot += a[i] * b[i];
      squared_norms += a[i] * a[i] + b[i] * b[i];
    }
    const double sign = dot >= T(0) ? 1 : -1;
    // |a + sign b|^2, without cancellation for this sign.
    const T squared_sum = squared_norms + 2 * sign * dot;
    const T factor = squared_sum > T(0) ? T(root_ * sqrt(squared_sum)) : T(0);
    for (int i = 0; i < 7; ++i) residuals[i] = factor * (a[i] - sign * b[i]);
    return true;
  }

 private:
  double root_;
};

template <>
class SmoothnessCost<4> {
 public:
  explicit SmoothnessCost(double weight) : root_(RootOfWeight("SmoothnessCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) {
    return new ceres::AutoDiffCostFunction<SmoothnessCost, 9, 9, 9>(new SmoothnessCost(weight));
  }

  template <typename T>
  bool operator()(const T* a, const T* b, T* residuals) const {
    for (int i = 0; i < 9; ++i) residuals[i] = root_ * (a[i] - b[i]);
    return true;
  }

 private:
  double root_;
};

}  // namespace octupole
