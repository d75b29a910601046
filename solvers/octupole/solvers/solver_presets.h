#pragma once

#include <ceres/solver.h>

#include <cstddef>

namespace octupole {

/// Ways to minimise a field energy with Ceres.
enum class SolverPreset {
  /// Levenberg-Marquardt with sparse Cholesky factorisation: few steps, but the factor of a 3D mesh fills in: hundreds
  /// of vertices.
  kSparseCholesky,
  /// Levenberg-Marquardt with conjugate gradients on the normal equations, block Jacobi preconditioner: thousands
  /// of vertices.
  kConjugateGradients,
  /// Limited-memory BFGS: many cheap steps and little memory. Any size.
  kLbfgs,
};

/// The preset that suits a mesh of `num_vertices`, among those that this build of Ceres has.
SolverPreset ChooseSolverPreset(std::size_t num_vertices);

/// The options of a preset, silent and on one thread; change whatever you like. Sparse Cholesky uses SuiteSparse where
/// Ceres was built with it, else another library that it has. \throw std::runtime_error for kSparseCholesky when Ceres
/// was built without any sparse linear algebra library.
ceres::Solver::Options MakeSolverOptions(SolverPreset preset);

}  // namespace octupole
