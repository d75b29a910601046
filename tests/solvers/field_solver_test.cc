#include "octupole/solvers/field_solver.h"

#include <ceres/iteration_callback.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "ball_mesh.h"
#include "octupole/field/field_graph.h"
#include "octupole/field/field_quality.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/solver_presets.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;

const TetMesh& Box() {
  static const TetMesh mesh = MakeBoxMesh({6, 5, 4}, {6, 5, 4});
  return mesh;
}

// The largest angle between an axis of a frame and the nearest coordinate axis.
double AngleToCoordinateAxes(const std::vector<Matrix3d>& frames) {
  double worst = 0;
  for (const Matrix3d& frame : frames) {
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d sorted = frame.col(k).cwiseAbs();
      std::sort(sorted.begin(), sorted.end());
      worst = std::max(worst, std::atan2(std::hypot(sorted[0], sorted[1]), sorted[2]));
    }
  }
  return worst;
}

template <int kDegree>
FieldOptions<kDegree> OptionsOf(SolverPreset preset, std::uint32_t seed) {
  FieldOptions<kDegree> options;
  options.seed = seed;
  options.solver = MakeSolverOptions(preset);
  return options;
}

class BoxTest : public testing::TestWithParam<SolverPreset> {};

// The field of a box is constant, from every start.
TEST_P(BoxTest, HasTheConstantFieldFrom20Seeds) {
  const double num_edges =
      static_cast<double>(MakeFieldGraph(Box(), std::vector<Alignment>(Box().points.size())).edges.size());
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Field<3> field = SolveField<3>(Box(), OptionsOf<3>(GetParam(), seed));
    EXPECT_EQ(field.termination, ceres::CONVERGENCE) << field.ceres_summary->message;
    EXPECT_LT(field.energy, 1e-8 * num_edges) << "seed " << seed;
    EXPECT_LT(AngleToCoordinateAxes(field.frames), 1e-4) << "seed " << seed;
  }
}

TEST_P(BoxTest, HasTheConstantFieldInDegree4) {
  const Field<4> field = SolveField<4>(Box(), OptionsOf<4>(GetParam(), 1));
  EXPECT_LT(field.energy, 1e-4);
  EXPECT_LT(AngleToCoordinateAxes(field.frames), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(EverySolver, BoxTest,
                         testing::Values(SolverPreset::kSparseCholesky, SolverPreset::kConjugateGradients,
                                         SolverPreset::kLbfgs));

TEST(SolveField, RepeatsWithItsSeed) {
  const Field<3> a = SolveField<3>(Box(), OptionsOf<3>(SolverPreset::kLbfgs, 3));
  const Field<3> b = SolveField<3>(Box(), OptionsOf<3>(SolverPreset::kLbfgs, 3));
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_EQ(a.energy, b.energy);
}

TEST(SolveField, StartsWhereTheCallerSays) {
  FieldOptions<3> options = OptionsOf<3>(SolverPreset::kLbfgs, 0);
  options.start.assign(Box().points.size(), ReferenceHarmonic<3>());
  const Field<3> field = SolveField<3>(Box(), options);
  EXPECT_LE(field.iterations.size(), 1u) << "the start is the solution";
  EXPECT_NEAR(field.energy, 0, 1e-20);
  options.start.pop_back();
  EXPECT_THROW(SolveField<3>(Box(), options), std::invalid_argument);
}

TEST(SolveField, ReturnsWhatWasReachedWhenStopped) {
  class Stop : public ceres::IterationCallback {
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
      return summary.iteration == 3 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }
  } stop;
  FieldOptions<3> options = OptionsOf<3>(SolverPreset::kLbfgs, 0);
  options.solver->callbacks.push_back(&stop);
  const Field<3> field = SolveField<3>(Box(), options);
  EXPECT_EQ(field.termination, ceres::USER_SUCCESS);
  EXPECT_EQ(field.iterations.size(), field.ceres_summary->iterations.size());
  EXPECT_LT(field.energy, 2 * field.ceres_summary->initial_cost);
  EXPECT_EQ(field.frames.size(), Box().points.size());
}

// Every boundary vertex keeps to the normal, and the field has to turn and be singular.
TEST(SolveField, AlignsWithACurvedBoundary) {
  const TetMesh mesh = MakeBallMesh(8);
  const Field<3> field = SolveField<3>(mesh, OptionsOf<3>(SolverPreset::kLbfgs, 0));
  EXPECT_EQ(field.alignment.num_normals, 9u * 9u * 9u - 7u * 7u * 7u);
  const FieldQuality quality = MeasureField(mesh, field.frames);
  EXPECT_GT(quality.smooth_boundary_vertices, 300u);
  EXPECT_LT(quality.boundary_max_deg, 1e-4);
  EXPECT_GT(quality.singular_triangles, 8u);
}

class MethodTest : public testing::TestWithParam<FieldMethod> {};
INSTANTIATE_TEST_SUITE_P(EveryMethod, MethodTest,
                         testing::Values(FieldMethod::kPenalty, FieldMethod::kRaySokolov, FieldMethod::kHuang,
                                         FieldMethod::kMbo));

// In both degrees.
TEST_P(MethodTest, FillsTheWholeField) {
  const auto run = [](auto options) {
    options.method = GetParam();
    const auto field = SolveField(Box(), options);
    EXPECT_EQ(field.termination, ceres::CONVERGENCE);
    EXPECT_LT(AngleToCoordinateAxes(field.frames), 1e-2);
    EXPECT_FALSE(field.ceres_summary);
    EXPECT_GT(field.size.unknowns, 3 * 4 * 5 * 3u);
    EXPECT_GT(field.size.nonzeros, field.size.unknowns);
    EXPECT_EQ(field.coefficients.size(), Box().points.size());
    return field;
  };
  const Field<3> octupoles = run(FieldOptions<3>());
  const Field<4> hexadecapoles = run(FieldOptions<4>());
  for (std::size_t v = 0; v < Box().points.size(); ++v) {
    EXPECT_NEAR(std::abs(octupoles.coefficients[v].dot(HarmonicFromFrame<3>(octupoles.frames[v]))), 1, 1e-3);
    EXPECT_NEAR(hexadecapoles.coefficients[v].dot(HarmonicFromFrame<4>(hexadecapoles.frames[v])), 1, 1e-3);
  }
}

TEST_P(MethodTest, TakesItsOptions) {
  FieldOptions<3> options;
  options.method = GetParam();
  options.minimizer.max_iterations = 1;
  EXPECT_EQ(SolveField<3>(MakeBallMesh(4), options).iterations.size(), 1u);
}

TEST_P(MethodTest, TakesAStartAndASolverOnlyIfItIsThePenalty) {
  for (const bool is_start : {true, false}) {
    FieldOptions<3> options;
    options.method = GetParam();
    if (is_start) {
      options.start.assign(Box().points.size(), ReferenceHarmonic<3>());
    } else {
      options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
    }
    if (GetParam() == FieldMethod::kPenalty) {
      EXPECT_NO_THROW(SolveField<3>(Box(), options));
    } else {
      EXPECT_THROW(SolveField<3>(Box(), options), std::invalid_argument);
    }
  }
}

TEST(SolveField, RefusesABadMesh) {
  TetMesh mesh = Box();
  mesh.tets[7][1] = 100000;
  EXPECT_THROW(SolveField<3>(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
