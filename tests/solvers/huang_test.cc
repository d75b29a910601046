#include "octupole/solvers/huang.h"

#include <gtest/gtest.h>

#include <cmath>

#include "method_checks.h"
#include "octupole/alignment/alignment.h"
#include "octupole/field/field_quality.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

FrameSolution Solve(const FieldGraph& graph, const MinimizerOptions& options) { return SolveHuang(graph, options); }

// Alignment is soft, so the constant field is met to the accuracy of the descent.
constexpr double kSoft = 1e-4;

TEST(SolveHuang, FindsTheConstantFieldOfABoxFromEverySeed) {
  const FieldGraph graph = GraphOf(MakeBoxMesh({9, 7, 8}, {9, 7, 8}));
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    MinimizerOptions options;
    options.seed = seed;
    const FrameSolution solution = SolveHuang(graph, options);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
    EXPECT_LT(solution.energy, 1e-6 * static_cast<double>(graph.edges.size())) << "seed " << seed;
    ExpectFrames(solution, graph, kSoft);
  }
}

// The energy written out: smoothness, and a hundred times the squared distances from what the alignments allow.
TEST(SolveHuang, SaysTheEnergyThatItMinimises) {
  const FieldGraph graph = GraphOf(MakeBallMesh(6));
  const FrameSolution solution = SolveHuang(graph);
  double energy = FrameEnergyOf(graph, solution.frames);
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const Hexadecapole h = HarmonicFromFrame<4>(solution.frames[v]);
    energy += 100 * (h - AlignedSubspace<4>(graph.alignments[v]).Project(h)).squaredNorm();
  }
  EXPECT_NEAR(solution.energy, energy, 1e-9 * energy);
}

// Below the energy of hard alignment, for a boundary error that shows and is small.
TEST(SolveHuang, PaysForSmoothnessWithABoundaryError) {
  const TetMesh mesh = MakeBallMesh(12);
  const FieldGraph graph = GraphOf(mesh);
  const FrameSolution solution = SolveHuang(graph);
  EXPECT_EQ(solution.termination, ceres::CONVERGENCE);
  const FieldQuality quality = MeasureField(mesh, solution.frames);
  EXPECT_GT(quality.boundary_rms_deg, 0.01);
  EXPECT_LT(quality.boundary_rms_deg, 1);
  const double hard = FrameEnergyOf(graph, SolveFast<3>(graph, {}).frames);
  EXPECT_LT(quality.energy4, 1.03 * hard);
  EXPECT_GT(quality.energy4, 0.9 * hard);
}

TEST(SolveHuang, ReachesAnAxisAndAFrameOfVerticesAlone) {
  std::mt19937 generator(4);
  const FieldGraph graph = {{},
                            {Alignment::Axis(RandomDirection(&generator)), Alignment::Frame(RandomFrame(&generator))}};
  const FrameSolution solution = SolveHuang(graph);
  EXPECT_LT(solution.energy, 1e-8);
  ExpectFrames(solution, graph, kSoft);
}

TEST(SolveHuang, KeepsHardVerticesExactly) {
  const FieldGraph graph = GraphOf(MakeBallMesh(8));
  const std::vector<int> hard = {0, 5, 40};  // of the boundary
  const FrameSolution solution = SolveHuang(graph, {}, hard);
  for (const int v : hard) {
    ASSERT_NE(graph.alignments[v].kind(), AlignmentKind::kFree);
    FrameSolution alone;
    alone.frames = {solution.frames[v]};
    ExpectFrames(alone, {{}, {graph.alignments[v]}});
  }
  EXPECT_THROW(SolveHuang(graph, {}, {-1}), std::invalid_argument);
  EXPECT_THROW(SolveHuang(graph, {}, {9 * 9 * 9}), std::invalid_argument);
}

TEST(SolveHuang, CountsThreeUnknownsEverywhere) {
  EXPECT_EQ(SolveHuang(GraphOf(MakeBallMesh(4))).size.unknowns, 3u * 125u);
}

TEST(SolveHuang, TakesAnyGraph) {
  for (const FieldGraph& graph : AnyGraphs()) {
    const FrameSolution solution = SolveHuang(graph);
    EXPECT_EQ(solution.termination, ceres::CONVERGENCE) << graph.num_vertices();
    ExpectFrames(solution, graph, kSoft);
    EXPECT_LT(FrameEnergyOf(graph, solution.frames), 1e-5 * static_cast<double>(graph.edges.size() + 1));
  }
}

TEST(SolveHuang, Repeats) { ExpectRepeats(Solve, GraphOf(MakeBallMesh(14))); }
// Until it has converged its boundary is anywhere.
TEST(SolveHuang, StopsWhenItIsToldTo) { ExpectStops(Solve, GraphOf(MakeBallMesh(12)), /*tolerance=*/2); }
TEST(SolveHuang, RefusesBadInput) { ExpectRefusals(Solve); }

}  // namespace
}  // namespace octupole
