#include "octupole/fast_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/boundary_alignment.h"
#include "octupole/box_mesh.h"
#include "octupole/field_solver.h"
#include "octupole/frame.h"
#include "octupole/rotation.h"
#include "octupole/solver_presets.h"
#include "random_inputs.h"

namespace octupole {
namespace {

FieldGraph GraphOf(const TetMesh& mesh) { return MakeFieldGraph(mesh, AlignToBoundary(mesh).alignments); }

double FrameEnergyOf(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames) {
  double sum = 0;
  for (const WeightedEdge& edge : graph.edges) sum += edge.weight * FrameDifference<4>(frames[edge.a], frames[edge.b]);
  return sum;
}

template <int kDegree>
void ExpectField(const FastField<kDegree>& field, const FieldGraph& graph) {
  ASSERT_EQ(field.coefficients.size(), graph.num_vertices());
  ASSERT_EQ(field.frames.size(), graph.num_vertices());
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    EXPECT_TRUE(field.coefficients[v].allFinite());
    EXPECT_NO_THROW(CheckRotation("test", field.frames[v]));
    const Eigen::Matrix3d prescribed = graph.alignments[v].frame();
    if (graph.alignments[v].kind() == AlignmentKind::kAxis) {
      EXPECT_LT((field.frames[v].col(2) - prescribed.col(2)).norm(), 1e-12);
    } else if (graph.alignments[v].kind() == AlignmentKind::kFrame) {
      EXPECT_LT((field.frames[v] - prescribed).norm(), 1e-12);
    }
  }
}

template <typename Degree>
class FastSolverTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(FastSolverTest, Degrees);

// More vertices than starts are tried on, so that the result goes through a hierarchy.
TYPED_TEST(FastSolverTest, FindsTheConstantFieldOfABoxFrom20Seeds) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBoxMesh({14, 12, 13}, {14, 12, 13}));
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    FastSolverOptions options;
    options.seed = seed;
    const FastField<l> field = SolveFast<l>(graph, {}, options);
    EXPECT_EQ(field.termination, ceres::CONVERGENCE);
    EXPECT_LT(field.energy, 1e-6 * static_cast<double>(graph.edges.size())) << "seed " << seed;
    EXPECT_LT(FrameEnergyOf(graph, field.frames), 1e-8 * static_cast<double>(graph.edges.size())) << "seed " << seed;
  }
}

TYPED_TEST(FastSolverTest, KeepsToACurvedBoundary) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(14));
  const FastField<l> field = SolveFast<l>(graph, {});
  EXPECT_EQ(field.termination, ceres::CONVERGENCE);
  ExpectField<l>(field, graph);
  EXPECT_GT(field.energy, 0);
}

TYPED_TEST(FastSolverTest, TakesAnyGraph) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  const Eigen::Matrix3d axes = RandomFrame(&generator);
  const Alignment frame = Alignment::Frame(axes);
  const Alignment axis = Alignment::Axis(axes.col(1));
  // Two grids, one without any alignment, and vertices alone.
  FieldGraph grids = GraphOf(MakeBoxMesh({6, 6, 6}, {1, 1, 1}));
  const int size = static_cast<int>(grids.num_vertices());
  const std::size_t num_edges = grids.edges.size();
  for (std::size_t e = 0; e < num_edges; ++e) {
    grids.edges.push_back({grids.edges[e].a + size, grids.edges[e].b + size, 1});
  }
  grids.alignments.resize(2 * size + 5);
  FieldGraph weightless = grids;
  for (WeightedEdge& edge : weightless.edges) edge.weight = 0;
  for (const FieldGraph& graph :
       {FieldGraph{}, FieldGraph{{}, {Alignment()}}, FieldGraph{{}, {axis, frame, Alignment()}},
        FieldGraph{{}, std::vector<Alignment>(300)}, FieldGraph{{{0, 1, 2}}, {frame, frame}},
        FieldGraph{{{0, 1, 0}, {1, 2, 3}}, {Alignment(), axis, frame}}, GraphOf(MakeBoxMesh({1, 1, 1}, {1, 1, 1})),
        grids, weightless}) {
    const FastField<l> field = SolveFast<l>(graph, {});
    EXPECT_EQ(field.termination, ceres::CONVERGENCE) << graph.num_vertices();
    ExpectField<l>(field, graph);
    EXPECT_LT(FrameEnergyOf(graph, field.frames), 1e-6 * static_cast<double>(graph.edges.size() + 1));
  }
}

TYPED_TEST(FastSolverTest, RepeatsOnAnyNumberOfThreads) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(16));
  FastSolverOptions options;
  options.seed = 5;
  options.max_iterations = 120;
  const FastField<l> one = SolveFast<l>(graph, {}, options);
  EXPECT_EQ(SolveFast<l>(graph, {}, options).frames, one.frames);
  options.num_threads = 2;
  const FastField<l> two = SolveFast<l>(graph, {}, options);
  EXPECT_EQ(two.coefficients, one.coefficients);
  EXPECT_EQ(two.frames, one.frames);
  EXPECT_EQ(two.energy, one.energy);
}

TYPED_TEST(FastSolverTest, StopsWhenItIsToldTo) {
  constexpr int l = TypeParam::value;
  class Stop : public ceres::IterationCallback {
   public:
    explicit Stop(int last) : last_(last) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
      EXPECT_EQ(summary.iteration, ++num_calls_);
      EXPECT_GE(summary.cumulative_time_in_seconds, 0);
      return summary.iteration == last_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

   private:
    int last_;
    int num_calls_ = 0;
  };
  const FieldGraph graph = GraphOf(MakeBallMesh(14));
  for (const int last : {1, 30, 200}) {
    Stop stop(last);
    FastSolverOptions options;
    options.callback = &stop;
    const FastField<l> field = SolveFast<l>(graph, {}, options);
    EXPECT_EQ(field.termination, ceres::USER_SUCCESS);
    EXPECT_EQ(field.iterations.size(), static_cast<std::size_t>(last));
    ExpectField<l>(field, graph);
  }
  FastSolverOptions options;
  options.max_iterations = 50;
  const FastField<l> field = SolveFast<l>(graph, {}, options);
  EXPECT_EQ(field.termination, ceres::NO_CONVERGENCE);
  EXPECT_EQ(field.iterations.size(), 50u);
  ExpectField<l>(field, graph);
}

TYPED_TEST(FastSolverTest, ContinuesFromAField) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(8));
  const FastField<l> field = SolveFast<l>(graph, {});
  const FastField<l> again = SolveFastFrom<l>(graph, {}, field.coefficients);
  EXPECT_LE(again.energy, field.energy);
  EXPECT_LT(again.iterations.size(), field.iterations.size() / 2);
  EXPECT_THROW(SolveFastFrom<l>(graph, {}, {}), std::invalid_argument);
}

// The road of residual blocks, from a random start and to convergence, has nothing better to offer.
TYPED_TEST(FastSolverTest, IsNotWorseThanCeres) {
  constexpr int l = TypeParam::value;
  for (const TetMesh& mesh : {MakeBallMesh(6), MakeBallMesh(9)}) {
    FieldOptions<l> options;
    const Field<l> fast = SolveField<l>(mesh, options);
    options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
    const Field<l> slow = SolveField<l>(mesh, options);
    const FieldGraph graph = GraphOf(mesh);
    EXPECT_LE(FrameEnergyOf(graph, fast.frames), 1.002 * FrameEnergyOf(graph, slow.frames));
  }
}

TEST(SolveFast, SaysWhenTheEnergyIsNotFinite) {
  const FieldGraph graph = {{{0, 1, 1e308}, {1, 2, 1e308}, {0, 2, 1e308}}, std::vector<Alignment>(3)};
  EXPECT_EQ(SolveFast<3>(graph, {}).termination, ceres::FAILURE);
}

TEST(SolveFast, RefusesBadInput) {
  const FieldGraph graph = GraphOf(MakeBoxMesh({1, 1, 1}, {1, 1, 1}));
  EXPECT_THROW(SolveFast<3>({{{0, 2, 1}}, std::vector<Alignment>(2)}, {}), std::invalid_argument);
  EXPECT_THROW(SolveFast<3>(graph, {-1, 0}), std::invalid_argument);
  FastSolverOptions options;
  options.num_threads = 0;
  EXPECT_THROW(SolveFast<3>(graph, {}, options), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
