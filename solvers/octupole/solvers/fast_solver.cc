#include "octupole/solvers/fast_solver.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/cost_functions/cost_weight.h"
#include "octupole/energies/internal/field_function.h"
#include "octupole/energies/internal/sweep_graph.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/field/field_quality.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {
namespace {

using internal::Frames;
using internal::MinimizeField;
using internal::Minimizer;
using internal::PolishFrames;
using internal::ProjectField;
using internal::SweepGraph;

constexpr int kRound = 5;
// Relative difference of energies up to which starts count as one.
constexpr double kSameEnergy = 1e-4;
// Graphs are not coarsened below this.
constexpr std::size_t kMinVertices = 100;
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

// From the clusters of a graph to the vertices of the next finer one.
template <typename Value>
std::vector<Value> Prolongate(const Level& coarse, const std::vector<Value>& values) {
  std::vector<Value> fine;
  fine.reserve(coarse.cluster_of.size());
  for (const int cluster : coarse.cluster_of) fine.push_back(values[cluster]);
  return fine;
}

// From the next coarser graph to that of `level`.
Frames ProlongateFrames(const std::vector<Level>& levels, std::size_t level, const Frames& frames) {
  return AlignFrames(levels[level].graph.alignments, Prolongate(levels[level + 1], frames));
}

// Frames on one of the graphs, and where they come from.
struct Start {
  std::string name;
  Frames frames;
  double energy = 0;
};

void Polish(const Level& level, const std::string& step, Minimizer* minimizer, Start* start) {
  minimizer->BeginStep(step);
  start->energy = PolishFrames(level.graph, minimizer, &start->frames);
}

// Minimises the field energy from `field`, which becomes the result, and then that of its frames.
template <int kDegree>
void Solve(const Level& level, const std::string& field_step, const std::string& frames_step, Minimizer* minimizer,
           std::vector<Harmonic<kDegree>>* field, Start* start) {
  minimizer->BeginStep(field_step);
  MinimizeField<kDegree>(level.graph, level.weights, kFieldTolerance, minimizer, field);
  if (minimizer->termination() == ceres::FAILURE) return;
  start->frames = ProjectField<kDegree>(level.graph.alignments, *field, minimizer->workers());
  Polish(level, frames_step, minimizer, start);
}

// Brings a field to the finer graph `to`, minimising it on those that it leaves.
template <int kDegree>
void Refine(const std::vector<Level>& levels, std::size_t from, std::size_t to, Minimizer* minimizer,
            std::vector<Harmonic<kDegree>>* field) {
  for (std::size_t level = from; level > to; --level) {
    MinimizeField<kDegree>(levels[level].graph, levels[level].weights, kFieldTolerance, minimizer, field);
    *field = Prolongate(levels[level], *field);
  }
}

// From the linear field, which becomes the result.
template <int kDegree>
Start SolveLinear(const Level& level, const std::string& name, std::uint32_t seed, Minimizer* minimizer,
                  std::vector<Harmonic<kDegree>>* field) {
  Start start = {name, {}, 0};
  minimizer->BeginStep(name);
  *field = internal::HarmonicsOf<kDegree>(internal::LinearFrames(level.graph, kFieldTolerance, seed, minimizer));
  Solve<kDegree>(level, name, name, minimizer, field, &start);
  return start;
}

// From a random field on the graph `from`, on it and those between it and the finer `level`.
template <int kDegree>
Start SolveRandom(const std::vector<Level>& levels, std::size_t from, std::size_t level, const std::string& name,
                  std::uint32_t seed, Minimizer* minimizer) {
  Start start = {name, {}, 0};
  minimizer->BeginStep(name);
  std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(levels[from].graph.alignments, seed);
  Refine<kDegree>(levels, from, level, minimizer, &field);
  Solve<kDegree>(levels[level], name, name, minimizer, &field, &start);
  return start;
}

// Start number `i` on the graph `level`, in rounds of five: the linear one, three random ones and one from the coarsest
// graph. Every second is found in the other degree, whose minima are others. From the coarsest graph, where often
// nothing is left to chance, one in each degree; random ones in their place after that.
template <int kDegree>
Start MakeStart(const std::vector<Level>& levels, std::size_t level, int i, std::uint32_t seed, Minimizer* minimizer) {
  constexpr std::uint32_t kSeedsApart = 1000003;
  const int round = i / kRound, place = i % kRound;
  seed += static_cast<std::uint32_t>(round) * kSeedsApart;
  const std::string number = " start " + std::to_string(i + 1);
  if (i == 0) {
    std::vector<Harmonic<kDegree>> field;
    return SolveLinear<kDegree>(levels[level], "linear" + number, seed, minimizer, &field);
  }
  const bool is_coarse = place == kRound - 1 && round < 2 && level + 1 < levels.size();
  const std::size_t from = is_coarse ? levels.size() - 1 : level;
  const std::string name = (is_coarse ? "coarse" : "random") + number;
  if (!is_coarse) seed = 3 * seed + static_cast<std::uint32_t>(place) - 1;
  return i % 2 == 1 ? SolveRandom<7 - kDegree>(levels, from, level, name, seed, minimizer)
                    : SolveRandom<kDegree>(levels, from, level, name, seed, minimizer);
}

// Of energies in that order on one graph; near a constant field, up to rounding.
auto IsSameEnergyOn(const SweepGraph& graph) {
  constexpr double kRounding = 1e-8;
  return [rounding = kRounding * graph.sum_of_weights](const Start& a, const Start& b) {
    return b.energy - a.energy <= kSameEnergy * a.energy + rounding;
  };
}

void SortByEnergy(std::vector<Start>* starts) {
  std::stable_sort(starts->begin(), starts->end(), [](const Start& a, const Start& b) { return a.energy < b.energy; });
}

// Starts on the graph `level`, the lowest energy first: another round while no two agree on the lowest. Only one round
// where the finest graph is finer than the next: the lowest of many on a graph so coarse is lowest there by accident.
template <int kDegree>
std::vector<Start> MakeStarts(const std::vector<Level>& levels, std::size_t level, const MinimizerOptions& options,
                              Minimizer* minimizer) {
  const auto is_same = IsSameEnergyOn(levels[level].graph);
  std::vector<Start> starts;
  for (int i = 0; i < options.num_starts && minimizer->termination() != ceres::FAILURE; ++i) {
    if (i > 0 && i % kRound == 0 && (level > 1 || is_same(starts[0], starts[1]))) break;
    starts.push_back(MakeStart<kDegree>(levels, level, i, options.seed, minimizer));
    SortByEnergy(&starts);
  }
  return starts;
}

// The best of several starts on the finest graph that is small enough, `level`. A coarse graph tells badly which is the
// best: the better half goes on to the next finer graph, which `level` becomes, if it is more than one; there the best
// also by the field that it begins, which may find a lower energy than its frames. Starts of the same energy have most
// likely ended in the same field, and count once.
template <int kDegree>
Start ChooseStart(const std::vector<Level>& levels, const MinimizerOptions& options, std::size_t max_start_vertices,
                  Minimizer* minimizer, std::size_t* level) {
  *level = 0;
  while (*level + 1 < levels.size() && levels[*level].graph.num_vertices() > max_start_vertices) ++*level;
  std::vector<Start> starts = MakeStarts<kDegree>(levels, *level, options, minimizer);
  const std::size_t half = std::max<std::size_t>(1, starts.size() / 2);
  starts.erase(std::unique(starts.begin(), starts.end(), IsSameEnergyOn(levels[*level].graph)), starts.end());
  starts.resize(std::min(starts.size(), half));
  if (*level > 0 && starts.size() > 1 && minimizer->termination() != ceres::FAILURE) {
    const Level& finer = levels[--*level];
    Start best;
    std::size_t place = 0;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      Start start = {starts[i].name, ProlongateFrames(levels, *level, starts[i].frames), 0};
      Polish(finer, start.name, minimizer, &start);
      if (i > 0 && start.energy >= best.energy) continue;
      best = std::move(start);
      place = i;
    }
    std::vector<Harmonic<kDegree>> field =
        internal::HarmonicsOf<kDegree>(ProlongateFrames(levels, *level, starts[place].frames));
    Start by_field = {best.name, {}, 0};
    Solve<kDegree>(finer, best.name, best.name, minimizer, &field, &by_field);
    starts[0] = by_field.energy < best.energy ? std::move(by_field) : std::move(best);
  }
  minimizer->Tell(starts[0].name + " chosen");
  return std::move(starts[0]);
}

// Brings a field from `level` to a finer graph, if there is one between it and the finest, and there tries a linear
// start, too: the starts were on graphs that see nothing smaller than their clusters. The lower of the two goes on.
template <int kDegree>
void TryLinearOnFiner(const std::vector<Level>& levels, std::uint32_t seed, Minimizer* minimizer, std::size_t* level,
                      std::vector<Harmonic<kDegree>>* field) {
  constexpr std::size_t kMaxVertices = 80000;  // above, it would take longer than all the rest
  const auto is_small = [&](const Level& each) { return each.graph.num_vertices() <= kMaxVertices; };
  const auto place = std::find_if(levels.begin() + 1, levels.end(), is_small);
  const auto finer = static_cast<std::size_t>(place - levels.begin());
  if (finer > *level) return;
  minimizer->BeginStep("level");
  Refine<kDegree>(levels, *level, finer, minimizer, field);
  *level = finer;
  Start refined;
  Solve<kDegree>(*place, "level", "level", minimizer, field, &refined);
  std::vector<Harmonic<kDegree>> linear_field;
  const Start linear = SolveLinear<kDegree>(*place, "linear start on a finer graph", seed, minimizer, &linear_field);
  if (linear.energy >= refined.energy || minimizer->termination() == ceres::FAILURE) return;
  minimizer->Tell(linear.name + " chosen");
  *field = std::move(linear_field);
}

// From a start on the graph `level` to the finest: the field there, and in `start` its frames.
template <int kDegree>
std::vector<Harmonic<kDegree>> SolveOnFinest(const std::vector<Level>& levels, std::size_t level, std::uint32_t seed,
                                             Minimizer* minimizer, Start* start) {
  std::vector<Harmonic<kDegree>> field;
  if (level == 0) {
    // Further than it takes to compare; then the field next to them.
    Polish(levels[0], "frames", minimizer, start);
    field = internal::HarmonicsOf<kDegree>(start->frames);
    minimizer->BeginStep("field");
    MinimizeField<kDegree>(levels[0].graph, levels[0].weights, kFieldTolerance, minimizer, &field);
    return field;
  }
  field = internal::HarmonicsOf<kDegree>(ProlongateFrames(levels, --level, start->frames));
  TryLinearOnFiner<kDegree>(levels, seed, minimizer, &level, &field);
  minimizer->BeginStep("level");
  Refine<kDegree>(levels, level, 0, minimizer, &field);
  Solve<kDegree>(levels[0], "field", "frames", minimizer, &field, start);
  return field;
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

// What was found on the finest graph, `original` in the order of `order`, in the caller's order.
template <int kDegree>
FieldSolution<kDegree> MakeSolution(const FieldGraph& original, const Level& finest, const std::vector<int>& order,
                                    const std::vector<Harmonic<kDegree>>& field, const Frames& frames,
                                    Minimizer* minimizer) {
  FieldSolution<kDegree> result;
  result.size = SizeOfProblem(original, kUnknownsOfKind<kDegree>);
  result.termination = minimizer->termination();
  if (result.termination == ceres::FAILURE) return result;
  result.energy = EnergyOf<kDegree>(finest.graph, finest.weights, field, minimizer->workers());
  result.iterations = minimizer->iterations();
  result.coefficients = internal::InOriginalOrder(
      original, order, field, [](const Alignment& alignment) { return HarmonicFromFrame<kDegree>(alignment.frame()); });
  result.frames =
      internal::InOriginalOrder(original, order, frames, [](const Alignment& alignment) { return alignment.frame(); });
  return result;
}

}  // namespace

template <int kDegree>
FieldSolution<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights, const MinimizerOptions& options,
                                 std::size_t max_start_vertices) {
  CheckProblem(graph, weights);
  if (options.num_starts < 1) {
    throw std::invalid_argument("SolveFast: num_starts must be at least 1, not " + std::to_string(options.num_starts));
  }
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const std::vector<Level> levels = MakeHierarchy(graph, order, weights);
  std::size_t level = 0;
  Start start = ChooseStart<kDegree>(levels, options, max_start_vertices, &minimizer, &level);
  std::vector<Harmonic<kDegree>> field;
  if (minimizer.termination() != ceres::FAILURE) {
    field = SolveOnFinest<kDegree>(levels, level, options.seed, &minimizer, &start);
  }
  return MakeSolution<kDegree>(graph, levels[0], order, field, start.frames, &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                     const std::vector<Harmonic<kDegree>>& start, const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  CheckField<kDegree>("SolveFastFrom", graph, start);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const Level level = {SweepGraph(Reorder(graph, order)), {}, weights};
  std::vector<Harmonic<kDegree>> field;
  field.reserve(order.size());
  for (const int v : order) field.push_back(start[v]);
  Start result;
  Solve<kDegree>(level, "field", "frames", &minimizer, &field, &result);
  return MakeSolution<kDegree>(graph, level, order, field, result.frames, &minimizer);
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
  result.energy = SmoothnessOfFrames<kDegree>(graph.edges, result.frames);
  result.coefficients = internal::HarmonicsOf<kDegree>(result.frames);
  return result;
}

template FieldSolution<3> SolveFast<3>(const FieldGraph&, const EnergyWeights&, const MinimizerOptions&, std::size_t);
template FieldSolution<4> SolveFast<4>(const FieldGraph&, const EnergyWeights&, const MinimizerOptions&, std::size_t);
template FieldSolution<3> SolveFastFrom<3>(const FieldGraph&, const EnergyWeights&, const std::vector<Octupole>&,
                                           const MinimizerOptions&);
template FieldSolution<4> SolveFastFrom<4>(const FieldGraph&, const EnergyWeights&, const std::vector<Hexadecapole>&,
                                           const MinimizerOptions&);
template FieldSolution<3> PolishField<3>(const FieldGraph&, const EnergyWeights&, const Frames&,
                                         const MinimizerOptions&);
template FieldSolution<4> PolishField<4>(const FieldGraph&, const EnergyWeights&, const Frames&,
                                         const MinimizerOptions&);

}  // namespace octupole
