#include "octupole/energies/frame_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "any_graph.h"
#include "gradient_check.h"
#include "octupole/alignment/alignment.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

TEST(FrameEnergy, IsHalfTheSumOfFrameDifferences) {
  for (const bool is_weighted : {false, true}) {
    const FieldGraph graph = AnyGraph({3, 3, 2}, /*num_isolated=*/0, is_weighted);
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
  const FieldGraph graph = AnyGraph({3, 3, 2}, /*num_isolated=*/0, true);
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
  const FieldGraph graph = AnyGraph({3, 3, 2}, /*num_isolated=*/0, true);
  Workers workers(1);
  const FrameEnergy energy(graph, AnyFrames(graph), &workers, GetParam());
  ExpectNumericGradient(energy, AnyParameters(energy.NumParameters()), 1e-6, 1e-7);
}

TEST(FrameEnergy, KeepsAlignmentsAndStartsFromTheGivenFrames) {
  const FieldGraph graph = AnyGraph({3, 3, 2}, /*num_isolated=*/0, false);
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
  const FieldGraph graph = AnyGraph({3, 3, 2}, /*num_isolated=*/0, false);
  EXPECT_THROW(FrameEnergy(graph, {}, &workers), std::invalid_argument);
  EXPECT_THROW(FrameEnergy(graph, AnyFrames(graph), &workers, -1), std::invalid_argument);
  EXPECT_THROW(FrameEnergy(graph, AnyFrames(graph), &workers).FramesOf({}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
