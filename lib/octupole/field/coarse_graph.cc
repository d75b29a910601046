#include "octupole/field/coarse_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "octupole/frames/frame.h"

namespace octupole {
namespace {

struct Neighbour {
  int vertex;
  double weight;
};

// The neighbours of vertex v are neighbours[first[v]] up to neighbours[first[v + 1]]. An edge of weight 0 ties nothing.
struct Neighbourhoods {
  explicit Neighbourhoods(const FieldGraph& graph) : first(graph.num_vertices() + 1, 0) {
    for (const WeightedEdge& edge : graph.edges) {
      if (edge.weight == 0) continue;
      ++first[edge.a + 1];
      ++first[edge.b + 1];
    }
    for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
    neighbours.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (const WeightedEdge& edge : graph.edges) {
      if (edge.weight == 0) continue;
      neighbours[next[edge.a]++] = {edge.b, edge.weight};
      neighbours[next[edge.b]++] = {edge.a, edge.weight};
    }
  }

  const Neighbour* begin(int v) const { return neighbours.data() + first[v]; }
  const Neighbour* end(int v) const { return neighbours.data() + first[v + 1]; }

  std::vector<std::size_t> first;
  std::vector<Neighbour> neighbours;
};

// How far two alignments of the same kind agree, 1 if fully.
double Agreement(const Alignment& a, const Alignment& b) {
  const Eigen::Matrix3d q = a.frame().transpose() * b.frame();
  return std::pow(a.kind() == AlignmentKind::kFrame ? Permanent(q) : q(2, 2), 2);
}

Alignment CommonAlignment(const FieldGraph& graph, const std::vector<int>& members) {
  AlignmentKind kind = AlignmentKind::kFree;
  for (const int v : members) kind = std::max(kind, graph.alignments[v].kind());
  if (kind == AlignmentKind::kFree) return Alignment();
  Alignment best;
  double best_agreement = 0;
  for (const int v : members) {
    if (graph.alignments[v].kind() != kind) continue;
    double agreement = 0;
    for (const int w : members) {
      if (graph.alignments[w].kind() == kind) agreement += Agreement(graph.alignments[v], graph.alignments[w]);
    }
    if (agreement <= best_agreement) continue;
    best_agreement = agreement;
    best = graph.alignments[v];
  }
  return best;
}

std::vector<int> FormClusters(const Neighbourhoods& neighbourhoods, int num_vertices) {
  constexpr int kMaxSize = 8;
  constexpr int kMinSize = 5;
  constexpr int kNone = -1;
  std::vector<int> cluster_of(num_vertices, kNone);
  int num_clusters = 0;
  std::vector<Neighbour> open;
  for (int v = 0; v < num_vertices; ++v) {
    if (cluster_of[v] != kNone) continue;
    open.assign(neighbourhoods.begin(v), neighbourhoods.end(v));
    open.erase(
        std::remove_if(open.begin(), open.end(), [&](const Neighbour& n) { return cluster_of[n.vertex] != kNone; }),
        open.end());
    if (static_cast<int>(open.size()) + 1 < kMinSize) continue;
    std::stable_sort(open.begin(), open.end(),
                     [](const Neighbour& m, const Neighbour& n) { return m.weight > n.weight; });
    open.resize(std::min<std::size_t>(open.size(), kMaxSize - 1));
    for (const Neighbour& neighbour : open) cluster_of[neighbour.vertex] = num_clusters;
    cluster_of[v] = num_clusters++;
  }
  // The rest joins whatever cluster it is tied to most; where there is none, it starts one.
  std::vector<double> ties(num_vertices, 0);
  for (int v = 0; v < num_vertices; ++v) {
    if (cluster_of[v] != kNone) continue;
    int strongest = kNone;
    for (const Neighbour* n = neighbourhoods.begin(v); n != neighbourhoods.end(v); ++n) {
      const int cluster = cluster_of[n->vertex];
      if (cluster == kNone) continue;
      ties[cluster] += n->weight;
      if (strongest == kNone || ties[cluster] > ties[strongest]) strongest = cluster;
    }
    for (const Neighbour* n = neighbourhoods.begin(v); n != neighbourhoods.end(v); ++n) {
      if (cluster_of[n->vertex] != kNone) ties[cluster_of[n->vertex]] = 0;
    }
    cluster_of[v] = strongest == kNone ? num_clusters++ : strongest;
  }
  // Number them in the order of their first vertices.
  std::vector<int> number(num_clusters, kNone);
  int num_numbered = 0;
  for (int& cluster : cluster_of) {
    if (number[cluster] == kNone) number[cluster] = num_numbered++;
    cluster = number[cluster];
  }
  return cluster_of;
}

}  // namespace

std::vector<int> BreadthFirstOrder(const FieldGraph& graph) {
  const Neighbourhoods neighbourhoods(graph);
  const int num_vertices = static_cast<int>(graph.num_vertices());
  std::vector<int> order;
  order.reserve(num_vertices);
  std::vector<bool> is_reached(num_vertices, false);
  for (int root = 0; root < num_vertices; ++root) {
    if (is_reached[root] || neighbourhoods.begin(root) == neighbourhoods.end(root)) continue;
    is_reached[root] = true;
    std::size_t next = order.size();
    order.push_back(root);
    for (; next < order.size(); ++next) {
      const int v = order[next];
      for (const Neighbour* n = neighbourhoods.begin(v); n != neighbourhoods.end(v); ++n) {
        if (is_reached[n->vertex]) continue;
        is_reached[n->vertex] = true;
        order.push_back(n->vertex);
      }
    }
  }
  return order;
}

FieldGraph Reorder(const FieldGraph& graph, const std::vector<int>& order) {
  constexpr int kLeftOut = -1;
  std::vector<int> number(graph.num_vertices(), kLeftOut);
  FieldGraph result;
  result.alignments.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<int>(i);
    result.alignments.push_back(graph.alignments[order[i]]);
  }
  result.edges.reserve(graph.edges.size());
  for (const WeightedEdge& edge : graph.edges) {
    if (number[edge.a] == kLeftOut || number[edge.b] == kLeftOut) continue;
    result.edges.push_back({number[edge.a], number[edge.b], edge.weight});
  }
  return result;
}

double WeightBetweenClusters(double sum_of_weights, std::size_t a, std::size_t b) {
  return 2 * sum_of_weights / (std::cbrt(static_cast<double>(a)) + std::cbrt(static_cast<double>(b)));
}

CoarseGraph CoarsenGraph(const FieldGraph& graph) {
  CheckFieldGraph(graph);
  const int num_vertices = static_cast<int>(graph.num_vertices());
  const Neighbourhoods neighbourhoods(graph);
  CoarseGraph coarse;
  coarse.cluster_of = FormClusters(neighbourhoods, num_vertices);
  const int num_clusters =
      num_vertices == 0 ? 0 : 1 + *std::max_element(coarse.cluster_of.begin(), coarse.cluster_of.end());
  std::vector<std::vector<int>> members(num_clusters);
  for (int v = 0; v < num_vertices; ++v) members[coarse.cluster_of[v]].push_back(v);

  // The sums of weights between one cluster and those of higher number, gathered in a sparse accumulator.
  std::vector<double> weight_to(num_clusters, 0);
  std::vector<int> touched;
  for (int cluster = 0; cluster < num_clusters; ++cluster) {
    touched.clear();
    for (const int v : members[cluster]) {
      for (const Neighbour* n = neighbourhoods.begin(v); n != neighbourhoods.end(v); ++n) {
        const int other = coarse.cluster_of[n->vertex];
        if (other <= cluster) continue;
        if (weight_to[other] == 0) touched.push_back(other);
        weight_to[other] += n->weight;
      }
    }
    for (const int other : touched) {
      const double weight = WeightBetweenClusters(weight_to[other], members[cluster].size(), members[other].size());
      coarse.graph.edges.push_back({cluster, other, weight});
      weight_to[other] = 0;
    }
    coarse.graph.alignments.push_back(CommonAlignment(graph, members[cluster]));
  }
  return coarse;
}

}  // namespace octupole
