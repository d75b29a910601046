#include "octupole/field/field_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ball_mesh.h"
#include "octupole/mesh/box_mesh.h"

namespace octupole {
namespace {

TEST(MakeFieldGraph, TakesVerticesAndEdgesOfTheMesh) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  std::vector<Alignment> alignments(8);
  alignments[3] = Alignment::Axis({1, 0, 0});
  const FieldGraph graph = MakeFieldGraph(mesh, alignments);
  EXPECT_EQ(graph.num_vertices(), 8u);
  EXPECT_EQ(graph.alignments[3].kind(), AlignmentKind::kAxis);
  // A cube in six tets: 12 edges, 6 face diagonals, 1 through the middle.
  EXPECT_EQ(graph.edges.size(), 19u);
  for (const WeightedEdge& edge : graph.edges) {
    EXPECT_LT(edge.a, edge.b);
    EXPECT_EQ(edge.weight, 1);
  }
  EXPECT_NO_THROW(CheckFieldGraph(graph));
}

// Of a function that is linear in space: the squared gradient times the volume, whatever the cells' sizes. A grid of
// boxes has no negative weights.
TEST(MakeFieldGraph, HasFiniteElementWeights) {
  TetMesh mesh = MakeBoxMesh({4, 3, 5}, {2, 1, 3});
  for (Eigen::Vector3d& p : mesh.points) p.z() *= p.z();  // graded, up to z = 9
  for (std::size_t t = 0; t < mesh.tets.size(); t += 3) std::swap(mesh.tets[t][0], mesh.tets[t][1]);  // inverted
  const Eigen::Vector3d gradient(1, -2, 3);
  const auto energy = [&](const TetMesh& m) {
    const FieldGraph graph = MakeFieldGraph(m, std::vector<Alignment>(m.points.size()), EdgeWeights::kFiniteElement);
    EXPECT_NO_THROW(CheckFieldGraph(graph));
    double sum = 0;
    for (const auto& [a, b, weight] : graph.edges) {
      sum += weight * std::pow(gradient.dot(m.points[a] - m.points[b]), 2);
    }
    return sum;
  };
  EXPECT_NEAR(energy(mesh), gradient.squaredNorm() * 2 * 1 * 9, 1e-10);
  // Negative sums count as nothing, which can only add to the energy.
  EXPECT_GT(energy(MakeBallMesh(6)), gradient.squaredNorm() * 0.98 * 4. / 3 * EIGEN_PI * 0.9);
}

TEST(MakeFieldGraph, HasCotangentWeightsOnASurface) {
  // A square of sides 3 and 1 in two triangles: half the cotangents are 1/6 and 3/2, and 0 on the diagonal.
  const TriangleMesh square = {{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const FieldGraph graph = MakeFieldGraph(square, std::vector<Alignment>(4), EdgeWeights::kFiniteElement);
  ASSERT_EQ(graph.edges.size(), 5u);
  for (const auto& [a, b, weight] : graph.edges) {
    const double length = (square.points[a] - square.points[b]).norm();
    EXPECT_NEAR(weight, length == 3 ? 1. / 6 : length == 1 ? 3. / 2 : 0, 1e-14) << a << " " << b;
  }
}

TEST(MakeFieldGraph, HasFiniteWeightsOnFlatCells) {
  const TetMesh flat = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 2}}, {{0, 1, 2, 3}, {4, 0, 1, 2}}, {}};
  const TetMesh point = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2, 3}}, {}};
  for (const TetMesh& mesh : {flat, point}) {
    const FieldGraph graph =
        MakeFieldGraph(mesh, std::vector<Alignment>(mesh.points.size()), EdgeWeights::kFiniteElement);
    EXPECT_NO_THROW(CheckFieldGraph(graph));
    EXPECT_LT(MeanEdgeWeight(graph), 100);
  }
}

TEST(MakeFieldGraph, WantsOneAlignmentPerPoint) {
  EXPECT_THROW(MakeFieldGraph(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), std::vector<Alignment>(7)), std::invalid_argument);
}

TEST(CheckFieldGraph, NamesTheBadEdge) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const WeightedEdge& bad : {WeightedEdge{0, 3, 1}, WeightedEdge{-1, 1, 1}, WeightedEdge{1, 1, 1},
                                  WeightedEdge{0, 1, -1}, WeightedEdge{0, 1, nan}}) {
    const FieldGraph graph = {{{0, 1, 1}, bad}, std::vector<Alignment>(3)};
    EXPECT_THROW(CheckFieldGraph(graph), std::invalid_argument);
  }
  try {
    CheckFieldGraph({{{0, 1, 1}, {0, 3, 2.5}}, std::vector<Alignment>(3)});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "CheckFieldGraph: edge 1 (0, 3) of weight 2.5 in a graph of 3 vertices");
  }
}

// Two free vertices, one with an axis and one with a frame; one edge does not count.
TEST(SizeOfProblem, AddsUpBlocks) {
  const FieldGraph graph = {
      {{0, 1, 1}, {0, 2, 2.5}, {1, 3, 1}, {1, 2, 0}},
      {Alignment(), Alignment(), Alignment::Axis({1, 2, 3}), Alignment::Frame(Eigen::Matrix3d::Identity())}};
  EXPECT_EQ(SumOfWeights(graph), 4.5);
  EXPECT_EQ(MeanEdgeWeight(graph), 4.5 / 4);
  EXPECT_EQ(MeanEdgeWeight({}), 1);
  const ProblemSize size = SizeOfProblem(graph, {7, 2, 0});
  EXPECT_EQ(size.unknowns, 7u + 7u + 2u);
  EXPECT_EQ(size.nonzeros, 49u + 49u + 4u + 2u * 49u + 2u * 14u);
  EXPECT_EQ(SizeOfProblem(graph, {3, 3, 3}).unknowns, 12u);
  EXPECT_EQ(SizeOfProblem({}, {7, 2, 0}).nonzeros, 0u);
}

}  // namespace
}  // namespace octupole
