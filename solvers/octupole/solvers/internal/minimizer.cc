#include "octupole/solvers/internal/minimizer.h"

#include "octupole/field/aligned_frame.h"
#include "octupole/frames/frame.h"
#include "octupole/solvers/field_energy.h"
#include "octupole/solvers/frame_energy.h"
#include "octupole/solvers/lbfgs.h"

namespace octupole::internal {
namespace {

// Where the energy of all edges together is below this part of their weights, the field is constant. Frames an angle t
// apart have 20/3 t^2 or 16 t^2.
constexpr double kZeroEnergy = 1e-10;

}  // namespace

Frames AllowedFrames(const FieldGraph& graph) {
  Frames frames;
  frames.reserve(graph.num_vertices());
  for (const Alignment& alignment : graph.alignments) frames.push_back(alignment.frame());
  return frames;
}

double Minimizer::Minimize(const ceres::FirstOrderFunction& function, const FieldGraph& graph, double tolerance,
                           std::vector<double>* x) {
  LbfgsOptions options;
  options.cost_tolerance = kZeroEnergy * SumOfWeights(graph);
  options.function_tolerance = tolerance;
  options.max_iterations = IsEnded() ? 0 : options_.max_iterations - static_cast<int>(iterations_.size());
  options.callback = this;
  const LbfgsSummary summary = MinimizeLbfgs(function, options, &workers_, x);
  if (!IsEnded()) termination_ = summary.termination;
  const double energy = 2 * summary.final_cost;
  if (options_.step_callback) {
    options_.step_callback({step_, graph.num_vertices(), summary.num_iterations, energy, Seconds()});
  }
  return energy;
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
  solution.frames = InOriginalOrder(order, frames, AllowedFrames(graph));
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
double MinimizeField(const FieldGraph& graph, const EnergyWeights& weights, double tolerance, Minimizer* minimizer,
                     std::vector<Harmonic<kDegree>>* field) {
  const FieldEnergy<kDegree> energy(graph, weights, minimizer->workers());
  std::vector<double> x = energy.ParametersOf(*field);
  const double result = minimizer->Minimize(energy, graph, tolerance, &x);
  *field = energy.FieldOf(x);
  return result;
}

template <int kDegree>
Frames ProjectField(const FieldGraph& graph, const std::vector<Harmonic<kDegree>>& field, Workers* workers) {
  constexpr std::size_t kGrain = 1024;
  Frames frames(field.size());
  workers->ForEachRange(field.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) frames[v] = NearestAlignedFrame<kDegree>(graph.alignments[v], field[v]);
  });
  return frames;
}

double PolishFrames(const FieldGraph& graph, Minimizer* minimizer, Frames* frames, double tolerance) {
  const FrameEnergy energy(graph, *frames, minimizer->workers());
  std::vector<double> x(energy.NumParameters(), 0);
  const double result = minimizer->Minimize(energy, graph, tolerance, &x);
  *frames = energy.FramesOf(x);
  return result;
}

Frames LinearFrames(const FieldGraph& graph, double tolerance, std::uint32_t seed, Minimizer* minimizer) {
  std::vector<Hexadecapole> field = RandomField<4>(graph, seed);
  MinimizeField<4>(graph, {0, 0}, tolerance, minimizer, &field);
  return ProjectField<4>(graph, field, minimizer->workers());
}

template <int kDegree>
std::vector<Harmonic<kDegree>> HarmonicsOf(const Frames& frames) {
  std::vector<Harmonic<kDegree>> field;
  field.reserve(frames.size());
  for (const Eigen::Matrix3d& frame : frames) field.push_back(HarmonicFromFrame<kDegree>(frame));
  return field;
}

template double MinimizeField<3>(const FieldGraph&, const EnergyWeights&, double, Minimizer*, std::vector<Octupole>*);
template double MinimizeField<4>(const FieldGraph&, const EnergyWeights&, double, Minimizer*,
                                 std::vector<Hexadecapole>*);
template Frames ProjectField<3>(const FieldGraph&, const std::vector<Octupole>&, Workers*);
template Frames ProjectField<4>(const FieldGraph&, const std::vector<Hexadecapole>&, Workers*);
template std::vector<Octupole> HarmonicsOf<3>(const Frames&);
template std::vector<Hexadecapole> HarmonicsOf<4>(const Frames&);

}  // namespace octupole::internal
