#pragma once

#include <cstddef>
#include <vector>

#include "octupole/alignment.h"
#include "octupole/tet_mesh.h"

namespace octupole {

/// An edge between two vertices of a graph and the weight of its smoothness term.
struct WeightedEdge {
  int a = 0;
  int b = 0;
  double weight = 1;
};

/// All that costs and solvers ever see of a mesh: vertices, weighted edges, and one alignment per vertex.
struct FieldGraph {
  std::vector<WeightedEdge> edges;
  /// One per vertex; its size is the number of vertices.
  std::vector<Alignment> alignments;

  std::size_t num_vertices() const { return alignments.size(); }
};

/// The graph of a tet mesh: its vertices and edges in the order of MeshEdges, each edge of weight 1.
/// \throw std::invalid_argument unless there is one alignment per point.
FieldGraph MakeFieldGraph(const TetMesh& mesh, std::vector<Alignment> alignments);

/// \throw std::invalid_argument naming the first edge whose ends are out of range or equal, or whose weight is negative
/// or not finite.
void CheckFieldGraph(const FieldGraph& graph);

}  // namespace octupole
