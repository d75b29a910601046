#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/field/field_graph.h"

namespace octupole::internal {

/// A graph as sweeps read it: the neighbours of each vertex, one after another, in groups of four. The last group of a
/// vertex is filled up with the number of vertices, which stands for one that is all zero. Edges of weight 0 are left
/// out.
struct SweepGraph {
  explicit SweepGraph(const FieldGraph& graph) : SweepGraph(graph, graph.num_vertices()) {}
  /// Of a part of a graph, whose vertices from num_owned on are ghosts (see FieldEnergy) and get no neighbours.
  SweepGraph(const FieldGraph& graph, std::size_t num_owned);

  std::size_t num_vertices() const { return alignments.size(); }

  std::vector<Alignment> alignments;
  std::size_t num_owned;
  /// The groups of vertex v are first_group[v] up to first_group[v + 1]. Some vertices more than there are, without
  /// neighbours, let sweeps take eight at a time.
  std::vector<int> first_group;
  std::vector<int> neighbours;
  /// The weights of the edges to `neighbours`, 0 for the filling; empty when all edges have weight 1.
  std::vector<double> weights;
  /// Of all edges at a vertex.
  std::vector<double> weight_sums;
  double sum_of_weights = 0;
};

/// The number of owned vertices, all if not given. \throw std::invalid_argument naming `caller` when the graph is
/// malformed (see CheckFieldGraph) or has fewer vertices.
std::size_t CheckNumOwned(const char* caller, const FieldGraph& graph, std::optional<std::size_t> num_owned);

}  // namespace octupole::internal
