#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <array>

namespace octupole {

/// InjectivityCost with its derivatives written out, about twice as fast (benchmarks/cost_benchmark): with the rows
/// g_i of HatGradients, the cofactors C of J and D_i = C g_i = d det/du_i, and as dchi/ddet = chi q, q = 1 /
/// sqrt(epsilon^2
/// + det^2),
///
///   d(J_kl / chi^(1/3))/du_i = chi^(-1/3) (g_il e_k - q/3 J_kl D_i)^T,
///   d(det / chi^(1/2))/du_i = chi^(-1/2) (1 - q/2 det) D_i^T,   d(1 / chi^(1/2))/du_i = -chi^(-1/2) q/2 D_i^T,
///
/// all times sqrt(weight).
class AnalyticInjectivityCost final : public ceres::SizedCostFunction<11, 3, 3, 3, 3> {
 public:
  AnalyticInjectivityCost(const std::array<Eigen::Vector3d, 4>& corners, double size, double epsilon, double weight);

  /// \throw std::invalid_argument as InjectivityCost::Create.
  static ceres::CostFunction* Create(const std::array<Eigen::Vector3d, 4>& corners, double size, double epsilon,
                                     double weight) {
    return new AnalyticInjectivityCost(corners, size, epsilon, weight);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Eigen::Matrix<double, 4, 3> gradients_;
  double epsilon_;
  double root_;
};

}  // namespace octupole
