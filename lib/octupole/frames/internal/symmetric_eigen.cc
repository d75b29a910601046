#include "octupole/frames/internal/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace octupole::internal {

SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace octupole::internal
