#include "octupole/solvers/huang.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/energies/frame_energy.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/random_rotation.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {

FrameSolution SolveHuang(const FieldGraph& graph, const MinimizerOptions& options,
                         const std::vector<int>& hard_vertices) {
  CheckFieldGraph(graph);
  std::vector<bool> is_hard_of_graph(graph.num_vertices(), false);
  for (const int v : hard_vertices) {
    if (v < 0 || v >= static_cast<int>(graph.num_vertices())) {
      throw std::invalid_argument("SolveHuang: the hard vertex " + std::to_string(v) + " is out of range 0.." +
                                  std::to_string(static_cast<std::int64_t>(graph.num_vertices()) - 1));
    }
    is_hard_of_graph[v] = true;
  }
  internal::Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const FieldGraph ordered = Reorder(graph, order);
  std::mt19937 generator(options.seed);
  internal::Frames start(ordered.num_vertices(), RandomRotation(&generator).toRotationMatrix());
  std::vector<bool> is_hard(order.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    is_hard[v] = is_hard_of_graph[order[v]];
    if (is_hard[v]) start[v] = NearestAlignedFrame<4>(ordered.alignments[v], HarmonicFromFrame<4>(start[v]));
  }
  // Weights so large that the energy is not finite are found out by the minimiser.
  const double soft_weight = std::min(kHuangBoundaryWeight * MeanEdgeWeight(graph), std::numeric_limits<double>::max());
  const FrameEnergy energy(ordered, start, minimizer.workers(), soft_weight, is_hard);
  std::vector<double> x(energy.NumParameters(), 0);
  const double lowest = minimizer.Minimize(energy, ordered, internal::kFrameTolerance, &x);
  return minimizer.MakeSolution(graph, order, energy.FramesOf(x), lowest, SizeOfProblem(ordered, {3, 3, 3}));
}

}  // namespace octupole
