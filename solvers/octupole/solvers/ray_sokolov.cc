#include "octupole/solvers/ray_sokolov.h"

#include <vector>

#include "octupole/energies/field_problem.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {
namespace {

// Relative decrease per iteration at which the least squares end.
constexpr double kLinearTolerance = 1e-5;

}  // namespace

FrameSolution SolveRaySokolov(const FieldGraph& graph, const MinimizerOptions& options) {
  CheckFieldGraph(graph);
  internal::Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const internal::SweepGraph ordered(Reorder(graph, order));
  internal::Frames frames = internal::LinearFrames(ordered, kLinearTolerance, options.seed, &minimizer);
  internal::PolishFrames(ordered, &minimizer, &frames);
  const double energy = internal::EnergyOfFrames(ordered, frames, minimizer.workers());
  return minimizer.MakeSolution(graph, order, frames, energy, SizeOfProblem(graph, kUnknownsOfKind<4>));
}

}  // namespace octupole
