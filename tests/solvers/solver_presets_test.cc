#include "octupole/solvers/solver_presets.h"

#include <gtest/gtest.h>

#include <string>

namespace octupole {
namespace {

TEST(MakeSolverOptions, AreValidForEveryPreset) {
  for (const SolverPreset preset :
       {SolverPreset::kSparseCholesky, SolverPreset::kConjugateGradients, SolverPreset::kLbfgs}) {
    std::string error;
    EXPECT_TRUE(MakeSolverOptions(preset).IsValid(&error)) << error;
  }
}

TEST(MakeSolverOptions, AreWhatTheirNamesSay) {
  EXPECT_EQ(MakeSolverOptions(SolverPreset::kSparseCholesky).linear_solver_type, ceres::SPARSE_NORMAL_CHOLESKY);
  EXPECT_EQ(MakeSolverOptions(SolverPreset::kConjugateGradients).linear_solver_type, ceres::CGNR);
  EXPECT_EQ(MakeSolverOptions(SolverPreset::kConjugateGradients).preconditioner_type, ceres::JACOBI);
  EXPECT_EQ(MakeSolverOptions(SolverPreset::kLbfgs).minimizer_type, ceres::LINE_SEARCH);
  EXPECT_EQ(MakeSolverOptions(SolverPreset::kLbfgs).line_search_direction_type, ceres::LBFGS);
}

TEST(ChooseSolverPreset, GoesFromCholeskyToLbfgsWithSize) {
  EXPECT_EQ(ChooseSolverPreset(100), SolverPreset::kSparseCholesky);
  EXPECT_EQ(ChooseSolverPreset(1000000), SolverPreset::kLbfgs);
}

}  // namespace
}  // namespace octupole
