#pragma once

#include <cstddef>
#include <vector>

#include "octupole/field/field_graph.h"

namespace octupole::internal {

/// The neighbours of each vertex of a graph, one after another, in groups of four for sweeps that gather. The last
/// group of a vertex is filled up with the number of vertices, which stands for one that is all zero. Edges of weight 0
/// are left out.
struct NeighbourLists {
  explicit NeighbourLists(const FieldGraph& graph);

  /// The groups of vertex v are first_group[v] up to first_group[v + 1].
  std::vector<std::size_t> first_group;
  std::vector<int> neighbours;
  /// The weights of the edges to `neighbours`, 0 for the filling; empty when all edges have weight 1.
  std::vector<double> weights;
  /// Of all edges at a vertex.
  std::vector<double> weight_sums;
};

}  // namespace octupole::internal
