#include "octupole/field/coarse_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"

namespace octupole {
namespace {

FieldGraph Box() {
  const TetMesh mesh = MakeBoxMesh({9, 8, 7}, {9, 8, 7});
  return MakeFieldGraph(mesh, std::vector<Alignment>(mesh.points.size()));
}

double TotalWeight(const FieldGraph& graph) {
  return std::accumulate(graph.edges.begin(), graph.edges.end(), 0.,
                         [](double sum, const WeightedEdge& edge) { return sum + edge.weight; });
}

TEST(BreadthFirstOrder, KeepsComponentsTogetherAndNeighboursClose) {
  // Two paths, 0 2 4 6 and 1 3 5, and a vertex alone.
  const FieldGraph graph = {{{4, 6, 1}, {0, 2, 1}, {2, 4, 1}, {3, 5, 1}, {1, 3, 1}}, std::vector<Alignment>(8)};
  EXPECT_EQ(BreadthFirstOrder(graph), std::vector<int>({0, 2, 4, 6, 1, 3, 5}));
}

TEST(Reorder, RenumbersVertices) {
  const FieldGraph graph = {{{0, 1, 2}}, {Alignment(), Alignment::Axis({1, 0, 0}), Alignment()}};
  const FieldGraph reordered = Reorder(graph, {2, 1, 0});
  ASSERT_EQ(reordered.edges.size(), 1u);
  EXPECT_EQ(reordered.edges[0].a, 2);
  EXPECT_EQ(reordered.edges[0].b, 1);
  EXPECT_EQ(reordered.edges[0].weight, 2);
  EXPECT_EQ(reordered.alignments[1].kind(), AlignmentKind::kAxis);
}

// What a linear function costs is the same whatever cubes a grid is cut into: n^3 cubes of m^3 vertices have n - 1
// layers between them of (n m)^2 edges, across which the function changes by m.
TEST(WeightBetweenClusters, KeepsTheEnergyOfLinearFunctions) {
  for (const int m : {1, 2, 5}) {
    const std::size_t size = m * m * m;
    const double across_a_face = WeightBetweenClusters(m * m, size, size) * m * m;
    EXPECT_NEAR(across_a_face, size, 1e-12 * size) << m;  // as much as its vertices have with edges of weight 1
  }
  // Where a large cube meets a small one, the middles are as far apart as both halves together.
  EXPECT_NEAR(WeightBetweenClusters(1, 27, 1), 1. / 2, 1e-12);
}

TEST(CoarsenGraph, MakesConnectedClustersAndWeighsTheirEdges) {
  FieldGraph graph = Box();
  std::mt19937 generator(1);
  for (WeightedEdge& edge : graph.edges) edge.weight = 1 + RandomDirection(&generator).x() / 2;
  const CoarseGraph coarse = CoarsenGraph(graph);
  EXPECT_NO_THROW(CheckFieldGraph(coarse.graph));
  const std::size_t num_clusters = coarse.graph.num_vertices();
  EXPECT_GT(num_clusters, graph.num_vertices() / 14);
  EXPECT_LT(num_clusters, graph.num_vertices() / 5);

  std::vector<std::size_t> size(num_clusters, 0);
  for (const int cluster : coarse.cluster_of) ++size[cluster];

  // Merging along the edges within clusters leaves one tree per cluster.
  std::vector<int> parent(graph.num_vertices());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v];
    return v;
  };
  double weight_between = 0;
  for (const WeightedEdge& edge : graph.edges) {
    if (coarse.cluster_of[edge.a] == coarse.cluster_of[edge.b]) {
      parent[root(edge.a)] = root(edge.b);
    } else {
      weight_between +=
          WeightBetweenClusters(edge.weight, size[coarse.cluster_of[edge.a]], size[coarse.cluster_of[edge.b]]);
    }
  }
  std::size_t num_trees = 0;
  for (int v = 0; v < static_cast<int>(graph.num_vertices()); ++v) num_trees += root(v) == v;
  EXPECT_EQ(num_trees, num_clusters);
  EXPECT_NEAR(TotalWeight(coarse.graph), weight_between, 1e-9 * weight_between);
}

TEST(CoarsenGraph, KeepsTheStrongestAlignmentThatAgreesBest) {
  // A star of seven around vertex 0.
  FieldGraph graph = {{}, std::vector<Alignment>(7)};
  for (int v = 1; v < 7; ++v) graph.edges.push_back({0, v, 1});
  graph.alignments[1] = Alignment::Axis({1, 0, 0});
  graph.alignments[2] = Alignment::Axis({0, 1, 0.1});
  graph.alignments[3] = Alignment::Axis({0, -1, 0});
  CoarseGraph coarse = CoarsenGraph(graph);
  ASSERT_EQ(coarse.graph.num_vertices(), 1u);
  EXPECT_TRUE(coarse.graph.edges.empty());
  EXPECT_EQ(coarse.graph.alignments[0].kind(), AlignmentKind::kAxis);
  EXPECT_GT(std::abs(coarse.graph.alignments[0].frame()(1, 2)), 0.99);

  graph.alignments[5] = Alignment::Frame(Eigen::Matrix3d::Identity());
  coarse = CoarsenGraph(graph);
  EXPECT_EQ(coarse.graph.alignments[0].kind(), AlignmentKind::kFrame);
}

// A hub with nine neighbours has room for seven: the two that it is tied to least go to the hub that holds them more.
TEST(CoarsenGraph, ClustersTakeTheHeaviestNeighboursFirst) {
  FieldGraph graph = {{}, std::vector<Alignment>(15)};
  for (int v = 1; v <= 9; ++v) graph.edges.push_back({0, v, v <= 2 ? .5 : 1});
  for (int v = 11; v <= 14; ++v) graph.edges.push_back({10, v, 1});
  for (int v = 1; v <= 2; ++v) graph.edges.push_back({10, v, 3});
  const std::vector<int> cluster_of = CoarsenGraph(graph).cluster_of;
  for (int v = 3; v <= 9; ++v) EXPECT_EQ(cluster_of[v], cluster_of[0]) << v;
  for (int v : {1, 2, 11, 12, 13, 14}) EXPECT_EQ(cluster_of[v], cluster_of[10]) << v;
  EXPECT_NE(cluster_of[0], cluster_of[10]);
}

// Two stars of six, and a vertex with two light ties to one and a heavy one to the other.
TEST(CoarsenGraph, TheRestJoinsWhereTiesWeighMost) {
  FieldGraph graph = {{}, std::vector<Alignment>(13)};
  for (int v = 1; v <= 5; ++v) graph.edges.push_back({0, v, 1});
  for (int v = 7; v <= 11; ++v) graph.edges.push_back({6, v, 1});
  graph.edges.insert(graph.edges.end(), {{12, 1, 1}, {12, 2, 1}, {12, 7, 3}});
  const std::vector<int> cluster_of = CoarsenGraph(graph).cluster_of;
  EXPECT_EQ(cluster_of[12], cluster_of[6]);
  EXPECT_NE(cluster_of[0], cluster_of[6]);
}

TEST(CoarsenGraph, LeavesIsolatedVerticesAndComponentsApart) {
  EXPECT_EQ(CoarsenGraph({}).graph.num_vertices(), 0u);
  const FieldGraph graph = {{{0, 1, 1}, {3, 4, 1}, {4, 5, 1}}, std::vector<Alignment>(6)};
  const CoarseGraph coarse = CoarsenGraph(graph);
  EXPECT_EQ(coarse.cluster_of, std::vector<int>({0, 0, 1, 2, 2, 2}));
  EXPECT_TRUE(coarse.graph.edges.empty());
}

TEST(CoarsenGraph, RefusesABadGraph) {
  EXPECT_THROW(CoarsenGraph({{{0, 2, 1}}, std::vector<Alignment>(2)}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
