#include "octupole/cost_functions/analytic_injectivity_cost.h"

#include <Eigen/Geometry>
#include <cmath>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/cost_functions/injectivity_cost.h"
#include "octupole/maps/foldover_energy.h"

namespace octupole {

AnalyticInjectivityCost::AnalyticInjectivityCost(const std::array<Eigen::Vector3d, 4>& corners, double size,
                                                 double epsilon, double weight)
    : gradients_(HatGradients(corners, size)),
      epsilon_(PositiveEpsilon("AnalyticInjectivityCost", epsilon)),
      root_(RootOfWeight("AnalyticInjectivityCost", weight)) {}

bool AnalyticInjectivityCost::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  RowMajor j = RowMajor::Zero();
  for (int i = 0; i < 4; ++i) j.noalias() += Eigen::Map<const Eigen::Vector3d>(parameters[i]) * gradients_.row(i);
  RowMajor cofactors;
  for (int k = 0; k < 3; ++k) cofactors.row(k) = j.row((k + 1) % 3).cross(j.row((k + 2) % 3));
  const double det = j.row(0).dot(cofactors.row(0));
  const double chi = RegularisedDeterminant(det, epsilon_);
  const double by_length = root_ / std::cbrt(chi), by_volume = root_ / std::sqrt(chi);
  Eigen::Map<RowMajor>{residuals} = by_length * j;
  residuals[9] = by_volume * det;
  residuals[10] = by_volume;
  if (jacobians == nullptr) return true;
  const double q = 1 / std::sqrt(det * det + epsilon_ * epsilon_);
  // The residuals' derivatives by the determinant alone.
  Eigen::Matrix<double, 11, 1> by_det;
  by_det.head<9>() = -q / 3 * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(residuals);
  by_det[9] = by_volume * (1 - q / 2 * det);
  by_det[10] = -by_volume * q / 2;
  for (int i = 0; i < 4; ++i) {
    if (jacobians[i] == nullptr) continue;
    Eigen::Map<Eigen::Matrix<double, 11, 3, Eigen::RowMajor>> jacobian(jacobians[i]);
    const Eigen::RowVector3d g = gradients_.row(i), by_corner = g * cofactors.transpose();
    jacobian.noalias() = by_det * by_corner;
    for (int k = 0; k < 3; ++k) jacobian.block<3, 1>(3 * k, k) += by_length * g.transpose();
  }
  return true;
}

}  // namespace octupole
