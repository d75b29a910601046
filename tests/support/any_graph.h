#pragma once

#include <Eigen/Core>
#include <array>
#include <random>
#include <vector>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/energies/field_problem.h"
#include "octupole/field/field_graph.h"
#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"

namespace octupole {

// A graph on which whatever is true of all graphs can be tried, with frames and parameters for it.

/// A box of so many cells, whose vertices are free, have an axis or a frame, and `num_isolated` vertices without an
/// edge. All edges weigh 1, or 0, 0.3, ... 1.8 in turn.
inline FieldGraph AnyGraph(const std::array<int, 3>& cells, int num_isolated, bool is_weighted) {
  const TetMesh mesh = MakeBoxMesh(cells, Eigen::Vector3d(cells[0], cells[1], cells[2]));
  std::mt19937 generator(1);
  std::vector<Alignment> alignments;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    alignments.push_back(v % 3 == 1   ? Alignment::Axis(RandomDirection(&generator))
                         : v % 5 == 4 ? Alignment::Frame(RandomFrame(&generator))
                                      : Alignment());
  }
  FieldGraph graph = MakeFieldGraph(mesh, alignments);
  for (int i = 0; i < num_isolated; ++i) graph.alignments.emplace_back();
  if (!is_weighted) return graph;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) graph.edges[e].weight = 0.3 * static_cast<double>(e % 7);
  return graph;
}

/// Aligned frames.
inline std::vector<Eigen::Matrix3d> AnyFrames(const FieldGraph& graph) {
  std::vector<Eigen::Matrix3d> frames;
  for (const Octupole& octupole : RandomField<3>(graph, 1)) {
    frames.push_back(NearestAlignedFrame<3>(graph.alignments[frames.size()], octupole));
  }
  return frames;
}

inline std::vector<double> AnyParameters(int size) {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  std::vector<double> parameters(size);
  for (double& value : parameters) value = normal(generator);
  return parameters;
}

}  // namespace octupole
