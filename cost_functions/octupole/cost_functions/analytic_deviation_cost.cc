#include "octupole/cost_functions/analytic_deviation_cost.h"

#include "octupole/harmonics/quadrics.h"

namespace octupole {

template <int kDegree>
bool AnalyticDeviationCost<kDegree>::Evaluate(const double* const* parameters, double* residuals,
                                              double** jacobians) const {
  const Eigen::Map<const Harmonic<kDegree>> a(parameters[0]);
  const auto& quadrics = Quadrics<kDegree>();
  for (int k = 0; k < 5; ++k) {
    const Harmonic<kDegree> product = root_ * (quadrics[k] * a);
    residuals[k] = a.dot(product);
    if (jacobians == nullptr || jacobians[0] == nullptr) continue;
    Eigen::Map<Harmonic<kDegree>> row(jacobians[0] + k * kDimension<kDegree>);
    row = 2 * product;
  }
  return true;
}

template class AnalyticDeviationCost<3>;
template class AnalyticDeviationCost<4>;

}  // namespace octupole
