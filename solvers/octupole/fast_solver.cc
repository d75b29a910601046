#include "octupole/fast_solver.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/aligned_frame.h"
#include "octupole/coarse_graph.h"
#include "octupole/field_energy.h"
#include "octupole/frame.h"
#include "octupole/frame_energy.h"
#include "octupole/lbfgs.h"
#include "octupole/workers.h"

namespace octupole {
namespace {

using Frames = std::vector<Eigen::Matrix3d>;

// The starts are tried on the finest graph of at most this many vertices, where they cost little.
constexpr std::size_t kMaxStartVertices = 2000;
// Graphs are not coarsened below this.
constexpr std::size_t kMinVertices = 100;
constexpr int kNumRandomStarts = 3;
// Relative decrease per iteration at which a minimisation ends: of the field and of the frames.
constexpr double kFieldTolerance = 1e-4;
constexpr double kFrameTolerance = 2e-5;
// Where the energy of all edges together is below this part of their weights, the field is constant. Frames an angle t
// apart have 20/3 t^2 or 16 t^2.
constexpr double kZeroEnergy = 1e-10;

double SumOfWeights(const FieldGraph& graph) {
  double sum = 0;
  for (const WeightedEdge& edge : graph.edges) sum += edge.weight;
  return sum;
}

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

template <int kDegree>
Frames Project(const FieldGraph& graph, const std::vector<Harmonic<kDegree>>& field, Workers* workers) {
  constexpr std::size_t kGrain = 1024;
  Frames frames(field.size());
  workers->ForEachRange(field.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) frames[v] = NearestAlignedFrame<kDegree>(graph.alignments[v], field[v]);
  });
  return frames;
}

// Runs the minimisations of one solve: counts their iterations against the limit and passes them on to the caller.
class Minimizer final : public ceres::IterationCallback {
 public:
  explicit Minimizer(const FastSolverOptions& options) : options_(options), workers_(options.num_threads) {}

  Workers* workers() { return &workers_; }
  const std::vector<ceres::IterationSummary>& iterations() const { return iterations_; }
  /// Of the last minimisation, unless an earlier one was ended by the caller.
  ceres::TerminationType termination() const { return termination_; }

  /// Returns the energy reached, twice the cost.
  double Minimize(const ceres::FirstOrderFunction& function, const FieldGraph& graph, double tolerance,
                  std::vector<double>* x) {
    LbfgsOptions options;
    options.cost_tolerance = kZeroEnergy * SumOfWeights(graph);
    options.function_tolerance = tolerance;
    options.max_iterations = IsEnded() ? 0 : options_.max_iterations - static_cast<int>(iterations_.size());
    options.callback = this;
    const LbfgsSummary summary = MinimizeLbfgs(function, options, &workers_, x);
    if (!IsEnded()) termination_ = summary.termination;
    return 2 * summary.final_cost;
  }

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    iterations_.push_back(summary);
    iterations_.back().iteration = static_cast<int>(iterations_.size());
    iterations_.back().cumulative_time_in_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return options_.callback == nullptr ? ceres::SOLVER_CONTINUE : (*options_.callback)(iterations_.back());
  }

 private:
  bool IsEnded() const { return termination_ == ceres::USER_SUCCESS || termination_ == ceres::USER_FAILURE; }

  const FastSolverOptions& options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Workers workers_;
  std::vector<ceres::IterationSummary> iterations_;
  ceres::TerminationType termination_ = ceres::CONVERGENCE;
};

// Minimises the field energy from `field`, which becomes the result, and returns the energy.
template <int kDegree>
double MinimizeField(const FieldGraph& graph, const EnergyWeights& weights, Minimizer* minimizer,
                     std::vector<Harmonic<kDegree>>* field, int* num_unknowns = nullptr) {
  const FieldEnergy<kDegree> energy(graph, weights, minimizer->workers());
  std::vector<double> x = energy.ParametersOf(*field);
  const double result = minimizer->Minimize(energy, graph, kFieldTolerance, &x);
  *field = energy.FieldOf(x);
  if (num_unknowns != nullptr) *num_unknowns = energy.NumParameters();
  return result;
}

double Polish(const FieldGraph& graph, Minimizer* minimizer, Frames* frames) {
  const FrameEnergy energy(graph, *frames, minimizer->workers());
  std::vector<double> x(energy.NumParameters(), 0);
  const double result = minimizer->Minimize(energy, graph, kFrameTolerance, &x);
  *frames = energy.FramesOf(x);
  return result;
}

template <int kDegree>
std::vector<Harmonic<kDegree>> LinearStart(const FieldGraph& graph, std::uint32_t seed, Minimizer* minimizer) {
  // Without penalties the energy is quadratic. Where no alignment bounds it, the constant comes from the random start.
  std::vector<Hexadecapole> field = RandomField<4>(graph, seed);
  MinimizeField<4>(graph, {0, 0}, minimizer, &field);
  std::vector<Harmonic<kDegree>> start;
  start.reserve(field.size());
  for (const Eigen::Matrix3d& frame : Project<4>(graph, field, minimizer->workers())) {
    start.push_back(HarmonicFromFrame<kDegree>(frame));
  }
  return start;
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
  starts.push_back(LinearStart<kDegree>(graph, seed, minimizer));
  for (int i = 0; i < kNumRandomStarts; ++i) {
    starts.push_back(RandomField<kDegree>(graph, seed * kNumRandomStarts + i));
  }
  if (start_level + 1 < levels.size()) {
    std::size_t level = levels.size() - 1;
    std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(levels[level].graph, seed);
    for (; level > start_level; --level) {
      MinimizeField<kDegree>(levels[level].graph, weights[level], minimizer, &field);
      field = Prolongate<kDegree>(levels[level], field);
    }
    starts.push_back(std::move(field));
  }
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<Harmonic<kDegree>> best = starts[0];
  for (std::vector<Harmonic<kDegree>>& field : starts) {
    MinimizeField<kDegree>(graph, weights[start_level], minimizer, &field);
    Frames frames = Project<kDegree>(graph, field, minimizer->workers());
    const double energy = Polish(graph, minimizer, &frames);
    if (energy >= lowest) continue;
    lowest = energy;
    best = std::move(field);
  }
  return best;
}

// Solves on the finest graph from `field`, in the order of `order`, and gives the result in the caller's order.
template <int kDegree>
FastField<kDegree> Finish(const FieldGraph& graph, const std::vector<int>& order, const EnergyWeights& weights,
                          std::vector<Harmonic<kDegree>> field, Minimizer* minimizer) {
  FastField<kDegree> result;
  result.energy = MinimizeField<kDegree>(graph, weights, minimizer, &field, &result.num_unknowns);
  const bool is_converged = minimizer->termination() == ceres::CONVERGENCE;
  result.termination = minimizer->termination();
  if (result.termination == ceres::FAILURE) return result;
  Frames frames = Project<kDegree>(graph, field, minimizer->workers());
  Polish(graph, minimizer, &frames);
  if (is_converged) result.termination = minimizer->termination();
  result.iterations = minimizer->iterations();
  result.coefficients.resize(order.size());
  result.frames.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.coefficients[order[i]] = field[i];
    result.frames[order[i]] = frames[i];
  }
  return result;
}

}  // namespace

template <int kDegree>
FastField<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights, const FastSolverOptions& options) {
  CheckFieldGraph(graph);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const std::vector<CoarseGraph> levels = MakeHierarchy(graph, order);
  const std::vector<EnergyWeights> level_weights = WeightsOfLevels(levels, weights);
  std::size_t level = 0;
  while (level + 1 < levels.size() && levels[level].graph.num_vertices() > kMaxStartVertices) ++level;
  std::vector<Harmonic<kDegree>> field = ChooseStart<kDegree>(levels, level_weights, level, options.seed, &minimizer);
  for (; level > 0; --level) {
    MinimizeField<kDegree>(levels[level].graph, level_weights[level], &minimizer, &field);
    field = Prolongate<kDegree>(levels[level], field);
  }
  return Finish<kDegree>(levels[0].graph, order, weights, std::move(field), &minimizer);
}

template <int kDegree>
FastField<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                 const std::vector<Harmonic<kDegree>>& start, const FastSolverOptions& options) {
  CheckFieldGraph(graph);
  CheckField<kDegree>("SolveFastFrom", graph, start);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  std::vector<Harmonic<kDegree>> field;
  field.reserve(order.size());
  for (const int v : order) field.push_back(start[v]);
  return Finish<kDegree>(Reorder(graph, order), order, weights, std::move(field), &minimizer);
}

template FastField<3> SolveFast<3>(const FieldGraph&, const EnergyWeights&, const FastSolverOptions&);
template FastField<4> SolveFast<4>(const FieldGraph&, const EnergyWeights&, const FastSolverOptions&);
template FastField<3> SolveFastFrom<3>(const FieldGraph&, const EnergyWeights&, const std::vector<Octupole>&,
                                       const FastSolverOptions&);
template FastField<4> SolveFastFrom<4>(const FieldGraph&, const EnergyWeights&, const std::vector<Hexadecapole>&,
                                       const FastSolverOptions&);

}  // namespace octupole
