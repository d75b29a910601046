#pragma once

#include <cstddef>
#include <vector>

#include "octupole/field/field_graph.h"

namespace octupole {

/// The vertices of a graph in breadth-first order, component after component: numbered so, neighbours come close
/// together in memory. Edges of weight 0 do not count, and vertices without others are left out.
std::vector<int> BreadthFirstOrder(const FieldGraph& graph);

/// The same graph with its vertices renumbered: vertex i of the result is vertex order[i]. `order` holds vertices once
/// each; edges of those that it leaves out are left out, too.
FieldGraph Reorder(const FieldGraph& graph, const std::vector<int>& order);

/// A smaller graph, whose vertices are clusters of some eight neighbouring vertices of a finer one.
struct CoarseGraph {
  FieldGraph graph;
  /// For each vertex of the finer graph the vertex of this one that it belongs to.
  std::vector<int> cluster_of;
};

/// Clusters the vertices of a graph: a vertex with enough free neighbours takes those with the heaviest edges; what
/// is left joins the cluster that it is tied to most, or is one of its own. Edges of weight 0 tie nothing. Clusters are
/// numbered in the order of their first vertices.
///
/// The weight of an edge between two clusters is the sum of those between their vertices. A cluster is aligned as its
/// vertices: with the frame, or else the axis, among theirs that agrees best with the others.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph).
CoarseGraph CoarsenGraph(const FieldGraph& graph);

}  // namespace octupole
