// What a caller can ask of SolveField beyond a mesh: constraints, weights, a start, a graph of their own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/field/field_graph.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

// The sine of the angle between an axis and the nearest axis of a frame.
double SineToFrame(const Vector3d& axis, const Matrix3d& frame) {
  double sine = 1;
  for (int k = 0; k < 3; ++k) sine = std::min(sine, axis.cross(frame.col(k)).norm());
  return sine;
}

// Every method, the penalty by SolveFast and by Ceres.
struct Road {
  FieldMethod method;
  bool is_ceres;
};

class RoadTest : public testing::TestWithParam<Road> {
 protected:
  template <int kDegree>
  FieldOptions<kDegree> Options() const {
    FieldOptions<kDegree> options;
    options.method = GetParam().method;
    if (GetParam().is_ceres) options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(EveryRoad, RoadTest,
                         testing::Values(Road{FieldMethod::kPenalty, false}, Road{FieldMethod::kPenalty, true},
                                         Road{FieldMethod::kRaySokolov, false}, Road{FieldMethod::kHuang, false},
                                         Road{FieldMethod::kMbo, false}));

// Axes and frames, inside and on the boundary, whatever the boundary asks there; in both degrees.
TEST_P(RoadTest, KeepsToConstraints) {
  const TetMesh mesh = MakeBallMesh(6);
  std::mt19937 generator(1);
  std::vector<Constraint> constraints;
  for (int v = 3; v < static_cast<int>(mesh.points.size()); v += 30) {
    constraints.push_back(
        {v, v % 2 == 0 ? Alignment::Axis(RandomDirection(&generator)) : Alignment::Frame(RandomFrame(&generator))});
  }
  ASSERT_GT(constraints.size(), 10u);
  const auto check = [&](auto options) {
    options.constraints = constraints;
    const auto field = SolveField(mesh, options);
    EXPECT_EQ(field.constraints.num_axes + field.constraints.num_frames, constraints.size());
    EXPECT_GT(field.constraints.num_contradictions, 3u);
    EXPECT_LE(field.constraints.num_contradictions, constraints.size());
    EXPECT_GT(field.constraints.largest_contradiction_deg, 5);
    for (const auto& [vertex, alignment] : constraints) {
      for (int k = alignment.kind() == AlignmentKind::kFrame ? 0 : 2; k < 3; ++k) {
        EXPECT_LT(SineToFrame(alignment.frame().col(k), field.frames[vertex]), 1e-12) << vertex;
      }
    }
  };
  check(Options<3>());
  check(Options<4>());
}

// On a mesh without a boundary to follow, one frame inside is all that there is to follow.
TEST_P(RoadTest, FollowsOneFrameWhereNothingElseIsAsked) {
  const TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const FieldGraph graph = MakeFieldGraph(mesh, std::vector<Alignment>(mesh.points.size()));
  std::mt19937 generator(2);
  const Matrix3d frame = RandomFrame(&generator);
  FieldOptions<3> options = Options<3>();
  options.constraints = {{62, Alignment::Frame(frame)}};
  const Field<3> field = SolveField<3>(graph, options);
  EXPECT_EQ(field.constraints.num_contradictions, 0u);
  EXPECT_EQ(field.alignment.alignments[62].kind(), AlignmentKind::kFrame);
  for (const Matrix3d& f : field.frames) EXPECT_LT(FrameDifference<4>(f, frame), 1e-3);
}

// A graph of a mesh gives what the mesh gives.
TEST_P(RoadTest, SolvesAnyGraph) {
  const TetMesh mesh = MakeBallMesh(4);
  const FieldOptions<3> options = Options<3>();
  const Field<3> of_mesh = SolveField<3>(mesh, options);
  const Field<3> of_graph = SolveField<3>(MakeFieldGraph(mesh, AlignToBoundary(mesh).alignments), options);
  EXPECT_EQ(of_graph.frames, of_mesh.frames);
  EXPECT_EQ(of_graph.coefficients, of_mesh.coefficients);
  EXPECT_EQ(of_graph.energy, of_mesh.energy);
  EXPECT_EQ(of_graph.ceres_summary.has_value(), GetParam().is_ceres);
  EXPECT_EQ(of_graph.alignment.alignments.size(), mesh.points.size());
  EXPECT_EQ(of_graph.alignment.num_normals, 0u);
}

TEST(SolveField, RefusesABadGraph) {
  EXPECT_THROW(SolveField<3>(FieldGraph{{{0, 5, 1}}, std::vector<Alignment>(2)}), std::invalid_argument);
}

// The more it weighs, the nearer; a box's own field has its axes along the coordinates.
TEST(SolveField, KeepsToSoftConstraintsByTheirWeight) {
  const TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  FieldOptions<3> options;
  options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
  const Vector3d axis(std::sin(0.3), 0, std::cos(0.3));
  options.constraints = {{62, Alignment::Axis(axis)}};
  double last = 1;
  for (const double weight : {0., 30., 1000., 1e5}) {
    options.constraint_weight = weight;
    const Field<3> field = SolveField<3>(mesh, options);
    EXPECT_EQ(field.alignment.alignments[62].kind(), AlignmentKind::kFree);
    EXPECT_EQ(field.constraints.num_axes, 1u);
    const double sine = SineToFrame(axis, field.frames[62]);
    EXPECT_LT(sine, 0.9 * last) << weight;
    if (weight == 0) {
      EXPECT_NEAR(sine, std::sin(0.3), 1e-3);
    }
    last = sine;
  }
  EXPECT_LT(last, 0.01);
  options.solver.reset();
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { SolveField<3>(mesh, options); }), HasSubstr("only Ceres"));
}

TEST(SolveField, RefusesBadConstraintsAndStarts) {
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  FieldOptions<3> options;
  options.constraints = {{27, Alignment::Axis({1, 0, 0})}};
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { SolveField<3>(mesh, options); }),
              HasSubstr("constraint 0 of vertex 27, out of range 0..26"));
  options = {};
  options.start_frames.assign(26, Matrix3d::Identity());
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { SolveField<3>(mesh, options); }),
              HasSubstr("26 frames for 27 vertices"));
  options.start.assign(27, ReferenceHarmonic<3>());
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { SolveField<3>(mesh, options); }), HasSubstr("both"));
  options = {};
  options.start_frames.assign(27, Matrix3d::Identity());
  options.method = FieldMethod::kMbo;
  EXPECT_THROW(SolveField<3>(mesh, options), std::invalid_argument);
  // Ceres takes them, too.
  options.method = FieldMethod::kPenalty;
  options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
  EXPECT_LE(SolveField<3>(mesh, options).iterations.size(), 1u) << "the start is the solution";
}

// A bar that is twisted by 40 degrees from end to end, its layers ten times as thick at the top as at the bottom: the
// twist is even in space only if edges weigh by their lengths.
TEST(SolveField, HeedsTheLengthsOfEdgesWithFiniteElementWeights) {
  constexpr int kLayers = 20;
  TetMesh mesh = MakeBoxMesh({3, 3, kLayers}, {1, 1, kLayers});
  const auto graded = [](double z) { return (std::pow(10., z / kLayers) - 1) / 9; };
  for (Vector3d& p : mesh.points) p.z() = graded(p.z());
  const auto turned = [](double degrees) {
    return Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vector3d::UnitZ()).toRotationMatrix();
  };
  std::vector<Alignment> alignments(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mesh.points[v].z() == 0) alignments[v] = Alignment::Frame(turned(0));
    if (mesh.points[v].z() == 1) alignments[v] = Alignment::Frame(turned(40));
  }
  for (const EdgeWeights weights : {EdgeWeights::kUniform, EdgeWeights::kFiniteElement}) {
    FieldGraph graph = MakeFieldGraph(mesh, alignments, weights);
    const double mean = MeanEdgeWeight(graph);
    for (WeightedEdge& edge : graph.edges) edge.weight /= mean;
    const Field<3> field = SolveField<3>(graph);
    double largest = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const double difference = FrameDifference<4>(field.frames[v], turned(40 * mesh.points[v].z()));
      largest = std::max<double>(largest, std::sqrt(difference * 3 / 20) * 180 / EIGEN_PI);
    }
    if (weights == EdgeWeights::kFiniteElement) {
      EXPECT_LT(largest, 1) << "degrees";
    } else {
      EXPECT_GT(largest, 8) << "degrees";
    }
  }
}

// The field of a mesh does not depend on its unit of length, nor on what its penalties are scaled by.
TEST(SolveField, ScalesItsPenaltiesWithFiniteElementWeights) {
  TetMesh mesh = MakeBallMesh(6);
  FieldOptions<3> options;
  options.edge_weights = EdgeWeights::kFiniteElement;
  const Field<3> small = SolveField<3>(mesh, options);
  for (Vector3d& p : mesh.points) p *= 1024;
  const Field<3> large = SolveField<3>(mesh, options);
  EXPECT_NEAR(large.energy, 1024 * small.energy, 1e-6 * large.energy);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_LT(FrameDifference<4>(large.frames[v], small.frames[v]), 1e-6);
  }
}

}  // namespace
}  // namespace octupole
