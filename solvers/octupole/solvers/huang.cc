#include "octupole/solvers/huang.h"

#include <random>
#include <vector>

#include "octupole/field/coarse_graph.h"
#include "octupole/frames/random_rotation.h"
#include "octupole/solvers/frame_energy.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {

FrameSolution SolveHuang(const FieldGraph& graph, const MinimizerOptions& options) {
  CheckFieldGraph(graph);
  internal::Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const FieldGraph ordered = Reorder(graph, order);
  std::mt19937 generator(options.seed);
  const internal::Frames start(ordered.num_vertices(), RandomRotation(&generator).toRotationMatrix());
  const FrameEnergy energy(ordered, start, minimizer.workers(), kHuangBoundaryWeight);
  std::vector<double> x(energy.NumParameters(), 0);
  const double lowest = minimizer.Minimize(energy, ordered, internal::kFrameTolerance, &x);
  return minimizer.MakeSolution(graph, order, energy.FramesOf(x), lowest, SizeOfProblem(ordered, {3, 3, 3}));
}

}  // namespace octupole
