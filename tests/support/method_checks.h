#pragma once

#include <ceres/iteration_callback.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ball_mesh.h"
#include "octupole/alignment/boundary_alignment.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_solution.h"
#include "random_inputs.h"

namespace octupole {

// What is asked of every method: of SolveFast and of the classics.

inline FieldGraph GraphOf(const TetMesh& mesh) { return MakeFieldGraph(mesh, AlignToBoundary(mesh).alignments); }

inline double FrameEnergyOf(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames) {
  double sum = 0;
  for (const WeightedEdge& edge : graph.edges) sum += edge.weight * FrameDifference<4>(frames[edge.a], frames[edge.b]);
  return sum;
}

/// Right-handed orthonormal frames that keep to the alignments.
inline void ExpectFrames(const FrameSolution& solution, const FieldGraph& graph, double tolerance = 1e-12) {
  ASSERT_EQ(solution.frames.size(), graph.num_vertices());
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const Eigen::Matrix3d& frame = solution.frames[v];
    EXPECT_NO_THROW(CheckRotation("test", frame));
    const Eigen::Matrix3d prescribed = graph.alignments[v].frame();
    if (graph.alignments[v].kind() == AlignmentKind::kAxis) {
      EXPECT_NEAR((frame.transpose() * prescribed.col(2)).cwiseAbs().maxCoeff(), 1, tolerance) << v;
    } else if (graph.alignments[v].kind() == AlignmentKind::kFrame) {
      EXPECT_NEAR(FrameDifference<4>(frame, prescribed), 0, tolerance) << v;
    }
  }
}

/// Graphs at the edge of what a graph is, on all of which the smoothest field is constant in each component.
inline std::vector<FieldGraph> AnyGraphs() {
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
  TetMesh tet;
  tet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tet.tets = {{0, 1, 2, 3}};
  return {FieldGraph{},
          FieldGraph{{}, {Alignment()}},
          FieldGraph{{}, {axis, frame, Alignment()}},
          FieldGraph{{}, std::vector<Alignment>(300)},
          FieldGraph{{{0, 1, 2}}, {frame, frame}},
          FieldGraph{{{0, 1, 0}, {1, 2, 3}}, {Alignment(), axis, frame}},
          MakeFieldGraph(tet, std::vector<Alignment>(4)),
          GraphOf(MakeBoxMesh({1, 1, 1}, {1, 1, 1})),
          grids,
          weightless};
}

using Solve = std::function<FrameSolution(const FieldGraph&, const MinimizerOptions&)>;

/// The same frames again, with two threads, too.
inline void ExpectRepeats(const Solve& solve, const FieldGraph& graph) {
  MinimizerOptions options;
  options.seed = 5;
  options.max_iterations = 120;
  const FrameSolution one = solve(graph, options);
  EXPECT_EQ(solve(graph, options).frames, one.frames);
  options.num_threads = 2;
  const FrameSolution two = solve(graph, options);
  EXPECT_EQ(two.frames, one.frames);
  EXPECT_EQ(two.energy, one.energy);
}

/// A method ends when its callback says so or its iterations are spent, with a complete field. `graph` must take more
/// than 40 iterations.
inline void ExpectStops(const Solve& solve, const FieldGraph& graph, double tolerance = 1e-12) {
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
  for (const int last : {1, 30}) {
    Stop stop(last);
    MinimizerOptions options;
    options.callback = &stop;
    const FrameSolution solution = solve(graph, options);
    EXPECT_EQ(solution.termination, ceres::USER_SUCCESS);
    EXPECT_TRUE(solution.IsUsable());
    EXPECT_EQ(solution.iterations.size(), static_cast<std::size_t>(last));
    ExpectFrames(solution, graph, tolerance);
  }
  for (const int last : {0, 40}) {
    MinimizerOptions options;
    options.max_iterations = last;
    const FrameSolution solution = solve(graph, options);
    EXPECT_EQ(solution.termination, ceres::NO_CONVERGENCE);
    EXPECT_TRUE(solution.IsUsable());
    EXPECT_EQ(solution.iterations.size(), static_cast<std::size_t>(last));
    ExpectFrames(solution, graph, tolerance);
  }
}

inline void ExpectRefusals(const Solve& solve) {
  EXPECT_THROW(solve({{{0, 2, 1}}, std::vector<Alignment>(2)}, {}), std::invalid_argument);
  MinimizerOptions options;
  options.num_threads = 0;
  EXPECT_THROW(solve(GraphOf(MakeBoxMesh({1, 1, 1}, {1, 1, 1})), options), std::invalid_argument);
  const FieldGraph infinite = {{{0, 1, 1e308}, {1, 2, 1e308}, {0, 2, 1e308}}, std::vector<Alignment>(3)};
  const FrameSolution failure = solve(infinite, {});
  EXPECT_EQ(failure.termination, ceres::FAILURE);
  EXPECT_FALSE(failure.IsUsable());
}

/// A free vertex tied to two frames that are near each other. The smoothest frame there is known: the nearest to the
/// weighted mean of their harmonics.
struct Between {
  Between() {
    std::mt19937 generator(3);
    const Eigen::Matrix3d a = RandomFrame(&generator);
    const Eigen::Matrix3d b = a * Eigen::AngleAxisd(0.5, RandomDirection(&generator)).toRotationMatrix();
    graph = {{{0, 1, 2}, {1, 2, 3}}, {Alignment::Frame(a), Alignment(), Alignment::Frame(b)}};
    smoothest = NearestFrame<4>(2 * HarmonicFromFrame<4>(a) + 3 * HarmonicFromFrame<4>(b));
  }

  FieldGraph graph;
  Eigen::Matrix3d smoothest;
};

}  // namespace octupole
