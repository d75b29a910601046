#pragma once

#include <ceres/sized_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// DeviationCost with its derivatives written out, several times faster (benchmarks/cost_benchmark):
///
///   r_k = sqrt(weight) a^T N_k a,   dr_k/da = 2 sqrt(weight) (N_k a)^T,   k = 1..5.
template <int kDegree>
class AnalyticDeviationCost final : public ceres::SizedCostFunction<5, kDimension<kDegree>> {
 public:
  explicit AnalyticDeviationCost(double weight) : root_(RootOfWeight("AnalyticDeviationCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(double weight) { return new AnalyticDeviationCost(weight); }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

 private:
  double root_;
};

}  // namespace octupole
