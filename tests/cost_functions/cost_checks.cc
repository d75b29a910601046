#include "cost_checks.h"

#include <gtest/gtest.h>

#include <limits>

namespace octupole {

Evaluation Evaluate(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Evaluation evaluation;
  evaluation.residuals.setConstant(cost.num_residuals(), kNan);
  std::vector<const double*> blocks;
  std::vector<double*> jacobians;
  const auto& sizes = cost.parameter_block_sizes();
  evaluation.jacobians.resize(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(sizes[i], parameters[i].size());
    blocks.push_back(parameters[i].data());
    evaluation.jacobians[i].setConstant(cost.num_residuals(), sizes[i], kNan);
    jacobians.push_back(evaluation.jacobians[i].data());
  }
  EXPECT_TRUE(cost.Evaluate(blocks.data(), evaluation.residuals.data(), jacobians.data()));
  // Ceres may ask for residuals only; they must be the same, but for the rounding of another instantiation.
  Eigen::VectorXd residuals_only = Eigen::VectorXd::Constant(cost.num_residuals(), kNan);
  EXPECT_TRUE(cost.Evaluate(blocks.data(), residuals_only.data(), nullptr));
  EXPECT_LE((residuals_only - evaluation.residuals).norm(), 1e-13 * evaluation.residuals.norm());
  return evaluation;
}

void ExpectFinite(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters) {
  const Evaluation evaluation = Evaluate(cost, parameters);
  EXPECT_TRUE(evaluation.residuals.allFinite()) << evaluation.residuals.transpose();
  for (const auto& jacobian : evaluation.jacobians) EXPECT_TRUE(jacobian.allFinite()) << jacobian;
}

void ExpectJacobiansAreDerivatives(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters,
                                   double tolerance) {
  const Evaluation evaluation = Evaluate(cost, parameters);
  const auto residuals = [&](std::size_t block, Eigen::Index i, double step) {
    std::vector<Eigen::VectorXd> moved = parameters;
    moved[block][i] += step;
    return Evaluate(cost, moved).residuals;
  };
  for (std::size_t block = 0; block < parameters.size(); ++block) {
    for (Eigen::Index i = 0; i < parameters[block].size(); ++i) {
      const auto difference = [&](double h) {
        return Eigen::VectorXd((residuals(block, i, h) - residuals(block, i, -h)) / (2 * h));
      };
      constexpr double kStep = 1e-3;
      const Eigen::VectorXd derivative = (4 * difference(kStep / 2) - difference(kStep)) / 3;
      const double error = (evaluation.jacobians[block].col(i) - derivative).norm();
      EXPECT_LT(error, tolerance * (1 + derivative.norm())) << "parameter " << i << " of block " << block;
    }
  }
}

void ExpectSame(const ceres::CostFunction& one, const ceres::CostFunction& other,
                const std::vector<Eigen::VectorXd>& parameters) {
  const Evaluation a = Evaluate(one, parameters), b = Evaluate(other, parameters);
  EXPECT_LE((a.residuals - b.residuals).norm(), 1e-13 * (1 + b.residuals.norm()));
  for (std::size_t block = 0; block < parameters.size(); ++block) {
    EXPECT_LE((a.jacobians[block] - b.jacobians[block]).norm(), 1e-13 * (1 + b.jacobians[block].norm()));
  }
}

}  // namespace octupole
