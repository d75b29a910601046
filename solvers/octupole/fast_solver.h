#pragma once

#include <ceres/iteration_callback.h>
#include <ceres/types.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "octupole/field_graph.h"
#include "octupole/field_problem.h"
#include "octupole/harmonics.h"

namespace octupole {

struct FastSolverOptions {
  /// Seed of the random starts.
  std::uint32_t seed = 0;
  /// Of all minimisations together.
  int max_iterations = 5000;
  int num_threads = 1;
  /// Called after every iteration; of the summary, `iteration`, `cost`, `cost_change`, `gradient_max_norm`, `step_size`
  /// and `cumulative_time_in_seconds` are set. The cost is that of the minimisation at work, often one on a coarser
  /// graph.
  ceres::IterationCallback* callback = nullptr;
};

template <int kDegree>
struct FastField {
  /// One harmonic per vertex: a minimum of the field energy.
  std::vector<Harmonic<kDegree>> coefficients;
  /// One frame per vertex: the nearest to `coefficients`, then polished. They keep to the alignments to rounding.
  std::vector<Eigen::Matrix3d> frames;
  /// The energy of `coefficients` (cost_weight.h).
  double energy = 0;
  /// NO_CONVERGENCE: max_iterations were spent. USER_SUCCESS or USER_FAILURE: the callback ended it. Both leave a
  /// complete field, as far as it came. FAILURE: the energy is not finite, its weights being too large.
  ceres::TerminationType termination = ceres::NO_CONVERGENCE;
  /// As the callback gets them.
  std::vector<ceres::IterationSummary> iterations;
  /// Of the energy on the finest graph.
  int num_unknowns = 0;
};

/// The field of a graph, quickly: minimises the energy of BuildFieldProblem, with hard alignments, as one function
/// (FieldEnergy) by MinimizeLbfgs, from coarse to fine, and finishes on frames.
///
///  1. The graph is coarsened again and again (CoarsenGraph).
///  2. On one of the coarse graphs several starts are tried: random ones, one that comes from the coarsest graph, and
///     the linear one: least squares in degree 4, without penalties, then the nearest frames (Ray and Sokolov, On
///     smooth frame field design, 2015). The lowest after polishing wins.
///  3. The field is copied to the next finer graph and minimised there, until the finest.
///  4. It is projected to frames, which are polished: their FrameDifference<4>, summed over the edges, is minimised
///     (FrameEnergy).
///
/// Any graph will do: disconnected, without any alignment, with isolated vertices. The result does not depend on the
/// number of threads.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), a weight is negative or not finite,
/// or
///     num_threads is below 1.
template <int kDegree>
FastField<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights,
                             const FastSolverOptions& options = {});

/// The same from a field of the caller's, one harmonic per vertex, on the finest graph only.
/// \throw std::invalid_argument also when `start` has another size or a value that is not finite.
template <int kDegree>
FastField<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                 const std::vector<Harmonic<kDegree>>& start, const FastSolverOptions& options = {});

}  // namespace octupole
