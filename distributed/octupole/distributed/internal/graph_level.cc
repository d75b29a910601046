#include "octupole/distributed/internal/graph_level.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/internal/contiguous_type.h"
#include "octupole/field/coarse_graph.h"

namespace octupole::internal {
namespace {

FieldGraph OwnedGraph(const FieldGraph& graph, std::size_t num_owned) {
  const auto end = static_cast<int>(num_owned);
  FieldGraph owned;
  owned.alignments.assign(graph.alignments.begin(), graph.alignments.begin() + end);
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.a < end && edge.b < end) owned.edges.push_back(edge);
  }
  return owned;
}

// All vertices in breadth-first order, and then those without edges.
std::vector<int> OrderOfAll(const FieldGraph& graph) {
  std::vector<int> order = BreadthFirstOrder(graph);
  std::vector<bool> is_ordered(graph.num_vertices(), false);
  for (const int v : order) is_ordered[v] = true;
  for (int v = 0; v < static_cast<int>(graph.num_vertices()); ++v) {
    if (!is_ordered[v]) order.push_back(v);
  }
  return order;
}

// The owned vertices in the order of GraphLevel, and how many of them touch no ghost.
std::pair<std::vector<int>, std::size_t> SweepOrder(const FieldGraph& graph, std::size_t num_owned) {
  const auto end = static_cast<int>(num_owned);
  std::vector<bool> touches_ghost(graph.num_vertices(), false);
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.b >= end) touches_ghost[edge.a] = true;
    if (edge.a >= end) touches_ghost[edge.b] = true;
  }
  std::vector<int> order = OrderOfAll(OwnedGraph(graph, num_owned));
  const auto touching = std::stable_partition(order.begin(), order.end(), [&](int v) { return !touches_ghost[v]; });
  return {order, touching - order.begin()};
}

// CoarsenGraph in breadth-first order: in that of GraphLevel the vertices at the borders of parts would come last, and
// find no neighbours left to form clusters with.
CoarseGraph CoarsenOwned(const GraphLevel& level) {
  const FieldGraph owned = OwnedGraph(level.graph, level.num_owned);
  const std::vector<int> order = OrderOfAll(owned);
  CoarseGraph coarse = CoarsenGraph(Reorder(owned, order));
  std::vector<int> cluster_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) cluster_of[order[i]] = coarse.cluster_of[i];
  coarse.cluster_of = std::move(cluster_of);
  return coarse;
}

void CountThrough(GraphLevel* level) {
  auto num_owned = static_cast<std::int64_t>(level->num_owned);
  MPI_Exscan(&num_owned, &level->first_number, 1, MPI_INT64_T, MPI_SUM, level->comm);
  int rank = 0;
  MPI_Comm_rank(level->comm, &rank);
  if (rank == 0) level->first_number = 0;
  // An edge to a ghost belongs to two ranks.
  std::array<double, 2> sums = {static_cast<double>(num_owned), 0};
  for (const WeightedEdge& edge : level->graph.edges) {
    const bool is_shared = std::max(edge.a, edge.b) >= num_owned;
    sums[1] += is_shared ? edge.weight / 2 : edge.weight;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, level->comm);
  level->num_vertices = static_cast<std::int64_t>(sums[0]);
  level->mean_weight = sums[1] / std::max(1., sums[0]);
}

// Elements of all ranks, one rank's after the other's, on the first.
template <typename Element>
std::vector<Element> Gather(MPI_Comm comm, const std::vector<Element>& mine) {
  int rank = 0, num_ranks = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &num_ranks);
  auto size = static_cast<int>(mine.size());
  std::vector<int> sizes(num_ranks), offsets(num_ranks + 1, 0);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, comm);
  for (int i = 0; i < num_ranks; ++i) offsets[i + 1] = offsets[i] + sizes[i];
  std::vector<Element> all(rank == 0 ? offsets.back() : 0);
  const ContiguousType unit(sizeof(Element), MPI_BYTE);
  MPI_Gatherv(mine.data(), size, unit, all.data(), sizes.data(), offsets.data(), unit, 0, comm);
  return all;
}

struct NumberedEdge {
  std::int64_t a;
  std::int64_t b;
  double weight;
};

struct AlignmentData {
  AlignmentKind kind;
  std::array<double, 9> frame;
};

Alignment AlignmentFrom(const AlignmentData& data) {
  const Eigen::Map<const Eigen::Matrix3d> frame(data.frame.data());
  switch (data.kind) {
    case AlignmentKind::kFree:
      return Alignment();
    case AlignmentKind::kAxis:
      return Alignment::Axis(frame.col(2));
    case AlignmentKind::kFrame:
      break;
  }
  return Alignment::Frame(frame);
}

}  // namespace

GraphLevel MakeLevel(MPI_Comm comm, const FieldGraph& graph, std::size_t num_owned,
                     const std::vector<GhostSource>& ghosts, std::vector<int>* place_of) {
  constexpr int kNone = -1;
  const auto end = static_cast<int>(num_owned);
  GraphLevel level;
  level.comm = comm;
  level.num_owned = num_owned;
  const auto [order, num_inside] = SweepOrder(graph, num_owned);
  level.num_interior = num_inside / 4 * 4;
  std::vector<int> place(graph.num_vertices(), kNone);
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  place_of->assign(place.begin(), place.begin() + end);

  // Where the owners of the ghosts put them.
  std::vector<int> place_at_owner = place;
  Halo(comm, num_owned, ghosts).Update(&place_at_owner);
  std::vector<bool> is_used(ghosts.size(), false);
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.weight == 0) continue;
    if (edge.b >= end && edge.a < end) is_used[edge.b - end] = true;
    if (edge.a >= end && edge.b < end) is_used[edge.a - end] = true;
  }
  std::vector<std::pair<GhostSource, int>> used;
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    const int v = end + static_cast<int>(i);
    if (is_used[i]) used.push_back({{ghosts[i].rank, place_at_owner[v]}, v});
  }
  std::sort(used.begin(), used.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first.rank, a.first.index) < std::tie(b.first.rank, b.first.index);
  });
  for (const auto& [source, v] : used) {
    place[v] = end + static_cast<int>(level.ghosts.size());
    level.ghosts.push_back(source);
  }

  level.graph.alignments.resize(num_owned + level.ghosts.size());
  for (int v = 0; v < end; ++v) level.graph.alignments[place[v]] = graph.alignments[v];
  for (const WeightedEdge& edge : graph.edges) {
    if (std::min(edge.a, edge.b) >= end || place[edge.a] == kNone || place[edge.b] == kNone) continue;
    level.graph.edges.push_back({place[edge.a], place[edge.b], edge.weight});
  }
  level.halo.emplace(comm, num_owned, level.ghosts);
  CountThrough(&level);
  return level;
}

CoarseLevel CoarsenLevel(const GraphLevel& fine) {
  CoarseLevel coarse;
  CoarseGraph clusters;
  DoTogether(fine.comm, [&] { clusters = CoarsenOwned(fine); });
  const auto end = static_cast<int>(fine.num_owned);
  const auto num_clusters = static_cast<int>(clusters.graph.num_vertices());

  // The clusters of the ghosts, numbered after those of this rank, and of how many vertices each vertex's cluster is.
  std::vector<int> cluster_of = clusters.cluster_of;
  std::vector<int> size(num_clusters, 0), size_of;
  for (const int cluster : cluster_of) ++size[cluster];
  for (const int cluster : cluster_of) size_of.push_back(size[cluster]);
  cluster_of.resize(fine.graph.num_vertices());
  size_of.resize(fine.graph.num_vertices());
  fine.halo->Update(&cluster_of);
  fine.halo->Update(&size_of);
  const auto source_of = [&](std::size_t i) { return std::pair(fine.ghosts[i].rank, cluster_of[end + i]); };
  std::vector<std::pair<int, int>> sources;
  for (std::size_t i = 0; i < fine.ghosts.size(); ++i) sources.push_back(source_of(i));
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  for (std::size_t i = 0; i < fine.ghosts.size(); ++i) {
    const auto position = std::lower_bound(sources.begin(), sources.end(), source_of(i));
    cluster_of[end + i] = num_clusters + static_cast<int>(position - sources.begin());
  }
  std::vector<GhostSource> ghosts;
  for (const auto& [rank, cluster] : sources) ghosts.push_back({rank, cluster});
  clusters.graph.alignments.resize(num_clusters + sources.size());

  // The edges to ghosts, those between the same clusters added up.
  std::vector<WeightedEdge> edges;
  for (const WeightedEdge& edge : fine.graph.edges) {
    if (std::max(edge.a, edge.b) < end) continue;
    const auto [a, b] = std::minmax(cluster_of[edge.a], cluster_of[edge.b]);
    edges.push_back({a, b, WeightBetweenClusters(edge.weight, size_of[edge.a], size_of[edge.b])});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const WeightedEdge& e, const WeightedEdge& f) {
    return std::tie(e.a, e.b) < std::tie(f.a, f.b);
  });
  std::size_t first_shared = clusters.graph.edges.size();
  for (const WeightedEdge& edge : edges) {
    std::vector<WeightedEdge>& merged = clusters.graph.edges;
    if (merged.size() > first_shared && merged.back().a == edge.a && merged.back().b == edge.b) {
      merged.back().weight += edge.weight;
    } else {
      merged.push_back(edge);
    }
  }

  std::vector<int> place_of;
  coarse.level = MakeLevel(fine.comm, clusters.graph, num_clusters, ghosts, &place_of);
  coarse.cluster_of.reserve(fine.num_owned);
  for (const int cluster : clusters.cluster_of) coarse.cluster_of.push_back(place_of[cluster]);
  return coarse;
}

GatheredGraph GatherGraph(const GraphLevel& level, const std::vector<std::int64_t>& keys) {
  const auto end = static_cast<int>(level.num_owned);
  std::vector<std::int64_t> numbers(level.graph.num_vertices());
  for (int v = 0; v < end; ++v) numbers[v] = level.first_number + v;
  level.halo->Update(&numbers);
  std::vector<NumberedEdge> edges;
  for (const WeightedEdge& edge : level.graph.edges) {
    const auto [a, b] = std::minmax(edge.a, edge.b);
    if (b >= end && numbers[b] < numbers[a]) continue;  // its other rank sends it
    edges.push_back({numbers[a], numbers[b], edge.weight});
  }
  std::vector<AlignmentData> alignments(end);
  for (int v = 0; v < end; ++v) {
    alignments[v].kind = level.graph.alignments[v].kind();
    Eigen::Map<Eigen::Matrix3d>(alignments[v].frame.data()) = level.graph.alignments[v].frame();
  }
  const std::vector<AlignmentData> all_alignments = Gather(level.comm, alignments);
  const std::vector<NumberedEdge> all_edges = Gather(level.comm, edges);
  const std::vector<std::int64_t> all_keys = Gather(level.comm, keys);
  GatheredGraph whole;
  whole.numbers.resize(all_keys.size());
  std::iota(whole.numbers.begin(), whole.numbers.end(), 0);
  std::sort(whole.numbers.begin(), whole.numbers.end(), [&](int v, int w) { return all_keys[v] < all_keys[w]; });
  std::vector<int> place(all_keys.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    place[whole.numbers[i]] = static_cast<int>(i);
    whole.graph.alignments.push_back(AlignmentFrom(all_alignments[whole.numbers[i]]));
  }
  for (const NumberedEdge& edge : all_edges) {
    const auto [a, b] = std::minmax(place[edge.a], place[edge.b]);
    whole.graph.edges.push_back({a, b, edge.weight});
  }
  std::sort(whole.graph.edges.begin(), whole.graph.edges.end(),
            [](const WeightedEdge& e, const WeightedEdge& f) { return std::tie(e.a, e.b) < std::tie(f.a, f.b); });
  return whole;
}

std::vector<double> ScatterValues(const GraphLevel& level, const GatheredGraph& whole,
                                  const std::vector<double>& values, std::size_t values_per_vertex) {
  std::vector<double> counted_through(values.size());
  for (std::size_t i = 0; i < whole.numbers.size(); ++i) {
    std::copy_n(values.data() + values_per_vertex * i, values_per_vertex,
                counted_through.data() + values_per_vertex * whole.numbers[i]);
  }
  int num_ranks = 0;
  MPI_Comm_size(level.comm, &num_ranks);
  const auto size = static_cast<int>(values_per_vertex * level.num_owned);
  std::vector<int> sizes(num_ranks), offsets(num_ranks + 1, 0);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, level.comm);
  for (int i = 0; i < num_ranks; ++i) offsets[i + 1] = offsets[i] + sizes[i];
  std::vector<double> mine(size);
  MPI_Scatterv(counted_through.data(), sizes.data(), offsets.data(), MPI_DOUBLE, mine.data(), size, MPI_DOUBLE, 0,
               level.comm);
  return mine;
}

}  // namespace octupole::internal
