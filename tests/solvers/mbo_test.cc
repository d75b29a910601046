#include "octupole/solvers/mbo.h"

#include <gtest/gtest.h>

#include "method_checks.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

TEST(SolveMbo, FindsTheConstantFieldOfABoxFromEverySeed) {
  const FieldGraph graph = GraphOf(MakeBoxMesh({9, 7, 8}, {9, 7, 8}));
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    MinimizerOptions options;
    options.seed = seed;
    const FrameSolution solution = SolveMbo(graph, options);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
    EXPECT_LT(FrameEnergyOf(graph, solution.frames), 1e-6 * static_cast<double>(graph.edges.size())) << "seed " << seed;
  }
}

// The fixed point of diffusion and projection.
TEST(SolveMbo, PutsTheNearestFrameBetweenTwo) {
  const Between between;
  EXPECT_LT(FrameDifference<4>(SolveMbo(between.graph).frames[1], between.smoothest), 1e-4);
}

// Without polishing it ends somewhat higher.
TEST(SolveMbo, ComesNearTheEnergyOfTheOthersOnABall) {
  const FieldGraph graph = GraphOf(MakeBallMesh(10));
  const FrameSolution solution = SolveMbo(graph);
  EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
  ExpectFrames(solution, graph);
  EXPECT_NEAR(solution.energy, FrameEnergyOf(graph, solution.frames), 1e-9 * solution.energy);
  EXPECT_LT(solution.energy, 1.1 * FrameEnergyOf(graph, SolveFast<3>(graph, {}).frames));
}

TEST(SolveMbo, DependsOnTheSeed) {
  const FieldGraph graph = GraphOf(MakeBallMesh(6));
  MinimizerOptions options;
  options.seed = 1;
  EXPECT_NE(SolveMbo(graph, options).frames, SolveMbo(graph).frames);
}

TEST(SolveMbo, TakesAnyGraph) {
  for (const FieldGraph& graph : AnyGraphs()) {
    const FrameSolution solution = SolveMbo(graph);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE) << graph.num_vertices();
    ExpectFrames(solution, graph);
    EXPECT_LT(FrameEnergyOf(graph, solution.frames), 1e-5 * static_cast<double>(graph.edges.size() + 1));
  }
}

TEST(SolveMbo, Repeats) { ExpectRepeats(SolveMbo, GraphOf(MakeBallMesh(14))); }
TEST(SolveMbo, StopsWhenItIsToldTo) { ExpectStops(SolveMbo, GraphOf(MakeBallMesh(8))); }
TEST(SolveMbo, RefusesBadInput) { ExpectRefusals(SolveMbo); }

}  // namespace
}  // namespace octupole
