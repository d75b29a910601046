#include "octupole/field/field_graph.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

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
  const ProblemSize size = SizeOfProblem(graph, {7, 2, 0});
  EXPECT_EQ(size.unknowns, 7u + 7u + 2u);
  EXPECT_EQ(size.nonzeros, 49u + 49u + 4u + 2u * 49u + 2u * 14u);
  EXPECT_EQ(SizeOfProblem(graph, {3, 3, 3}).unknowns, 12u);
  EXPECT_EQ(SizeOfProblem({}, {7, 2, 0}).nonzeros, 0u);
}

}  // namespace
}  // namespace octupole
