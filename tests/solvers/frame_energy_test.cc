#include "octupole/solvers/frame_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "gradient_check.h"
#include "octupole/alignment/aligned_frame.h"
#include "octupole/alignment/alignment.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_problem.h"
#include "random_inputs.h"

namespace octupole {
namespace {

FieldGraph AnyGraph(bool is_weighted) {
  const TetMesh mesh = MakeBoxMesh({3, 3, 2}, {3, 3, 2});
  std::mt19937 generator(1);
  std::vector<Alignment> alignments;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    alignments.push_back(v % 3 == 1   ? Alignment::Axis(RandomDirection(&generator))
                         : v % 5 == 4 ? Alignment::Frame(RandomFrame(&generator))
                                      : Alignment());
  }
  FieldGraph graph = MakeFieldGraph(mesh, alignments);
  if (!is_weighted) return graph;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) graph.edges[e].weight = 0.3 * static_cast<double>(e % 7);
  return graph;
}

std::vector<Eigen::Matrix3d> AnyFrames(const FieldGraph& graph) {
  std::vector<Eigen::Matrix3d> frames;
  const std::vector<Octupole> field = RandomField<3>(graph, 1);
  for (std::size_t v = 0; v < field.size(); ++v)
    frames.push_back(NearestAlignedFrame<3>(graph.alignments[v], field[v]));
  return frames;
}

std::vector<double> AnyParameters(int size) {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  std::vector<double> x(size);
  for (double& value : x) value = normal(generator);
  return x;
}

TEST(FrameEnergy, IsHalfTheSumOfFrameDifferences) {
  for (const bool is_weighted : {false, true}) {
    const FieldGraph graph = AnyGraph(is_weighted);
    Workers workers(2);
    const FrameEnergy energy(graph, AnyFrames(graph), &workers);
    const std::vector<double> x = AnyParameters(energy.NumParameters());
    double cost = 0;
    ASSERT_TRUE(energy.Evaluate(x.data(), &cost, nullptr));
    const std::vector<Eigen::Matrix3d> frames = energy.FramesOf(x);
    double sum = 0;
    for (const WeightedEdge& edge : graph.edges)
      sum += edge.weight * FrameDifference<4>(frames[edge.a], frames[edge.b]);
    EXPECT_NEAR(2 * cost, sum, 1e-12 * sum);
  }
}

// Soft alignment, written out: three parameters everywhere, and the squared distances from what is allowed.
TEST(FrameEnergy, AddsTheDistancesOfSoftAlignments) {
  const FieldGraph graph = AnyGraph(true);
  Workers workers(2);
  const FrameEnergy energy(graph, AnyFrames(graph), &workers, /*soft_weight=*/7.);
  ASSERT_EQ(energy.NumParameters(), 3 * static_cast<int>(graph.num_vertices()));
  const std::vector<double> x = AnyParameters(energy.NumParameters());
  double cost = 0;
  ASSERT_TRUE(energy.Evaluate(x.data(), &cost, nullptr));
  const std::vector<Eigen::Matrix3d> frames = energy.FramesOf(x);
  double sum = 0;
  for (const WeightedEdge& edge : graph.edges) sum += edge.weight * FrameDifference<4>(frames[edge.a], frames[edge.b]);
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const Alignment& alignment = graph.alignments[v];
    const Hexadecapole h = HarmonicFromFrame<4>(frames[v]);
    if (alignment.kind() == AlignmentKind::kAxis) {
      sum += 7 * (h - AlignedSubspace<4>(alignment).Project(h)).squaredNorm();
    } else if (alignment.kind() == AlignmentKind::kFrame) {
      sum += 7 * FrameDifference<4>(frames[v], alignment.frame());
    }
  }
  EXPECT_NEAR(2 * cost, sum, 1e-12 * sum);
}

class FrameEnergyGradient : public testing::TestWithParam<std::optional<double>> {};
INSTANTIATE_TEST_SUITE_P(HardAndSoft, FrameEnergyGradient, testing::Values(std::nullopt, 7.));

TEST_P(FrameEnergyGradient, IsTheNumericOne) {
  const FieldGraph graph = AnyGraph(true);
  Workers workers(1);
  const FrameEnergy energy(graph, AnyFrames(graph), &workers, GetParam());
  ExpectNumericGradient(energy, AnyParameters(energy.NumParameters()), 1e-6, 1e-7);
}

TEST(FrameEnergy, KeepsAlignmentsAndStartsFromTheGivenFrames) {
  const FieldGraph graph = AnyGraph(false);
  const std::vector<Eigen::Matrix3d> start = AnyFrames(graph);
  Workers workers(1);
  const FrameEnergy energy(graph, start, &workers);
  const std::vector<Eigen::Matrix3d> same = energy.FramesOf(std::vector<double>(energy.NumParameters(), 0));
  const std::vector<Eigen::Matrix3d> turned = energy.FramesOf(AnyParameters(energy.NumParameters()));
  for (std::size_t v = 0; v < start.size(); ++v) {
    EXPECT_LT((same[v] - start[v]).norm(), 1e-14);
    EXPECT_NO_THROW(CheckRotation("test", turned[v]));
    const AlignmentKind kind = graph.alignments[v].kind();
    if (kind == AlignmentKind::kAxis) {
      EXPECT_LT((turned[v].col(2) - start[v].col(2)).norm(), 1e-14);
    }
    if (kind == AlignmentKind::kFrame) {
      EXPECT_EQ(turned[v], start[v]);
    }
  }
}

TEST(FrameEnergy, RefusesBadInput) {
  Workers workers(1);
  EXPECT_THROW(FrameEnergy({{{0, 2, 1}}, std::vector<Alignment>(2)}, {}, &workers), std::invalid_argument);
  const FieldGraph graph = AnyGraph(false);
  EXPECT_THROW(FrameEnergy(graph, {}, &workers), std::invalid_argument);
  EXPECT_THROW(FrameEnergy(graph, AnyFrames(graph), &workers, -1), std::invalid_argument);
  EXPECT_THROW(FrameEnergy(graph, AnyFrames(graph), &workers).FramesOf({}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
