#include "octupole/field/field_graph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using internal::kTetEdges;
using internal::kTriangleEdges;

// Six times the volume of a tetrahedron, or twice the area of a triangle, is at least this times its longest edge to
// the power of its dimension, or is taken as that. A regular tetrahedron has 0.71.
constexpr double kFlattest = 0.01;

template <std::size_t kSize, std::size_t kNumEdges>
double LongestEdge(const std::vector<Eigen::Vector3d>& points, const std::array<int, kSize>& cell,
                   const std::array<std::array<int, 2>, kNumEdges>& edges) {
  double squared = 0;
  for (const auto& [i, j] : edges) squared = std::max(squared, (points[cell[i]] - points[cell[j]]).squaredNorm());
  return std::sqrt(squared);
}

// Minus the integral of grad phi_i . grad phi_j over a tetrahedron for each of its edges ij: with n_i the normal of the
// face opposite to i, of twice its area and all inward, it is -n_i . n_j / (36 volume).
std::array<double, 6> EdgeStiffness(const std::vector<Eigen::Vector3d>& points, const std::array<int, 4>& tet) {
  const Eigen::Vector3d& d = points[tet[3]];
  const Eigen::Vector3d a = points[tet[0]] - d, b = points[tet[1]] - d, c = points[tet[2]] - d;
  std::array<Eigen::Vector3d, 4> normals = {b.cross(c), c.cross(a), a.cross(b)};
  normals[3] = -(normals[0] + normals[1] + normals[2]);
  const double longest = LongestEdge(points, tet, kTetEdges);
  const double least = kFlattest * longest * longest * longest;
  const double sixfold_volume = std::max(std::abs(a.dot(normals[0])), least);
  std::array<double, 6> stiffness = {};
  if (sixfold_volume == 0) return stiffness;
  for (std::size_t e = 0; e < 6; ++e) {
    stiffness[e] = -normals[kTetEdges[e][0]].dot(normals[kTetEdges[e][1]]) / (6 * sixfold_volume);
  }
  return stiffness;
}

// The same on a triangle: half the cotangent of the angle opposite to the edge.
std::array<double, 3> EdgeStiffness(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& triangle) {
  const auto side = [&](int from, int to) -> Eigen::Vector3d { return points[triangle[to]] - points[triangle[from]]; };
  const double least = kFlattest * std::pow(LongestEdge(points, triangle, kTriangleEdges), 2);
  const double twice_area = std::max(side(0, 1).cross(side(0, 2)).norm(), least);
  std::array<double, 3> stiffness = {};
  if (twice_area == 0) return stiffness;
  for (std::size_t e = 0; e < 3; ++e) {
    const auto& [i, j] = kTriangleEdges[e];
    const int k = 3 - i - j;
    stiffness[e] = side(k, i).dot(side(k, j)) / (2 * twice_area);
  }
  return stiffness;
}

// Weighs the edges of a mesh, which are in lexicographic order, by the stiffness of its cells.
template <std::size_t kSize, std::size_t kNumEdges>
void WeighByStiffness(const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<int, kSize>>& cells,
                      const std::array<std::array<int, 2>, kNumEdges>& cell_edges, std::vector<WeightedEdge>* edges) {
  std::vector<std::size_t> begin(points.size() + 1, 0);
  for (WeightedEdge& edge : *edges) {
    edge.weight = 0;
    ++begin[edge.a + 1];
  }
  for (std::size_t v = 0; v < points.size(); ++v) begin[v + 1] += begin[v];
  for (const std::array<int, kSize>& cell : cells) {
    const std::array<double, kNumEdges> stiffness = EdgeStiffness(points, cell);
    for (std::size_t e = 0; e < kNumEdges; ++e) {
      const auto [a, b] = std::minmax(cell[cell_edges[e][0]], cell[cell_edges[e][1]]);
      const auto edge = std::lower_bound(edges->begin() + static_cast<std::ptrdiff_t>(begin[a]),
                                         edges->begin() + static_cast<std::ptrdiff_t>(begin[a + 1]), b,
                                         [](const WeightedEdge& candidate, int end) { return candidate.b < end; });
      edge->weight += stiffness[e];
    }
  }
  for (WeightedEdge& edge : *edges) edge.weight = std::max(0., edge.weight);
}

void WeighByStiffness(const TetMesh& mesh, std::vector<WeightedEdge>* edges) {
  WeighByStiffness(mesh.points, mesh.tets, kTetEdges, edges);
}

void WeighByStiffness(const TriangleMesh& mesh, std::vector<WeightedEdge>* edges) {
  WeighByStiffness(mesh.points, mesh.triangles, kTriangleEdges, edges);
}

template <typename Mesh>
FieldGraph GraphOfMesh(const Mesh& mesh, std::vector<Alignment> alignments, EdgeWeights weights) {
  if (alignments.size() != mesh.points.size()) {
    std::ostringstream message;
    message << "MakeFieldGraph: " << alignments.size() << " alignments for " << mesh.points.size() << " points";
    throw std::invalid_argument(message.str());
  }
  FieldGraph graph;
  graph.alignments = std::move(alignments);
  std::vector<bool> has_edge(mesh.points.size(), false);
  const auto edges = MeshEdges(mesh);
  graph.edges.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    graph.edges.push_back({a, b, 1});
    has_edge[a] = has_edge[b] = true;
  }
  for (std::size_t v = 0; v < has_edge.size(); ++v) {
    if (!has_edge[v]) graph.alignments[v] = Alignment::Frame(graph.alignments[v].frame());
  }
  if (weights == EdgeWeights::kFiniteElement) WeighByStiffness(mesh, &graph.edges);
  return graph;
}

}  // namespace

FieldGraph MakeFieldGraph(const TetMesh& mesh, std::vector<Alignment> alignments, EdgeWeights weights) {
  return GraphOfMesh(mesh, std::move(alignments), weights);
}

FieldGraph MakeFieldGraph(const TriangleMesh& mesh, std::vector<Alignment> alignments, EdgeWeights weights) {
  return GraphOfMesh(mesh, std::move(alignments), weights);
}

void CheckFieldGraph(const FieldGraph& graph) {
  const auto num_vertices = static_cast<int>(graph.num_vertices());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& [a, b, weight] = graph.edges[i];
    const bool ends_are_good = 0 <= a && a < num_vertices && 0 <= b && b < num_vertices && a != b;
    if (ends_are_good && weight >= 0 && std::isfinite(weight)) continue;
    std::ostringstream message;
    message << "CheckFieldGraph: edge " << i << " (" << a << ", " << b << ") of weight " << weight << " in a graph of "
            << num_vertices << " vertices";
    throw std::invalid_argument(message.str());
  }
}

double SumOfWeights(const FieldGraph& graph) {
  double sum = 0;
  for (const WeightedEdge& edge : graph.edges) sum += edge.weight;
  return sum;
}

double MeanEdgeWeight(const FieldGraph& graph) {
  const double sum = SumOfWeights(graph);
  return sum > 0 ? sum / static_cast<double>(graph.edges.size()) : 1;
}

ProblemSize SizeOfProblem(const FieldGraph& graph, const std::array<std::size_t, 3>& unknowns_of_kind) {
  const auto unknowns_of = [&](int v) {
    return unknowns_of_kind[static_cast<std::size_t>(graph.alignments[v].kind())];
  };
  ProblemSize size;
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const std::size_t unknowns = unknowns_of(static_cast<int>(v));
    size.unknowns += unknowns;
    size.nonzeros += unknowns * unknowns;
  }
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.weight > 0) size.nonzeros += 2 * unknowns_of(edge.a) * unknowns_of(edge.b);
  }
  return size;
}

}  // namespace octupole
