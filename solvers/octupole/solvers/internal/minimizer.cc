#include "octupole/solvers/internal/minimizer.h"

#include <type_traits>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/energies/internal/field_function.h"
#include "octupole/energies/internal/frame_function.h"
#include "octupole/frames/frame.h"
#include "octupole/minimization/lbfgs.h"

namespace octupole::internal {
namespace {

// Where the energy of all edges together is below this part of their weights, the field is constant. Frames an angle t
// apart have 20/3 t^2 or 16 t^2.
constexpr double kZeroEnergy = 1e-10;
// Below this part, what an iteration gains may be lost in the rounding of floats, whose last bit is 6e-8.
constexpr double kRoundEnergy = 1e-4;

template <typename Scalar, typename Function>
SmoothFunction<Scalar> SmoothFunctionOf(const Function& function) {
  return [&function](const Scalar* x, double* cost, Scalar* gradient) {
    function.Evaluate(x, cost, gradient);
    return true;
  };
}

// Minimises in floats and, where these end too early, on in doubles. `minimize` is called with a zero of the scalar to
// use, and returns the energy.
template <typename Minimize>
double MinimizeInFloats(const SweepGraph& graph, const Minimizer& minimizer, const Minimize& minimize) {
  const double energy = minimize(0.F);
  const bool is_reached = energy > 2 * kRoundEnergy * graph.sum_of_weights && minimizer.termination() != ceres::FAILURE;
  return is_reached ? energy : minimize(0.);
}

}  // namespace

template <typename Scalar>
double Minimizer::Minimize(const SmoothFunction<Scalar>& function, std::size_t num_vertices, double sum_of_weights,
                           double tolerance, std::vector<Scalar>* x) {
  LbfgsOptions options;
  options.cost_tolerance = (std::is_same_v<Scalar, float> ? kRoundEnergy : kZeroEnergy) * sum_of_weights;
  options.function_tolerance = tolerance;
  options.max_iterations = IsEnded() ? 0 : options_.max_iterations - static_cast<int>(iterations_.size());
  options.callback = this;
  const LbfgsSummary summary = MinimizeLbfgs<Scalar>(function, options, &workers_, x);
  if (!IsEnded()) termination_ = summary.termination;
  const double energy = 2 * summary.final_cost;
  if (options_.step_callback) {
    options_.step_callback({step_, num_vertices, summary.num_iterations, energy, Seconds()});
  }
  return energy;
}

double Minimizer::Minimize(const ceres::FirstOrderFunction& function, const FieldGraph& graph, double tolerance,
                           std::vector<double>* x) {
  return Minimize<double>(
      [&](const double* point, double* cost, double* gradient) { return function.Evaluate(point, cost, gradient); },
      graph.num_vertices(), SumOfWeights(graph), tolerance, x);
}

void Minimizer::Tell(std::string what) const {
  StepSummary summary;
  summary.name = std::move(what);
  summary.cumulative_time_in_seconds = Seconds();
  if (options_.step_callback) options_.step_callback(summary);
}

FrameSolution Minimizer::MakeSolution(const FieldGraph& graph, const std::vector<int>& order, const Frames& frames,
                                      double energy, const ProblemSize& size) const {
  FrameSolution solution;
  solution.termination = termination_;
  solution.frames = InOriginalOrder(graph, order, frames, [](const Alignment& alignment) { return alignment.frame(); });
  solution.energy = energy;
  solution.iterations = iterations_;
  solution.size = size;
  return solution;
}

ceres::CallbackReturnType Minimizer::operator()(const ceres::IterationSummary& summary) {
  iterations_.push_back(summary);
  iterations_.back().iteration = static_cast<int>(iterations_.size());
  iterations_.back().cumulative_time_in_seconds = Seconds();
  return options_.callback == nullptr ? ceres::SOLVER_CONTINUE : (*options_.callback)(iterations_.back());
}

template <int kDegree>
double MinimizeField(const SweepGraph& graph, const EnergyWeights& weights, double tolerance, Minimizer* minimizer,
                     std::vector<Harmonic<kDegree>>* field) {
  return MinimizeInFloats(graph, *minimizer, [&](auto zero) {
    using Scalar = decltype(zero);
    const FieldFunction<kDegree, Scalar> function(graph, weights, minimizer->workers());
    std::vector<Scalar> x = function.ParametersOf(*field);
    const double energy = minimizer->Minimize<Scalar>(SmoothFunctionOf<Scalar>(function), graph.num_vertices(),
                                                      graph.sum_of_weights, tolerance, &x);
    *field = function.FieldOf(x);
    return energy;
  });
}

template <int kDegree>
Frames ProjectField(const std::vector<Alignment>& alignments, const std::vector<Harmonic<kDegree>>& field,
                    Workers* workers) {
  constexpr std::size_t kGrain = 1024;
  Frames frames(field.size());
  workers->ForEachRange(field.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) frames[v] = NearestAlignedFrame<kDegree>(alignments[v], field[v]);
  });
  return frames;
}

double PolishFrames(const SweepGraph& graph, Minimizer* minimizer, Frames* frames, double tolerance) {
  return MinimizeInFloats(graph, *minimizer, [&](auto zero) {
    using Scalar = decltype(zero);
    const FrameFunction<Scalar> function(graph, *frames, minimizer->workers());
    std::vector<Scalar> x(function.num_parameters(), 0);
    const double energy = minimizer->Minimize<Scalar>(SmoothFunctionOf<Scalar>(function), graph.num_vertices(),
                                                      graph.sum_of_weights, tolerance, &x);
    *frames = function.FramesOf(x);
    return energy;
  });
}

double EnergyOfFrames(const SweepGraph& graph, const Frames& frames, Workers* workers) {
  const FrameFunction<double> function(graph, frames, workers);
  double cost = 0;
  function.Evaluate(std::vector<double>(function.num_parameters(), 0).data(), &cost, nullptr);
  return 2 * cost;
}

Frames LinearFrames(const SweepGraph& graph, double tolerance, std::uint32_t seed, Minimizer* minimizer) {
  std::vector<Hexadecapole> field = RandomField<4>(graph.alignments, seed);
  MinimizeField<4>(graph, {0, 0}, tolerance, minimizer, &field);
  return ProjectField<4>(graph.alignments, field, minimizer->workers());
}

template <int kDegree>
std::vector<Harmonic<kDegree>> HarmonicsOf(const Frames& frames) {
  std::vector<Harmonic<kDegree>> field;
  field.reserve(frames.size());
  for (const Eigen::Matrix3d& frame : frames) field.push_back(HarmonicFromFrame<kDegree>(frame));
  return field;
}

template double MinimizeField<3>(const SweepGraph&, const EnergyWeights&, double, Minimizer*, std::vector<Octupole>*);
template double MinimizeField<4>(const SweepGraph&, const EnergyWeights&, double, Minimizer*,
                                 std::vector<Hexadecapole>*);
template Frames ProjectField<3>(const std::vector<Alignment>&, const std::vector<Octupole>&, Workers*);
template Frames ProjectField<4>(const std::vector<Alignment>&, const std::vector<Hexadecapole>&, Workers*);
template std::vector<Octupole> HarmonicsOf<3>(const Frames&);
template std::vector<Hexadecapole> HarmonicsOf<4>(const Frames&);

}  // namespace octupole::internal
