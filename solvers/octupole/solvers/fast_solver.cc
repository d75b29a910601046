#include "octupole/solvers/fast_solver.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/cost_functions/cost_weight.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/frames/frame.h"
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

// Starts begin on the finest graph of at most this many vertices, where they cost little.
constexpr std::size_t kMaxStartVertices = 2000;
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

template <int kDegree>
std::vector<Harmonic<kDegree>> Prolongate(const Level& coarse, const std::vector<Harmonic<kDegree>>& field) {
  std::vector<Harmonic<kDegree>> fine;
  fine.reserve(coarse.cluster_of.size());
  for (const int cluster : coarse.cluster_of) fine.push_back(field[cluster]);
  return fine;
}

// Brings a field to the finer graph `to`, minimising it on those that it leaves.
template <int kDegree>
void Refine(const std::vector<Level>& levels, std::size_t from, std::size_t to, Minimizer* minimizer,
            std::vector<Harmonic<kDegree>>* field) {
  for (std::size_t level = from; level > to; --level) {
    MinimizeField<kDegree>(levels[level].graph, levels[level].weights, kFieldTolerance, minimizer, field);
    *field = Prolongate<kDegree>(levels[level], *field);
  }
}

// Start number `i` on the graph `level`, in rounds of five: the linear one, three random ones and one from the coarsest
// graph. In later rounds the first and the third are found in the other degree, whose minima are others.
template <int kDegree>
std::vector<Harmonic<kDegree>> MakeStart(const std::vector<Level>& levels, std::size_t level, int i, std::uint32_t seed,
                                         Minimizer* minimizer, std::string* name) {
  constexpr int kOther = 7 - kDegree;
  constexpr std::uint32_t kSeedsApart = 1000003;
  const SweepGraph& graph = levels[level].graph;
  const int round = i / kRound, place = i % kRound;
  seed += static_cast<std::uint32_t>(round) * kSeedsApart;
  const std::uint32_t random_seed = 3 * seed + static_cast<std::uint32_t>(place) - 1;
  const auto begin = [&](const std::string& kind) {
    *name = kind + " start " + std::to_string(i + 1);
    minimizer->BeginStep(*name);
  };
  if (i == 0) {
    begin("linear");
    return internal::HarmonicsOf<kDegree>(internal::LinearFrames(graph, kFieldTolerance, seed, minimizer));
  }
  if (place == kRound - 1 && level + 1 < levels.size()) {
    begin("coarse");
    std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(levels.back().graph.alignments, seed);
    Refine<kDegree>(levels, levels.size() - 1, level, minimizer, &field);
    return field;
  }
  if (round > 0 && place % 2 == 0) {
    begin("degree " + std::to_string(kOther));
    std::vector<Harmonic<kOther>> field = RandomField<kOther>(graph.alignments, random_seed);
    MinimizeField<kOther>(graph, levels[level].weights, kFieldTolerance, minimizer, &field);
    return internal::HarmonicsOf<kDegree>(ProjectField<kOther>(graph.alignments, field, minimizer->workers()));
  }
  begin("random");
  return RandomField<kDegree>(graph.alignments, random_seed);
}

// A field, and its frames.
template <int kDegree>
struct Solved {
  std::string name;
  std::vector<Harmonic<kDegree>> field;
  Frames frames;
  /// Of the frames.
  double energy = 0;
};

// Minimises from `field`, and polishes the frames. Not where the minimiser fails.
template <int kDegree>
void Solve(const Level& level, Minimizer* minimizer, Solved<kDegree>* solved) {
  minimizer->BeginStep(solved->name.empty() ? "field" : solved->name);
  MinimizeField<kDegree>(level.graph, level.weights, kFieldTolerance, minimizer, &solved->field);
  if (minimizer->termination() == ceres::FAILURE) return;
  solved->frames = ProjectField<kDegree>(level.graph.alignments, solved->field, minimizer->workers());
  minimizer->BeginStep(solved->name.empty() ? "frames" : solved->name);
  solved->energy = PolishFrames(level.graph, minimizer, &solved->frames);
}

template <int kDegree>
void SolveAll(const Level& level, Minimizer* minimizer, std::vector<Solved<kDegree>>* starts) {
  for (Solved<kDegree>& start : *starts) Solve(level, minimizer, &start);
  std::stable_sort(starts->begin(), starts->end(), [](const auto& a, const auto& b) { return a.energy < b.energy; });
}

// The best of several starts on the finest graph that is small enough, `level`. A coarse graph tells badly which is the
// best: the better half goes on to the next finer graph, which `level` becomes, if it is more than one. Starts of the
// same energy have most likely ended in the same field, and count once.
template <int kDegree>
Solved<kDegree> ChooseStart(const std::vector<Level>& levels, const MinimizerOptions& options, Minimizer* minimizer,
                            std::size_t* level) {
  *level = 0;
  while (*level + 1 < levels.size() && levels[*level].graph.num_vertices() > kMaxStartVertices) ++*level;
  std::vector<Solved<kDegree>> starts(options.num_starts);
  for (int i = 0; i < options.num_starts; ++i) {
    starts[i].field = MakeStart<kDegree>(levels, *level, i, options.seed, minimizer, &starts[i].name);
  }
  SolveAll(levels[*level], minimizer, &starts);
  const auto is_same = [](const auto& a, const auto& b) { return b.energy - a.energy <= kSameEnergy * a.energy; };
  starts.erase(std::unique(starts.begin(), starts.end(), is_same), starts.end());
  starts.resize(std::min(starts.size(), std::max<std::size_t>(1, static_cast<std::size_t>(options.num_starts) / 2)));
  if (*level > 0 && starts.size() > 1) {
    for (Solved<kDegree>& start : starts) start.field = Prolongate<kDegree>(levels[*level], start.field);
    --*level;
    SolveAll(levels[*level], minimizer, &starts);
  }
  minimizer->Tell(starts[0].name + " chosen");
  return std::move(starts[0]);
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
                                    const Solved<kDegree>& solved, Minimizer* minimizer) {
  FieldSolution<kDegree> result;
  result.size = SizeOfProblem(original, kUnknownsOfKind<kDegree>);
  result.termination = minimizer->termination();
  if (result.termination == ceres::FAILURE) return result;
  result.energy = EnergyOf<kDegree>(finest.graph, finest.weights, solved.field, minimizer->workers());
  result.iterations = minimizer->iterations();
  result.coefficients = internal::InOriginalOrder(original, order, solved.field, [](const Alignment& alignment) {
    return HarmonicFromFrame<kDegree>(alignment.frame());
  });
  result.frames = internal::InOriginalOrder(original, order, solved.frames,
                                            [](const Alignment& alignment) { return alignment.frame(); });
  return result;
}

}  // namespace

template <int kDegree>
FieldSolution<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights,
                                 const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  if (options.num_starts < 1) {
    throw std::invalid_argument("SolveFast: num_starts must be at least 1, not " + std::to_string(options.num_starts));
  }
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const std::vector<Level> levels = MakeHierarchy(graph, order, weights);
  std::size_t level = 0;
  Solved<kDegree> solved = ChooseStart<kDegree>(levels, options, &minimizer, &level);
  if (level > 0) {
    minimizer.BeginStep("level");
    solved.field = Prolongate<kDegree>(levels[level], solved.field);
    Refine<kDegree>(levels, level - 1, 0, &minimizer, &solved.field);
    solved.name.clear();
    Solve(levels[0], &minimizer, &solved);
  } else if (minimizer.termination() != ceres::FAILURE) {
    // Further than it takes to compare.
    minimizer.BeginStep("frames");
    PolishFrames(levels[0].graph, &minimizer, &solved.frames);
  }
  return MakeSolution(graph, levels[0], order, solved, &minimizer);
}

template <int kDegree>
FieldSolution<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                     const std::vector<Harmonic<kDegree>>& start, const MinimizerOptions& options) {
  CheckProblem(graph, weights);
  CheckField<kDegree>("SolveFastFrom", graph, start);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const Level level = {SweepGraph(Reorder(graph, order)), {}, weights};
  Solved<kDegree> solved;
  solved.field.reserve(order.size());
  for (const int v : order) solved.field.push_back(start[v]);
  Solve(level, &minimizer, &solved);
  return MakeSolution(graph, level, order, solved, &minimizer);
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
  // Before there are two arrays of frames: it takes the most memory.
  const double energy =
      EnergyOf<kDegree>(ordered, weights, internal::HarmonicsOf<kDegree>(polished), minimizer.workers());
  FieldSolution<kDegree> result;
  static_cast<FrameSolution&>(result) =
      minimizer.MakeSolution(graph, order, polished, 0, SizeOfProblem(graph, kUnknownsOfKind<kDegree>));
  result.energy = energy;
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
