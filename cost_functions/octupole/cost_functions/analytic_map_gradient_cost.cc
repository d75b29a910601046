#include "octupole/cost_functions/analytic_map_gradient_cost.h"

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/cost_functions/map_gradient_cost.h"

namespace octupole {

AnalyticMapGradientCost::AnalyticMapGradientCost(const std::array<Eigen::Vector3d, 4>& corners,
                                                 const Eigen::Matrix3d& frame, double size, double weight)
    : gradients_(RootOfWeight("AnalyticMapGradientCost", weight) * HatGradients(corners, size)),
      axes_(RootOfWeight("AnalyticMapGradientCost", weight) * frame.transpose()) {}

bool AnalyticMapGradientCost::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Map<RowMajor> rest(residuals);
  rest = -axes_;
  for (int i = 0; i < 4; ++i) {
    rest.noalias() += Eigen::Map<const Eigen::Vector3d>(parameters[i]) * gradients_.row(i);
    if (jacobians == nullptr || jacobians[i] == nullptr) continue;
    Eigen::Map<Eigen::Matrix<double, 9, 3, Eigen::RowMajor>> jacobian(jacobians[i]);
    jacobian.setZero();
    for (int k = 0; k < 3; ++k) jacobian.block<3, 1>(3 * k, k) = gradients_.row(i).transpose();
  }
  return true;
}

}  // namespace octupole
