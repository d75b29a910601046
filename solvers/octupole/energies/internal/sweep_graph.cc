#include "octupole/energies/internal/sweep_graph.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace octupole::internal {

SweepGraph::SweepGraph(const FieldGraph& graph, std::size_t num_owned)
    : alignments(graph.alignments), num_owned(num_owned), sum_of_weights(SumOfWeights(graph)) {
  constexpr std::size_t kMaxLanes = 8;
  const std::size_t num_vertices = graph.num_vertices();
  const std::size_t num_rows = (num_vertices + kMaxLanes) / kMaxLanes * kMaxLanes;
  first_group.assign(num_rows + 1, 0);
  weight_sums.assign(num_rows, 0);
  bool is_weighted = false;
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.weight == 0) continue;
    is_weighted |= edge.weight != 1;
    for (const int v : {edge.a, edge.b}) {
      if (static_cast<std::size_t>(v) >= num_owned) continue;
      ++first_group[v + 1];
      weight_sums[v] += edge.weight;
    }
  }
  for (std::size_t v = 0; v < num_rows; ++v) first_group[v + 1] = first_group[v] + (first_group[v + 1] + 3) / 4;
  neighbours.assign(4 * static_cast<std::size_t>(first_group.back()), static_cast<int>(num_vertices));
  if (is_weighted) weights.assign(neighbours.size(), 0);

  std::vector<std::size_t> next(num_vertices);
  for (std::size_t v = 0; v < num_vertices; ++v) next[v] = 4 * static_cast<std::size_t>(first_group[v]);
  const auto add = [&](int from, int to, double weight) {
    if (static_cast<std::size_t>(from) >= num_owned) return;
    const std::size_t slot = next[from]++;
    neighbours[slot] = to;
    if (is_weighted) weights[slot] = weight;
  };
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.weight == 0) continue;
    add(edge.a, edge.b, edge.weight);
    add(edge.b, edge.a, edge.weight);
  }
}

std::size_t CheckNumOwned(const char* caller, const FieldGraph& graph, std::optional<std::size_t> num_owned) {
  CheckFieldGraph(graph);
  if (!num_owned) return graph.num_vertices();
  if (*num_owned <= graph.num_vertices()) return *num_owned;
  throw std::invalid_argument(std::string(caller) + ": " + std::to_string(*num_owned) +
                              " owned vertices in a graph of " + std::to_string(graph.num_vertices()));
}

}  // namespace octupole::internal
