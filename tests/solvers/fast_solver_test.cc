#include "octupole/solvers/fast_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "method_checks.h"
#include "octupole/alignment/aligned_frame.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {
namespace {

template <int kDegree>
void ExpectField(const FieldSolution<kDegree>& field, const FieldGraph& graph) {
  ExpectFrames(field, graph);
  ASSERT_EQ(field.coefficients.size(), graph.num_vertices());
  for (const Harmonic<kDegree>& h : field.coefficients) EXPECT_TRUE(h.allFinite());
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
    MinimizerOptions options;
    options.seed = seed;
    const FieldSolution<l> field = SolveFast<l>(graph, {}, options);
    EXPECT_EQ(field.termination, ceres::CONVERGENCE);
    EXPECT_LT(field.energy, 1e-6 * static_cast<double>(graph.edges.size())) << "seed " << seed;
    EXPECT_LT(FrameEnergyOf(graph, field.frames), 1e-8 * static_cast<double>(graph.edges.size())) << "seed " << seed;
  }
}

TYPED_TEST(FastSolverTest, KeepsToACurvedBoundary) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(14));
  const FieldSolution<l> field = SolveFast<l>(graph, {});
  EXPECT_EQ(field.termination, ceres::CONVERGENCE);
  ExpectField<l>(field, graph);
  EXPECT_GT(field.energy, 0);
}

TYPED_TEST(FastSolverTest, TakesAnyGraph) {
  constexpr int l = TypeParam::value;
  for (const FieldGraph& graph : AnyGraphs()) {
    const FieldSolution<l> field = SolveFast<l>(graph, {});
    EXPECT_EQ(field.termination, ceres::CONVERGENCE) << graph.num_vertices();
    ExpectField<l>(field, graph);
    EXPECT_LT(FrameEnergyOf(graph, field.frames), 1e-6 * static_cast<double>(graph.edges.size() + 1));
  }
}

TYPED_TEST(FastSolverTest, RepeatsOnAnyNumberOfThreads) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(16));
  MinimizerOptions options;
  options.seed = 5;
  options.max_iterations = 120;
  const FieldSolution<l> one = SolveFast<l>(graph, {}, options);
  EXPECT_EQ(SolveFast<l>(graph, {}, options).frames, one.frames);
  options.num_threads = 2;
  const FieldSolution<l> two = SolveFast<l>(graph, {}, options);
  EXPECT_EQ(two.coefficients, one.coefficients);
  EXPECT_EQ(two.frames, one.frames);
  EXPECT_EQ(two.energy, one.energy);
}

TYPED_TEST(FastSolverTest, StopsWhenItIsToldTo) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(14));
  ExpectStops([](const auto& g, const auto& options) { return SolveFast<l>(g, {}, options); }, graph);
}

TYPED_TEST(FastSolverTest, ContinuesFromAField) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(8));
  const FieldSolution<l> field = SolveFast<l>(graph, {});
  const FieldSolution<l> again = SolveFastFrom<l>(graph, {}, field.coefficients);
  EXPECT_LE(again.energy, field.energy);
  EXPECT_LT(again.iterations.size(), field.iterations.size() / 2);
  EXPECT_THROW(SolveFastFrom<l>(graph, {}, {}), std::invalid_argument);
}

// After a change at one vertex: lower than the frames that it began with, and far from it nothing has moved.
TYPED_TEST(FastSolverTest, PolishesAnEarlierField) {
  constexpr int l = TypeParam::value;
  const TetMesh mesh = MakeBallMesh(14);
  FieldGraph graph = GraphOf(mesh);
  const FieldSolution<l> field = SolveFast<l>(graph, {});
  const int changed = 15 * 15 * 15 / 2 + 3;
  const Eigen::Vector3d diagonal = field.frames[changed] * Eigen::Vector3d(1, 1, 0);
  graph.alignments[changed] = Alignment::Axis(diagonal);
  const FieldSolution<l> polished = PolishField<l>(graph, {}, field.frames);
  EXPECT_EQ(polished.termination, ceres::CONVERGENCE);
  ExpectField<l>(polished, graph);
  EXPECT_LT(polished.iterations.size(), field.iterations.size() / 3);
  std::vector<Eigen::Matrix3d> start = field.frames;
  start[changed] = NearestAlignedFrame<4>(graph.alignments[changed], HarmonicFromFrame<4>(start[changed]));
  EXPECT_LT(FrameEnergyOf(graph, polished.frames), FrameEnergyOf(graph, start));
  double energy = 0;
  for (const auto& [a, b, weight] : graph.edges) {
    const Eigen::Matrix3d &fa = polished.frames[a], &fb = polished.frames[b];
    energy += weight * (l == 3 ? FrameDifference<3>(fa, fb) : FrameDifference<4>(fa, fb));
  }
  EXPECT_NEAR(polished.energy, energy, 1e-9 * energy) << "of the frames' harmonics";
  std::size_t num_far = 0, num_moved = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if ((mesh.points[v] - mesh.points[changed]).norm() < 0.6) continue;
    ++num_far;
    num_moved += FrameDifference<4>(polished.frames[v], field.frames[v]) > 20. / 3 * 0.002;  // 2.6 degrees
  }
  EXPECT_LT(num_moved, num_far / 100) << "but for some at singular curves";
  EXPECT_GT(num_far, 1000u);
  EXPECT_THROW(PolishField<l>(graph, {}, {}), std::invalid_argument);
  start[7] *= 2;
  EXPECT_THROW(PolishField<l>(graph, {}, start), std::invalid_argument);
}

TYPED_TEST(FastSolverTest, TriesStartsUntilTwoAgreeAndNotMoreThanItIsToldTo) {
  constexpr int l = TypeParam::value;
  MinimizerOptions options;
  std::set<std::string> names;
  options.step_callback = [&](const StepSummary& step) {
    if (step.num_vertices > 0 && step.name.find(" start ") != std::string::npos) names.insert(step.name);
  };
  SolveFast<l>(GraphOf(MakeBoxMesh({8, 8, 8}, {8, 8, 8})), {}, options);
  EXPECT_EQ(names.size(), 5u) << "which all find the constant field";

  const FieldGraph graph = GraphOf(MakeBallMesh(14));
  double energy_of_one = 0, energy = 0;
  for (const int num_starts : {1, 2, 5}) {
    names.clear();
    options.num_starts = num_starts;
    const FieldSolution<l> field = SolveFast<l>(graph, {}, options);
    EXPECT_EQ(field.termination, ceres::CONVERGENCE);
    EXPECT_EQ(names.size(), static_cast<std::size_t>(num_starts));
    energy = FrameEnergyOf(graph, field.frames);
    if (num_starts == 1) energy_of_one = energy;
  }
  EXPECT_LT(energy, 1.005 * energy_of_one);

  // In a ball few starts end in one field.
  std::size_t most = 0;
  constexpr std::size_t kLimit = 18;
  options.num_starts = static_cast<int>(kLimit);
  for (const int cells : {4, 6, 8, 10}) {
    names.clear();
    SolveFast<l>(GraphOf(MakeBallMesh(cells)), {}, options);
    EXPECT_TRUE(names.size() % 5 == 0 || names.size() == kLimit)
        << names.size() << " of " << cells << ": no whole rounds";
    EXPECT_LE(std::count_if(names.begin(), names.end(), [](const auto& name) { return name[0] == 'c'; }), 2)
        << "starts from the coarsest graph, one in each degree";
    most = std::max(most, names.size());
  }
  EXPECT_GT(most, 5u);
  options.num_starts = 0;
  EXPECT_THROW(SolveFast<l>(graph, {}, options), std::invalid_argument);
}

TYPED_TEST(FastSolverTest, StartsOnTheFinestGraphThatIsNoLargerThanItIsToldTo) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = GraphOf(MakeBallMesh(8));
  const auto size_for_starts = [&](std::size_t max_start_vertices) {
    std::size_t size = 0;
    MinimizerOptions options;
    options.step_callback = [&](const StepSummary& step) {
      if (size == 0 && step.name.find("random start") == 0) size = step.num_vertices;
    };
    SolveFast<l>(graph, {}, options, max_start_vertices);
    return size;
  };
  EXPECT_EQ(size_for_starts(kMaxStartVertices), graph.num_vertices());
  const std::size_t coarse = size_for_starts(graph.num_vertices() - 1);
  EXPECT_LT(coarse, graph.num_vertices() / 4);
  EXPECT_GT(coarse, graph.num_vertices() / 20);
  EXPECT_EQ(size_for_starts(coarse), coarse);
  EXPECT_LT(size_for_starts(coarse - 1), coarse);
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

// Starts on a graph as coarse as here say little of those that are finer.
TEST(SolveFast, TakesALinearStartOnAFinerGraphWhereItIsLower) {
  const FieldGraph graph = GraphOf(MakeBallMesh(20));
  int num_chosen = 0, num_not_chosen = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    MinimizerOptions options;
    options.seed = seed;
    StepSummary refined, linear;
    bool is_chosen = false;
    options.step_callback = [&](const StepSummary& step) {
      if (step.name == "linear start on a finer graph") linear = step;
      if (step.name == "level" && linear.num_vertices == 0) refined = step;
      is_chosen = is_chosen || step.name == "linear start on a finer graph chosen";
    };
    SolveFast<3>(graph, {}, options, 30);
    ASSERT_GT(linear.num_vertices, 0u);
    EXPECT_LT(linear.num_vertices, graph.num_vertices()) << "on the finest it would take as long as all the rest";
    EXPECT_EQ(refined.num_vertices, linear.num_vertices);
    EXPECT_EQ(is_chosen, linear.energy < refined.energy);
    ++(is_chosen ? num_chosen : num_not_chosen);
  }
  EXPECT_GT(num_chosen, 0);
  EXPECT_GT(num_not_chosen, 0);
}

TEST(SolveFast, RefusesBadInput) {
  ExpectRefusals([](const auto& graph, const auto& options) { return SolveFast<3>(graph, {}, options); });
  EXPECT_THROW(SolveFast<3>(GraphOf(MakeBoxMesh({1, 1, 1}, {1, 1, 1})), {-1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
