#pragma once

#include <ceres/iteration_callback.h>
#include <ceres/types.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// One minimisation of the several that a method of ours makes, as it ended.
struct StepSummary {
  /// "random start 2", "level", "field", "frames" and so on; or, with nothing else set, which start was chosen.
  std::string name;
  std::size_t num_vertices = 0;
  int num_iterations = 0;
  double energy = 0;
  /// Since the method began.
  double cumulative_time_in_seconds = 0;
};

/// What all methods of ours take, those that minimise without Ceres' solvers.
struct MinimizerOptions {
  /// Seed of the random starts.
  std::uint32_t seed = 0;
  /// Of SolveFast: how many starts it tries at most, in rounds of five until two agree on the lowest energy. More find
  /// lower energies, in time that grows with them. From some 14,000 vertices on it tries one round: there the lowest of
  /// more on a coarse graph has proved no lower on the mesh.
  int num_starts = 15;
  /// Of all minimisations together; by default each ends when it has converged.
  int max_iterations = std::numeric_limits<int>::max();
  int num_threads = 1;
  /// Called after every iteration; of the summary, `iteration`, `cost`, `cost_change`, `gradient_max_norm`, `step_size`
  /// and `cumulative_time_in_seconds` are set. The cost is that of the minimisation at work, often one on a coarser
  /// graph or one step of several.
  ceres::IterationCallback* callback = nullptr;
  /// Called after every minimisation.
  std::function<void(const StepSummary&)> step_callback;
};

/// What all methods give: frames, and how they were found.
struct FrameSolution {
  /// NO_CONVERGENCE: max_iterations were spent. USER_SUCCESS or USER_FAILURE: the callback ended it. Both leave a
  /// complete field, as far as it came. FAILURE: the energy is not finite, its weights being too large.
  ceres::TerminationType termination = ceres::NO_CONVERGENCE;
  /// One frame per vertex; the columns are the axes.
  std::vector<Eigen::Matrix3d> frames;
  /// What the method minimises, at the end; each method says what that is. To compare methods, see MeasureField.
  double energy = 0;
  /// As the callback gets them.
  std::vector<ceres::IterationSummary> iterations;
  /// Of the largest system: the field energy on the finest graph, or what the method says.
  ProblemSize size;

  bool IsUsable() const { return termination != ceres::FAILURE && termination != ceres::USER_FAILURE; }
};

/// The same from a method whose unknowns are harmonics.
template <int kDegree>
struct FieldSolution : FrameSolution {
  /// One harmonic per vertex.
  std::vector<Harmonic<kDegree>> coefficients;
};

}  // namespace octupole
