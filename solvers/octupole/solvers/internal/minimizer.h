#pragma once

#include <ceres/first_order_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/types.h>

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "octupole/energies/field_problem.h"
#include "octupole/energies/internal/sweep_graph.h"
#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/minimization/internal/minimize_lbfgs.h"
#include "octupole/minimization/internal/seconds_since.h"
#include "octupole/minimization/workers.h"
#include "octupole/solvers/field_solution.h"

// The steps that the methods are made of.
namespace octupole::internal {

using Frames = std::vector<Eigen::Matrix3d>;

/// Relative decrease per iteration at which frames are polished.
inline constexpr double kFrameTolerance = 2e-5;

/// Values of the vertices of Reorder(graph, order), in the order of `graph`. What `order` leaves out has the value
/// rest(alignment).
template <typename Value, typename Rest>
std::vector<Value> InOriginalOrder(const FieldGraph& graph, const std::vector<int>& order,
                                   const std::vector<Value>& values, const Rest& rest) {
  std::vector<Value> result(graph.num_vertices());
  std::vector<bool> has_value(graph.num_vertices(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    result[order[i]] = values[i];
    has_value[order[i]] = true;
  }
  for (std::size_t v = 0; v < result.size(); ++v) {
    if (!has_value[v]) result[v] = rest(graph.alignments[v]);
  }
  return result;
}

/// Runs the minimisations of one solve: counts their iterations against the limit and passes them on to the caller.
class Minimizer final : public ceres::IterationCallback {
 public:
  explicit Minimizer(const MinimizerOptions& options) : options_(options), workers_(options.num_threads) {}

  /// Names what is minimised from now on, for MinimizerOptions::step_callback.
  void BeginStep(std::string name) { step_ = std::move(name); }
  /// Tells the caller something about the steps that is no minimisation.
  void Tell(std::string what) const;

  Workers* workers() { return &workers_; }
  const std::vector<ceres::IterationSummary>& iterations() const { return iterations_; }
  /// Of the last minimisation, unless an earlier one was ended by the caller.
  ceres::TerminationType termination() const { return termination_; }

  /// MinimizeLbfgs on a function of so many vertices, whose edges have half of that sum of weights or so in it. Returns
  /// the energy reached, twice the cost.
  template <typename Scalar>
  double Minimize(const SmoothFunction<Scalar>& function, std::size_t num_vertices, double sum_of_weights,
                  double tolerance, std::vector<Scalar>* x);
  double Minimize(const ceres::FirstOrderFunction& function, const FieldGraph& graph, double tolerance,
                  std::vector<double>* x);

  /// What a method found on Reorder(graph, order), in the order of the graph.
  FrameSolution MakeSolution(const FieldGraph& graph, const std::vector<int>& order, const Frames& frames,
                             double energy, const ProblemSize& size) const;

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override;

 private:
  bool IsEnded() const { return termination_ == ceres::USER_SUCCESS || termination_ == ceres::USER_FAILURE; }

  double Seconds() const { return SecondsSince(start_); }

  const MinimizerOptions& options_;
  std::string step_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Workers workers_;
  std::vector<ceres::IterationSummary> iterations_;
  ceres::TerminationType termination_ = ceres::CONVERGENCE;
};

/// Minimises the field energy from `field`, which becomes the result, and returns the energy, as rounded as floats are.
template <int kDegree>
double MinimizeField(const SweepGraph& graph, const EnergyWeights& weights, double tolerance, Minimizer* minimizer,
                     std::vector<Harmonic<kDegree>>* field);

/// The nearest frames that keep to the alignments.
template <int kDegree>
Frames ProjectField(const std::vector<Alignment>& alignments, const std::vector<Harmonic<kDegree>>& field,
                    Workers* workers);

/// Minimises the FrameEnergy from `frames`, which become the result, and returns the energy, as rounded as floats are.
double PolishFrames(const SweepGraph& graph, Minimizer* minimizer, Frames* frames, double tolerance = kFrameTolerance);

/// Twice the FrameEnergy of frames.
double EnergyOfFrames(const SweepGraph& graph, const Frames& frames, Workers* workers);

/// The linear start (see ray_sokolov.h): least squares in degree 4 without penalties, and the nearest frames. Where no
/// alignment bounds the least squares, the constant comes from a random field.
Frames LinearFrames(const SweepGraph& graph, double tolerance, std::uint32_t seed, Minimizer* minimizer);

template <int kDegree>
std::vector<Harmonic<kDegree>> HarmonicsOf(const Frames& frames);

}  // namespace octupole::internal
