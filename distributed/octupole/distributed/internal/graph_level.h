#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "octupole/distributed/internal/halo.h"
#include "octupole/distributed/mesh_part.h"
#include "octupole/field/field_graph.h"

namespace octupole::internal {

/// One rank's part of a graph, as a sweep wants it.
struct GraphLevel {
  MPI_Comm comm = MPI_COMM_NULL;
  /// Vertices that touch no ghost, the other owned vertices, and ghosts, which have an edge to an owned one each; each
  /// of these in an order that keeps neighbours close in memory. The alignments of ghosts are not set.
  FieldGraph graph;
  std::size_t num_owned = 0;
  /// Of the vertices that touch no ghost, as many as make up fours.
  std::size_t num_interior = 0;
  std::vector<GhostSource> ghosts;
  std::optional<Halo> halo;
  /// The number of this rank's first vertex when all ranks' are counted through, and how many there are.
  std::int64_t first_number = 0;
  std::int64_t num_vertices = 0;
  /// Of all ranks.
  double mean_weight = 0;
};

/// A coarser graph: clusters of each rank's vertices, as by CoarsenGraph.
struct CoarseLevel {
  GraphLevel level;
  /// For each owned vertex of the finer graph.
  std::vector<int> cluster_of;
};

/// \param graph owned vertices, then ghosts. Edges between ghosts do not matter.
/// \param place_of becomes the place of each owned vertex in the level. Collective, as all here.
GraphLevel MakeLevel(MPI_Comm comm, const FieldGraph& graph, std::size_t num_owned,
                     const std::vector<GhostSource>& ghosts, std::vector<int>* place_of);

CoarseLevel CoarsenLevel(const GraphLevel& fine);

/// The whole graph on the first rank, nothing on the others.
struct GatheredGraph {
  FieldGraph graph;
  /// Of each vertex, its number when all ranks' are counted through.
  std::vector<int> numbers;
};

/// \param keys of the owned vertices, all different: the whole graph's vertices are in ascending order of theirs, and
/// its edges in lexicographic order.
GatheredGraph GatherGraph(const GraphLevel& level, const std::vector<std::int64_t>& keys);

/// The values of the owned vertices, from those of the whole graph, which the first rank has: values_per_vertex numbers
/// each, one after the other.
std::vector<double> ScatterValues(const GraphLevel& level, const GatheredGraph& whole,
                                  const std::vector<double>& values, std::size_t values_per_vertex);

}  // namespace octupole::internal
