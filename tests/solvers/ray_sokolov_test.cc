#include "octupole/solvers/ray_sokolov.h"

#include <gtest/gtest.h>

#include "method_checks.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

TEST(SolveRaySokolov, FindsTheConstantFieldOfABox) {
  const FieldGraph graph = GraphOf(MakeBoxMesh({14, 12, 13}, {14, 12, 13}));
  const FrameSolution solution = SolveRaySokolov(graph);
  EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
  EXPECT_LT(FrameEnergyOf(graph, solution.frames), 1e-8 * static_cast<double>(graph.edges.size()));
}

TEST(SolveRaySokolov, PutsTheNearestFrameBetweenTwo) {
  const Between between;
  EXPECT_LT(FrameDifference<4>(SolveRaySokolov(between.graph).frames[1], between.smoothest), 1e-8);
}

// It keeps to the boundary, and what it minimises is what it says.
TEST(SolveRaySokolov, ReachesTheEnergyOfTheOthersOnABall) {
  const FieldGraph graph = GraphOf(MakeBallMesh(12));
  const FrameSolution solution = SolveRaySokolov(graph);
  EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
  ExpectFrames(solution, graph);
  EXPECT_NEAR(solution.energy, FrameEnergyOf(graph, solution.frames), 1e-9 * solution.energy);
  EXPECT_LT(solution.energy, 1.03 * FrameEnergyOf(graph, SolveFast<3>(graph, {}).frames));
}

TEST(SolveRaySokolov, CountsNineUnknownsWhereFreeAndTwoAtAnAxis) {
  const FieldGraph graph = GraphOf(MakeBallMesh(4));
  EXPECT_EQ(SolveRaySokolov(graph).size.unknowns, 9u * 27u + 2u * (125u - 27u));
}

TEST(SolveRaySokolov, TakesAnyGraph) {
  for (const FieldGraph& graph : AnyGraphs()) {
    const FrameSolution solution = SolveRaySokolov(graph);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE) << graph.num_vertices();
    ExpectFrames(solution, graph);
    EXPECT_LT(FrameEnergyOf(graph, solution.frames), 1e-6 * static_cast<double>(graph.edges.size() + 1));
  }
}

TEST(SolveRaySokolov, Repeats) { ExpectRepeats(SolveRaySokolov, GraphOf(MakeBallMesh(14))); }
TEST(SolveRaySokolov, StopsWhenItIsToldTo) { ExpectStops(SolveRaySokolov, GraphOf(MakeBallMesh(12))); }
TEST(SolveRaySokolov, RefusesBadInput) { ExpectRefusals(SolveRaySokolov); }

}  // namespace
}  // namespace octupole
