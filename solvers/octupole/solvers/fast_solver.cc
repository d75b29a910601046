#include "octupole/solvers/fast_solver.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/field/aligned_frame.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/solvers/internal/field_function.h"
#include "octupole/solvers/internal/minimizer.h"
#include "octupole/solvers/internal/sweep_graph.h"

namespace octupole {
namespace {

using internal::Frames;
using internal::MinimizeField;
using internal::Minimizer;
using internal::PolishFrames;
using internal::ProjectField;
using internal::SweepGraph;

// The starts are tried on the finest graph of at most this many vertices, where they cost little.
constexpr std::size_t kMaxStartVertices = 2000;
// Graphs are not coarsened below this.
constexpr std::size_t kMinVertices = 100;
constexpr int kNumRandomStarts = 3;
// Relative decrease per iteration at which the minimisation of a field ends.
constexpr double kFieldTolerance = 1e-4;
// The same after a local change, which is but a small part of the energy.
constexpr double kChangeTolerance = 1e-5;

void CheckProblem(const FieldGraph& graph, const EnergyWeights& weights) {
  CheckFieldGraph(graph);
  RootOfWeight("SolveFast (scale)", weights.scale);
  RootOfWeight("SolveFast (deviation)", weights.deviation);
}

// A graph of the hierarchy, as it is solved on.
struct Level {
  SweepGraph graph;
  /// Of each vertex of the next finer graph.
  std::vector<int> cluster_of;
  EnergyWeights weights;
};

double MeanWeight(const SweepGraph& graph) {
  return graph.sum_of_weights / static_cast<double>(std::max<std::size_t>(1, graph.num_vertices()));
}

// The graphs from fine to coarse. The first has a locality of memory that a mesh's own order often lacks.
//
// Clustering adds weights up; penalties that grow in proportion leave the balance, and so the ease with which a field
// turns, as it is on the finest graph.
std::vector<Level> MakeHierarchy(const FieldGraph& graph, const std::vector<int>& order, const EnergyWeights& weights) {
  CoarseGraph finer = {Reorder(graph, order), {}};
  std::vector<Level> levels;
  levels.push_back({SweepGraph(finer.graph), {}, weights});
  // Not zero: a graph without weights is not coarsened.
  const double finest = MeanWeight(levels[0].graph);
  while (finer.graph.num_vertices() > kMinVertices) {
    CoarseGraph coarse = CoarsenGraph(finer.graph);
    // Isolated vertices cannot be clustered, nor can many small components.
    if (coarse.graph.num_vertices() > finer.graph.num_vertices() / 2) break;
    finer = std::move(coarse);
    SweepGraph sweep_graph(finer.graph);
    const double growth = MeanWeight(sweep_graph) / finest;
    levels.push_back(
        {std::move(sweep_graph), std::move(finer.cluster_of), {growth * weights.scale, growth * weights.deviation}});
  }
  return levels;
}

template <int kDegree>
std::vector<Harmonic<kDegree>> Prolongate(const Level& coarse, const std::vector<Harmonic<kDegree>>& field) {
  std::vector<Harmonic<kDegree>> fine;
  fine.reserve(coarse.cluster_of.size());
  for (const int cluster : coarse.cluster_of) fine.push_back(field[cluster]);
  return fine;
}

// The best of several starts, minimised on the graph `start_level`.
template <int kDegree>
std::vector<Harmonic<kDegree>> ChooseStart(const std::vector<Level>& levels, std::size_t start_level,
                                           std::uint32_t seed, Minimizer* minimizer) {
  const SweepGraph& graph = levels[start_level].graph;
  std::vector<std::vector<Harmonic<kDegree>>> starts;
  std::vector<std::string> names = {"linear start"};
  minimizer->BeginStep(names[0]);
  starts.push_back(internal::HarmonicsOf<kDegree>(internal::LinearFrames(graph, kFieldTolerance, seed, minimizer)));
  for (int i = 0; i < kNumRandomStarts; ++i) {
    names.push_back("random start " + std::to_string(i + 1));
    starts.push_back(RandomField<kDegree>(graph.alignments, seed * kNumRandomStarts + i));
  }
  if (start_level + 1 < levels.size()) {
    std::size_t level = levels.size() - 1;
    names.push_back("coarse start");
    minimizer->BeginStep(names.back());
    std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(levels[level].graph.alignments, seed);
    for (; level > start_level; --level) {
      MinimizeField<kDegree>(levels[level].graph, levels[level].weights, kFieldTolerance, minimizer, &field);
      field = Prolongate<kDegree>(levels[level], field);
    }
    starts.push_back(std::move(field));
  }
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    std::vector<Harmonic<kDegree>>& field = starts[i];
    minimizer->BeginStep(names[i]);
    MinimizeField<kDegree>(graph, levels[start_level].weights, kFieldTolerance, minimizer, &field);
    Frames frames = ProjectField<kDegree>(graph.alignments, field, minimizer->workers());
    const double energy = PolishFrames(graph, minimizer, &frames);
    if (energy >= lowest) continue;
    lowest = energy;
    best = i;
  }
  minimizer->Tell(names[best] + " chosen");
  return std::move(starts[best]);
}

// Of the coefficients, in doubles.
template <int kDegree>
double EnergyOf(const SweepGraph& graph, const EnergyWeights& weights, const std::vector<Harmonic<kDegree>>& field,
                Workers* workers) {
  const internal::FieldFunction<kDegree, double> function(graph, weights, workers);
  double cost = 0;
  function.Evaluate(function.ParametersOf(field).data(), &cost, nullptr);
  return 2 * cost;
}

// Solves on the finest graph, `original` in the order of `order`, from `field`, and gives the result in the caller's
// order.
template <int kDegree>
FieldSolution<kDegree> Finish(const FieldGraph& original, const SweepGraph& graph, const std::vector<int>& order,
                              const EnergyWeights& weights, std::vector<Harmonic<kDegree>> field,
                              Minimizer* minimizer) {
  FieldSolution<kDegree> result;
  result.size = SizeOfProblem(original, kUnknownsOfKind<kDegree>);
  minimizer->BeginStep("field");
  MinimizeField<kDegree>(graph, weights, kFieldTolerance, minimizer, &field);
  const bool is_converged = minimizer->termination() == ceres::CONVERGENCE;
  result.termination = minimizer->termination();
  if (result.termination == ceres::FAILURE) return result;
  result.energy = EnergyOf<kDegree>(graph, weights, field, minimizer->workers());
  Frames frames = ProjectField<kDegree>(graph.alignments, field, minimizer->workers());
  minimizer->BeginStep("frames");
  PolishFrames(graph, minimizer, &frames);
  if (is_converged) result.termination = minimizer->termination();
  result.iterations = minimizer->iterations();
  const Frames rest = internal::AllowedFrames(original);
  result.coefficients = internal::InOriginalOrder(order, field, internal::HarmonicsOf<kDegree>(rest));
  result.frames = internal::InOriginalOrder(order, frames, rest);
  return result;
}

}  // namespace

template <int kDegree>
FieldSolution<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights,
                                 const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const std::vector<Level> levels = MakeHierarchy(graph, order, weights);
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level].graph.num_vertices() > kMaxStartVertices) ++level;
  std::vector<Harmonic<kDegree>> field = ChooseStart<kDegree>(levels, level, options.seed, &minimizer);
  minimizer.BeginStep("level");
  for (; level > 0; --level) {
    MinimizeField<kDegree>(levels[level].graph, levels[level].weights, kFieldTolerance, &minimizer, &field);
    field = Prolongate<kDegree>(levels[level], field);
  }
  return Finish<kDegree>(graph, levels[0].graph, order, weights, std::move(field), &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                     const std::vector<Harmonic<kDegree>>& start, const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  CheckField<kDegree>("SolveFastFrom", graph, start);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  std::vector<Harmonic<kDegree>> field;
  field.reserve(order.size());
  for (const int v : order) field.push_back(start[v]);
  return Finish<kDegree>(graph, SweepGraph(Reorder(graph, order)), order, weights, std::move(field), &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> PolishField(const FieldGraph& graph, const EnergyWeights& weights, const Frames& frames,
                                   const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  if (frames.size() != graph.num_vertices()) {
    throw std::invalid_argument("PolishField: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(graph.num_vertices()) + " vertices");
  }
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const SweepGraph ordered(Reorder(graph, order));
  Frames polished;
  polished.reserve(order.size());
  for (const int v : order) {
    CheckRotation("PolishField", frames[v]);
    polished.push_back(frames[v]);
  }
  polished = AlignFrames(ordered.alignments, std::move(polished));
  PolishFrames(ordered, &minimizer, &polished, kChangeTolerance);
  FieldSolution<kDegree> result;
  static_cast<FrameSolution&>(result) =
      minimizer.MakeSolution(graph, order, polished, 0, SizeOfProblem(graph, kUnknownsOfKind<kDegree>));
  result.energy = EnergyOf<kDegree>(ordered, weights, internal::HarmonicsOf<kDegree>(polished), minimizer.workers());
  result.coefficients = internal::HarmonicsOf<kDegree>(result.frames);
  return result;
}

template FieldSolution<3> SolveFast<3>(const FieldGraph&, const EnergyWeights&, const MinimizerOptions&);
template FieldSolution<4> SolveFast<4>(const FieldGraph&, const EnergyWeights&, const MinimizerOptions&);
template FieldSolution<3> SolveFastFrom<3>(const FieldGraph&, const EnergyWeights&, const std::vector<Octupole>&,
                                           const MinimizerOptions&);
template FieldSolution<4> SolveFastFrom<4>(const FieldGraph&, const EnergyWeights&, const std::vector<Hexadecapole>&,
                                           const MinimizerOptions&);
template FieldSolution<3> PolishField<3>(const FieldGraph&, const EnergyWeights&, const Frames&,
                                         const MinimizerOptions&);
template FieldSolution<4> PolishField<4>(const FieldGraph&, const EnergyWeights&, const Frames&,
                                         const MinimizerOptions&);

}  // namespace octupole
