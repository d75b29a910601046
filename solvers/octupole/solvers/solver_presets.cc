#include "octupole/solvers/solver_presets.h"

#include <stdexcept>

namespace octupole {
namespace {

// The first sparse library, fastest first, that this build of Ceres has, or NO_SPARSE.
ceres::SparseLinearAlgebraLibraryType FindSparseLibrary() {
  for (const auto library : {ceres::SUITE_SPARSE, ceres::EIGEN_SPARSE, ceres::CX_SPARSE}) {
    if (ceres::IsSparseLinearAlgebraLibraryTypeAvailable(library)) return library;
  }
  return ceres::NO_SPARSE;
}

}  // namespace

SolverPreset ChooseSolverPreset(std::size_t num_vertices) {
  // Up to these sizes the second-order methods, which converge to the last digit where a field has no singular curve,
  // take less than a second. L-BFGS is faster at every size (benchmarks/solver_benchmark).
  constexpr std::size_t kMaxCholeskyVertices = 200;
  constexpr std::size_t kMaxConjugateGradientVertices = 1000;
  if (num_vertices <= kMaxCholeskyVertices && FindSparseLibrary() != ceres::NO_SPARSE) {
    return SolverPreset::kSparseCholesky;
  }
  return num_vertices <= kMaxConjugateGradientVertices ? SolverPreset::kConjugateGradients : SolverPreset::kLbfgs;
}

ceres::Solver::Options MakeSolverOptions(SolverPreset preset) {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  // Ten times tighter gains some 1e-5 of the energy for up to three times as many iterations of the long tail.
  options.function_tolerance = 1e-6;
  options.gradient_tolerance = 1e-8;
  options.parameter_tolerance = 1e-9;
  if (preset == SolverPreset::kLbfgs) {
    options.minimizer_type = ceres::LINE_SEARCH;
    options.line_search_direction_type = ceres::LBFGS;
    options.max_num_iterations = 2000;
    return options;
  }
  options.minimizer_type = ceres::TRUST_REGION;
  options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  options.max_num_iterations = 300;
  if (preset == SolverPreset::kConjugateGradients) {
    options.linear_solver_type = ceres::CGNR;
    options.preconditioner_type = ceres::JACOBI;
    return options;
  }
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = FindSparseLibrary();
  if (options.sparse_linear_algebra_library_type == ceres::NO_SPARSE) {
    throw std::runtime_error("MakeSolverOptions: this build of Ceres has no sparse linear algebra library");
  }
  return options;
}

}  // namespace octupole
