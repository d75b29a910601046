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

/// The weight of an edge between clusters of a and b vertices, tied by edges whose weights have the given sum: sum / l,
/// where l = (a^(1/3) + b^(1/3)) / 2 is the number of edges from the middle of one to that of the other. What is linear
/// changes l times as much between them as over one edge, and costs l^2 times as much; the l edges on the way cost l
/// times as much. By the sum alone small clusters would cost less than large ones, and draw singular curves.
double WeightBetweenClusters(double sum_of_weights, std::size_t a, std::size_t b);

/// Clusters the vertices of a graph: a vertex with enough free neighbours takes those with the heaviest edges; what
/// is left joins the cluster that it is tied to most, or is one of its own. Edges of weight 0 tie nothing. Clusters are
/// numbered in the order of their first vertices.
///
/// Edges between clusters are weighed by WeightBetweenClusters. A cluster is aligned as its vertices: with the frame,
/// or else the axis, among theirs that agrees best with the others.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph).
CoarseGraph CoarsenGraph(const FieldGraph& graph);

}  // namespace octupole
