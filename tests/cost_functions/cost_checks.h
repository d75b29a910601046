#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

namespace octupole {

// The residuals and Jacobians of a cost function at a point, and what every residual block has to satisfy there.

/// The weight of the costs on trial.
constexpr double kWeight = 2.5;

struct Evaluation {
  Eigen::VectorXd residuals;
  /// One per parameter block.
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobians;
};

/// Buffers are filled with NaN first, so that an entry the cost forgets to write shows.
Evaluation Evaluate(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters);

/// Residuals and Jacobians are finite.
void ExpectFinite(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters);

/// The Jacobians are the derivatives of the residuals, by central differences with Richardson's extrapolation: accurate
/// to about 1e-11 for parameters and derivatives of order one, hence the tolerance.
void ExpectJacobiansAreDerivatives(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& parameters,
                                   double tolerance = 1e-8);

/// Two cost functions have the same residuals and Jacobians, to rounding.
void ExpectSame(const ceres::CostFunction& one, const ceres::CostFunction& other,
                const std::vector<Eigen::VectorXd>& parameters);

}  // namespace octupole
