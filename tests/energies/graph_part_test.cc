#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "any_graph.h"
#include "octupole/energies/field_energy.h"
#include "octupole/energies/frame_energy.h"
#include "octupole/field/field_graph.h"

// The energies of parts of a graph with ghosts, against that of the whole graph.

namespace octupole {
namespace {

struct Part {
  FieldGraph graph;
  std::size_t num_owned = 0;
  std::vector<int> vertices;  // of the whole graph, ghosts last
};

// The vertices [begin, end) and their neighbours; nothing is known of how ghosts are aligned.
Part PartOf(const FieldGraph& whole, int begin, int end) {
  Part part;
  const auto is_owned = [&](int v) { return begin <= v && v < end; };
  for (int v = begin; v < end; ++v) part.vertices.push_back(v);
  part.num_owned = part.vertices.size();
  const auto place = [&](int v) {
    auto position = std::find(part.vertices.begin(), part.vertices.end(), v);
    if (position == part.vertices.end()) position = part.vertices.insert(position, v);
    return static_cast<int>(position - part.vertices.begin());
  };
  for (const auto& [a, b, weight] : whole.edges) {
    if (is_owned(a) || is_owned(b)) part.graph.edges.push_back({place(a), place(b), weight});
  }
  part.graph.alignments.resize(part.vertices.size());
  for (std::size_t i = 0; i < part.num_owned; ++i) part.graph.alignments[i] = whole.alignments[part.vertices[i]];
  return part;
}

// `make(graph, vertices, num_owned)` makes the energy of a graph that has these vertices of the whole one.
template <typename MakeEnergy>
void ExpectPartsToAddUp(const MakeEnergy& make) {
  const FieldGraph graph = AnyGraph({5, 3, 2}, /*num_isolated=*/0, /*is_weighted=*/true);
  const auto num_vertices = static_cast<int>(graph.num_vertices());
  std::vector<int> all(num_vertices);
  for (int v = 0; v < num_vertices; ++v) all[v] = v;
  const auto whole = make(graph, all, graph.num_vertices());
  const std::vector<double> x = AnyParameters(whole->NumParameters());
  double expected_cost = 0;
  std::vector<double> expected_gradient(x.size());
  ASSERT_TRUE(whole->Evaluate(x.data(), &expected_cost, expected_gradient.data()));

  // Parameters are in the order of vertices, and so are the parts.
  double cost = 0;
  std::vector<double> gradient(x.size(), std::nan(""));
  std::size_t first_parameter = 0;
  const std::vector<int> ends = {0, 1, 9, 9, 46, num_vertices};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Part part = PartOf(graph, ends[i], ends[i + 1]);
    const auto energy = make(part.graph, part.vertices, part.num_owned);
    energy->Expand(x.data() + first_parameter);
    for (std::size_t v = part.num_owned; v < part.vertices.size(); ++v) {
      std::copy_n(whole->Row(part.vertices[v]), energy->kRowSize, energy->Row(v));
    }
    // In two steps, as when ghosts are waited for.
    const std::size_t middle = part.num_owned / 2 / 4 * 4;
    for (const auto& [begin, end] : {std::pair(std::size_t{0}, middle), std::pair(middle, part.num_owned)}) {
      cost += energy->Sweep(begin, end, x.data() + first_parameter, gradient.data() + first_parameter);
    }
    first_parameter += energy->NumParameters();
  }
  EXPECT_EQ(first_parameter, x.size());
  EXPECT_NEAR(cost, expected_cost, 1e-12 * expected_cost);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(gradient[i], expected_gradient[i], 1e-11) << i;
}

TEST(GraphPart, FieldEnergiesAddUp) {
  Workers workers(2);
  ExpectPartsToAddUp([&](const FieldGraph& graph, const std::vector<int>&, std::size_t num_owned) {
    return std::make_unique<FieldEnergy<3>>(graph, EnergyWeights{3, 0.7}, &workers, num_owned);
  });
  ExpectPartsToAddUp([&](const FieldGraph& graph, const std::vector<int>&, std::size_t num_owned) {
    return std::make_unique<FieldEnergy<4>>(graph, EnergyWeights{3, 0.7}, &workers, num_owned);
  });
}

TEST(GraphPart, FrameEnergiesAddUp) {
  Workers workers(2);
  const std::vector<Eigen::Matrix3d> all_frames =
      AnyFrames(AnyGraph({5, 3, 2}, /*num_isolated=*/0, /*is_weighted=*/true));
  ExpectPartsToAddUp([&](const FieldGraph& graph, const std::vector<int>& vertices, std::size_t num_owned) {
    std::vector<Eigen::Matrix3d> frames;
    for (const int v : vertices) frames.push_back(all_frames[v]);
    return std::make_unique<FrameEnergy>(graph, frames, &workers, std::nullopt, std::vector<bool>(), num_owned);
  });
}

TEST(GraphPart, OwnsNoMoreThanThereIs) {
  const FieldGraph graph = AnyGraph({5, 3, 2}, /*num_isolated=*/0, /*is_weighted=*/true);
  Workers workers(1);
  EXPECT_THROW(FieldEnergy<3>(graph, {}, &workers, graph.num_vertices() + 1), std::invalid_argument);
  EXPECT_THROW(
      FrameEnergy(graph, AnyFrames(graph), &workers, std::nullopt, std::vector<bool>(), graph.num_vertices() + 1),
      std::invalid_argument);
}

}  // namespace
}  // namespace octupole
