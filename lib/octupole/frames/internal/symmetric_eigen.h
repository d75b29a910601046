#pragma once

#include <Eigen/Core>

namespace octupole::internal {

/// Eigenvalues in ascending order, and orthonormal eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Eigen's solver, compiled once for all sizes: every instantiation of it costs seven seconds of compilation.
SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix);

}  // namespace octupole::internal
