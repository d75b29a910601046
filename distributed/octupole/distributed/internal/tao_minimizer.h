#pragma once

#include <ceres/types.h>
#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "octupole/distributed/internal/graph_level.h"
#include "octupole/minimization/workers.h"
#include "octupole/solvers/field_solution.h"

namespace octupole::internal {

/// Runs the minimisations of one solve on all ranks, by TAO's LMVM: counts their iterations against the limit, passes
/// them on to the caller, and ends on all ranks what the callback of one ends.
class TaoMinimizer {
 public:
  /// This rank's share of the cost, and its part of the gradient.
  using Function = std::function<double(const double* parameters, double* gradient)>;
  /// What is to be kept of the parameters of a minimisation at work.
  using Keep = std::function<void(const std::vector<double>& parameters)>;

  /// `options` must outlive the minimizer.
  TaoMinimizer(MPI_Comm comm, const MinimizerOptions& options)
      : comm_(comm), options_(options), workers_(options.num_threads) {}

  /// From now on `is_due` is asked on the first rank at each iteration whether Keep is to be called, on all.
  void SetKeeping(std::function<bool()> is_due) { is_due_ = std::move(is_due); }

  Workers* workers() { return &workers_; }
  ceres::TerminationType termination() const { return termination_; }
  bool IsEnded() const { return termination_ != ceres::CONVERGENCE && termination_ != ceres::NO_CONVERGENCE; }
  const std::vector<ceres::IterationSummary>& iterations() const { return iterations_; }
  std::size_t num_evaluations() const { return num_evaluations_; }
  int IterationsLeft() const { return options_.max_iterations - static_cast<int>(iterations_.size()); }

  /// Minimises from `parameters`, which become the result. Returns the energy reached, twice the cost of all ranks.
  /// \param cost_tolerance as in LbfgsOptions, as is function_tolerance.
  double Minimize(const std::string& name, const GraphLevel& level, const Function& function, double cost_tolerance,
                  double function_tolerance, std::vector<double>* parameters, const Keep& keep);

  /// Takes over what the first rank did by itself. Collective.
  void Continue(const std::vector<ceres::IterationSummary>& iterations, ceres::TerminationType termination);

  double Seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  friend struct TaoCallbacks;
  struct Run;

  MPI_Comm comm_;
  const MinimizerOptions& options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Workers workers_;
  std::function<bool()> is_due_;
  std::vector<ceres::IterationSummary> iterations_;
  ceres::TerminationType termination_ = ceres::CONVERGENCE;
  ceres::CallbackReturnType answer_ = ceres::SOLVER_CONTINUE;
  std::size_t num_evaluations_ = 0;
};

}  // namespace octupole::internal
