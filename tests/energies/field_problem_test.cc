#include "octupole/energies/field_problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/harmonics/quadrics.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class FieldProblemTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(FieldProblemTest, Degrees);

// Two free vertices, an axis and a frame, joined by edges of different weights.
FieldGraph SmallGraph() {
  std::mt19937 generator(1);
  return {{{0, 1, 1}, {0, 2, 1}, {1, 3, 2.5}, {2, 3, 0}},
          {Alignment(), Alignment(), Alignment::Axis(RandomDirection(&generator)),
           Alignment::Frame(RandomFrame(&generator))}};
}

template <int kDegree>
std::vector<Harmonic<kDegree>> AnyField(std::size_t size) {
  std::mt19937 generator(2);
  std::vector<Harmonic<kDegree>> field;
  while (field.size() < size) field.push_back(RandomHarmonic<kDegree>(&generator));
  return field;
}

// The energy written out (paper, eq. 5.1), with the terms that hard alignment leaves.
TYPED_TEST(FieldProblemTest, HasHalfTheEnergyAsCost) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  std::vector<Harmonic<l>> field = AnyField<l>(4);
  ceres::Problem problem;
  const EnergyWeights weights = {3, 0.7};
  BuildFieldProblem<l>(graph, weights, &field, &problem);
  double energy = 0;
  for (const WeightedEdge& edge : graph.edges) {
    const Harmonic<l> a = field[edge.a], b = field[edge.b];
    energy += edge.weight * (l == 3 ? (a - b).squaredNorm() * (a + b).squaredNorm() : (a - b).squaredNorm());
  }
  for (int v = 0; v < 3; ++v) energy += weights.scale * std::pow(field[v].squaredNorm() - 1, 2);
  for (int v = 0; v < 2; ++v) energy += weights.deviation * Deviation<l>(field[v]);
  double cost = 0;
  ceres::Problem::EvaluateOptions options;
  ASSERT_TRUE(problem.Evaluate(options, &cost, nullptr, nullptr, nullptr));
  EXPECT_NEAR(2 * cost, energy, 1e-12 * energy);
}

TYPED_TEST(FieldProblemTest, SetsUpOneBlockPerVertexWithItsFreedom) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  std::vector<Harmonic<l>> field = AnyField<l>(4);
  ceres::Problem problem;
  BuildFieldProblem<l>(graph, {}, &field, &problem);
  EXPECT_EQ(problem.NumParameterBlocks(), 4);
  // Three edges of positive weight, three scales, two deviations.
  EXPECT_EQ(problem.NumResidualBlocks(), 3 + 3 + 2);
  EXPECT_EQ(problem.ParameterBlockTangentSize(field[0].data()), kDimension<l>);
  EXPECT_EQ(problem.ParameterBlockTangentSize(field[2].data()), 2);
  EXPECT_FALSE(problem.IsParameterBlockConstant(field[2].data()));
  EXPECT_TRUE(problem.IsParameterBlockConstant(field[3].data()));
}

// Ceres' own count, and that of the entries of J^T J when it stores blocks.
TYPED_TEST(FieldProblemTest, HasTheSizeThatTheGraphSays) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  std::vector<Harmonic<l>> field = AnyField<l>(4);
  ceres::Problem problem;
  BuildFieldProblem<l>(graph, {}, &field, &problem);
  std::size_t unknowns = 0, nonzeros = 0;
  for (Harmonic<l>& a : field) {
    if (problem.IsParameterBlockConstant(a.data())) continue;
    unknowns += problem.ParameterBlockTangentSize(a.data());
    for (Harmonic<l>& b : field) {
      if (problem.IsParameterBlockConstant(b.data())) continue;
      std::vector<ceres::ResidualBlockId> of_a, of_b;
      problem.GetResidualBlocksForParameterBlock(a.data(), &of_a);
      problem.GetResidualBlocksForParameterBlock(b.data(), &of_b);
      const bool are_coupled = std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
      if (!are_coupled) continue;
      nonzeros += problem.ParameterBlockTangentSize(a.data()) * problem.ParameterBlockTangentSize(b.data());
    }
  }
  const ProblemSize size = SizeOfProblem(graph, kUnknownsOfKind<l>);
  EXPECT_EQ(size.unknowns, unknowns);
  EXPECT_EQ(size.nonzeros, nonzeros);
}

TYPED_TEST(FieldProblemTest, MovesStartingValuesToTheirAlignment) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  const std::vector<Harmonic<l>> start = AnyField<l>(4);
  std::vector<Harmonic<l>> field = start;
  ceres::Problem problem;
  BuildFieldProblem<l>(graph, {}, &field, &problem);
  EXPECT_EQ(field[0], start[0]);
  const AlignedSubspace<l> axis(graph.alignments[2]);
  EXPECT_LT((field[2] - axis.Project(start[2])).norm(), 1e-14);
  const Harmonic<l> frame = HarmonicFromFrame<l>(graph.alignments[3].frame());
  EXPECT_NEAR(std::abs(field[3].dot(frame)), 1, 1e-14);
  if (l == 3) {
    EXPECT_GT(field[3].dot(start[3]), 0) << "the sign nearer to the start";
  }
}

TYPED_TEST(FieldProblemTest, RandomFieldKeepsToTheAlignmentsAndRepeatsWithItsSeed) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  const std::vector<Harmonic<l>> field = RandomField<l>(graph, 7);
  ASSERT_EQ(field.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(field[v].norm(), 1, 1e-14);
    EXPECT_LT(Deviation<l>(field[v]), 1e-25);
    EXPECT_LT((AlignedSubspace<l>(graph.alignments[v]).Project(field[v]) - field[v]).norm(), 1e-13);
  }
  EXPECT_EQ(RandomField<l>(graph, 7), field);
  EXPECT_NE(RandomField<l>(graph, 8), field);
}

TYPED_TEST(FieldProblemTest, RefusesBadInputAndLeavesTheProblemAlone) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = SmallGraph();
  ceres::Problem problem;
  std::vector<Harmonic<l>> field = AnyField<l>(3);
  EXPECT_THROW(BuildFieldProblem<l>(graph, {}, &field, &problem), std::invalid_argument);
  field = AnyField<l>(4);
  EXPECT_THROW(BuildFieldProblem<l>(graph, {-1, 1}, &field, &problem), std::invalid_argument);
  EXPECT_THROW(BuildFieldProblem<l>(graph, {1, std::numeric_limits<double>::quiet_NaN()}, &field, &problem),
               std::invalid_argument);
  FieldGraph bad_graph = graph;
  bad_graph.edges[0].b = 4;
  EXPECT_THROW(BuildFieldProblem<l>(bad_graph, {}, &field, &problem), std::invalid_argument);
  field[1][2] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(BuildFieldProblem<l>(graph, {}, &field, &problem), std::invalid_argument);
  EXPECT_EQ(problem.NumParameterBlocks(), 0);
  EXPECT_EQ(problem.NumResidualBlocks(), 0);
}

}  // namespace
}  // namespace octupole
