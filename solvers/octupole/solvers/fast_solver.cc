#include "octupole/solvers/fast_solver.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/field/aligned_frame.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/solvers/field_energy.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {
namespace {

using internal::Frames;
using internal::MinimizeField;
using internal::Minimizer;
using internal::PolishFrames;
using internal::ProjectField;

// The starts are tried on the finest graph of at most this many vertices, where they cost little.
constexpr std::size_t kMaxStartVertices = 2000;
// Graphs are not coarsened below this.
constexpr std::size_t kMinVertices = 100;
constexpr int kNumRandomStarts = 3;
// Relative decrease per iteration at which the minimisation of a field ends.
constexpr double kFieldTolerance = 1e-4;
// The same after a local change, which is but a small part of the energy.
constexpr double kChangeTolerance = 1e-5;

double MeanWeight(const FieldGraph& graph) {
  return SumOfWeights(graph) / static_cast<double>(std::max<std::size_t>(1, graph.num_vertices()));
}

// The graphs from fine to coarse. The first has a locality of memory that a mesh's own order often lacks.
std::vector<CoarseGraph> MakeHierarchy(const FieldGraph& graph, const std::vector<int>& order) {
  std::vector<CoarseGraph> levels(1);
  levels[0].graph = Reorder(graph, order);
  while (levels.back().graph.num_vertices() > kMinVertices) {
    const std::size_t num_vertices = levels.back().graph.num_vertices();
    CoarseGraph coarse = CoarsenGraph(levels.back().graph);
    // Isolated vertices cannot be clustered, nor can many small components.
    if (coarse.graph.num_vertices() > num_vertices / 2) break;
    levels.push_back(std::move(coarse));
  }
  return levels;
}

template <int kDegree>
std::vector<Harmonic<kDegree>> Prolongate(const CoarseGraph& coarse, const std::vector<Harmonic<kDegree>>& field) {
  std::vector<Harmonic<kDegree>> fine;
  fine.reserve(coarse.cluster_of.size());
  for (const int cluster : coarse.cluster_of) fine.push_back(field[cluster]);
  return fine;
}

// The energy weights for each graph. Clustering adds weights up; penalties that grow in proportion leave the balance,
// and so the ease with which a field turns, as it is on the finest graph.
std::vector<EnergyWeights> WeightsOfLevels(const std::vector<CoarseGraph>& levels, const EnergyWeights& weights) {
  // Not zero: a graph without weights is not coarsened.
  const double finest = MeanWeight(levels[0].graph);
  std::vector<EnergyWeights> result = {weights};
  for (std::size_t level = 1; level < levels.size(); ++level) {
    const double growth = MeanWeight(levels[level].graph) / finest;
    result.push_back({growth * weights.scale, growth * weights.deviation});
  }
  return result;
}

// The best of several starts, minimised on the graph `start_level`.
template <int kDegree>
std::vector<Harmonic<kDegree>> ChooseStart(const std::vector<CoarseGraph>& levels,
                                           const std::vector<EnergyWeights>& weights, std::size_t start_level,
                                           std::uint32_t seed, Minimizer* minimizer) {
  const FieldGraph& graph = levels[start_level].graph;
  std::vector<std::vector<Harmonic<kDegree>>> starts;
  std::vector<std::string> names = {"linear start"};
  minimizer->BeginStep(names[0]);
  starts.push_back(internal::HarmonicsOf<kDegree>(internal::LinearFrames(graph, kFieldTolerance, seed, minimizer)));
  for (int i = 0; i < kNumRandomStarts; ++i) {
    names.push_back("random start " + std::to_string(i + 1));
    starts.push_back(RandomField<kDegree>(graph, seed * kNumRandomStarts + i));
  }
  if (start_level + 1 < levels.size()) {
    std::size_t level = levels.size() - 1;
    names.push_back("coarse start");
    minimizer->BeginStep(names.back());
    std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(levels[level].graph, seed);
    for (; level > start_level; --level) {
      MinimizeField<kDegree>(levels[level].graph, weights[level], kFieldTolerance, minimizer, &field);
      field = Prolongate<kDegree>(levels[level], field);
    }
    starts.push_back(std::move(field));
  }
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    std::vector<Harmonic<kDegree>>& field = starts[i];
    minimizer->BeginStep(names[i]);
    MinimizeField<kDegree>(graph, weights[start_level], kFieldTolerance, minimizer, &field);
    Frames frames = ProjectField<kDegree>(graph, field, minimizer->workers());
    const double energy = PolishFrames(graph, minimizer, &frames);
    if (energy >= lowest) continue;
    lowest = energy;
    best = i;
  }
  minimizer->Tell(names[best] + " chosen");
  return std::move(starts[best]);
}

// Solves on the finest graph, `original` in the order of `order`, from `field`, and gives the result in the caller's
// order.
template <int kDegree>
FieldSolution<kDegree> Finish(const FieldGraph& original, const FieldGraph& graph, const std::vector<int>& order,
                              const EnergyWeights& weights, std::vector<Harmonic<kDegree>> field,
                              Minimizer* minimizer) {
  FieldSolution<kDegree> result;
  result.size = SizeOfProblem(original, kUnknownsOfKind<kDegree>);
  minimizer->BeginStep("field");
  result.energy = MinimizeField<kDegree>(graph, weights, kFieldTolerance, minimizer, &field);
  const bool is_converged = minimizer->termination() == ceres::CONVERGENCE;
  result.termination = minimizer->termination();
  if (result.termination == ceres::FAILURE) return result;
  Frames frames = ProjectField<kDegree>(graph, field, minimizer->workers());
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
  CheckFieldGraph(graph);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const std::vector<CoarseGraph> levels = MakeHierarchy(graph, order);
  const std::vector<EnergyWeights> level_weights = WeightsOfLevels(levels, weights);
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level].graph.num_vertices() > kMaxStartVertices) ++level;
  std::vector<Harmonic<kDegree>> field = ChooseStart<kDegree>(levels, level_weights, level, options.seed, &minimizer);
  minimizer.BeginStep("level");
  for (; level > 0; --level) {
    MinimizeField<kDegree>(levels[level].graph, level_weights[level], kFieldTolerance, &minimizer, &field);
    field = Prolongate<kDegree>(levels[level], field);
  }
  return Finish<kDegree>(graph, levels[0].graph, order, weights, std::move(field), &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                     const std::vector<Harmonic<kDegree>>& start, const MinimizerOptions& options) {
  CheckFieldGraph(graph);
  CheckField<kDegree>("SolveFastFrom", graph, start);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  std::vector<Harmonic<kDegree>> field;
  field.reserve(order.size());
  for (const int v : order) field.push_back(start[v]);
  return Finish<kDegree>(graph, Reorder(graph, order), order, weights, std::move(field), &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> PolishField(const FieldGraph& graph, const EnergyWeights& weights, const Frames& frames,
                                   const MinimizerOptions& options) {
  CheckFieldGraph(graph);
  if (frames.size() != graph.num_vertices()) {
    throw std::invalid_argument("PolishField: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(graph.num_vertices()) + " vertices");
  }
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const FieldGraph ordered = Reorder(graph, order);
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
  result.coefficients = internal::HarmonicsOf<kDegree>(result.frames);
  const FieldEnergy<kDegree> energy(graph, weights, minimizer.workers());
  energy.Evaluate(energy.ParametersOf(result.coefficients).data(), &result.energy, nullptr);
  result.energy *= 2;
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
