#pragma once

#include <ceres/sized_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// SmoothnessCost with its derivatives written out, several times faster (benchmarks/cost_benchmark). Same parameters,
/// residuals and treatment of degenerate points.
///
/// Degree 3, with sign = +1 where a . b >= 0 and -1 elsewhere, p = a + sign b, q = a - sign b:
///
///   r = sqrt(weight) |p| q,   dr/da = sqrt(weight) (|p| I + q p^T / |p|),   dr/db = sign sqrt(weight) (q p^T / |p| -
///   |p| I).
///
/// Degree 4: r = sqrt(weight) (a - b), with derivatives +-sqrt(weight) I.
template <int kDegree>
class AnalyticSmoothnessCost final
    : public ceres::SizedCostFunction<kDimension<kDegree>, kDimension<kDegree>, kDimension<kDegree>> {
 public:
  explicit AnalyticSmoothnessCost(double weight) : root_(RootOfWeight("AnalyticSmoothnessCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) { return new AnalyticSmoothnessCost(weight); }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

 private:
  double root_;
};

}  // namespace octupole
