#include "octupole/field/field_graph.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/mesh/mesh_topology.h"

namespace octupole {

namespace {

template <typename Mesh>
FieldGraph GraphOfMesh(const Mesh& mesh, std::vector<Alignment> alignments) {
  if (alignments.size() != mesh.points.size()) {
    std::ostringstream message;
    message << "MakeFieldGraph: " << alignments.size() << " alignments for " << mesh.points.size() << " points";
    throw std::invalid_argument(message.str());
  }
  FieldGraph graph;
  graph.alignments = std::move(alignments);
  std::vector<bool> has_edge(mesh.points.size(), false);
  for (const auto& [a, b] : MeshEdges(mesh)) {
    graph.edges.push_back({a, b, 1});
    has_edge[a] = has_edge[b] = true;
  }
  for (std::size_t v = 0; v < has_edge.size(); ++v) {
    if (!has_edge[v]) graph.alignments[v] = Alignment::Frame(graph.alignments[v].frame());
  }
  return graph;
}

}  // namespace

FieldGraph MakeFieldGraph(const TetMesh& mesh, std::vector<Alignment> alignments) {
  return GraphOfMesh(mesh, std::move(alignments));
}

FieldGraph MakeFieldGraph(const TriangleMesh& mesh, std::vector<Alignment> alignments) {
  return GraphOfMesh(mesh, std::move(alignments));
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
