#pragma once

#include <ceres/first_order_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/types.h>

#include <vector>

#include "octupole/minimization/workers.h"

namespace octupole {

struct LbfgsOptions {
  int max_iterations = 2000;
  /// Converged when the last five iterations lowered the cost by less than this part of it, each on average.
  double function_tolerance = 1e-7;
  /// Converged when the cost is below this: for costs whose minimum may be zero, but for rounding.
  double cost_tolerance = 0;
  /// Converged when no entry of the gradient is above this.
  double gradient_tolerance = 1e-8;
  /// The largest change of an unknown in the first step, when nothing is known of the curvature.
  double first_step = 0.1;
  /// Called after each iteration; of the summary only `iteration`, `cost`, `cost_change`, `gradient_max_norm` and
  /// `step_size` are set.
  ceres::IterationCallback* callback = nullptr;
};

struct LbfgsSummary {
  /// CONVERGENCE: one of the tolerances is met, or rounding hides any further decrease. NO_CONVERGENCE: max_iterations
  /// are spent. USER_SUCCESS and USER_FAILURE: the callback ended it. FAILURE: the function is not finite or cannot
  /// be evaluated at the start.
  ceres::TerminationType termination = ceres::FAILURE;
  double initial_cost = 0;
  double final_cost = 0;
  int num_iterations = 0;
  int num_evaluations = 0;
};

/// Minimises a smooth function by limited-memory BFGS (Nocedal, 1980; five pairs) from `x`, which becomes the result:
/// the best point seen, however it ended.
///
/// Nearly always one evaluation per iteration: the full step is tried first and taken when it lowers the cost enough
/// (Armijo), else it is cut back. The direction comes from inner products that are updated, not recomputed (Chen, Wang
/// and Zhou, Large-scale L-BFGS using MapReduce, 2014), so that an iteration passes through the history only twice; the
/// history is kept in single precision. Memory is allocated once.
LbfgsSummary MinimizeLbfgs(const ceres::FirstOrderFunction& function, const LbfgsOptions& options, Workers* workers,
                           std::vector<double>* x);

}  // namespace octupole
