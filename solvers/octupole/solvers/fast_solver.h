#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "octupole/energies/field_problem.h"
#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// Where starts cost little.
inline constexpr std::size_t kMaxStartVertices = 2000;

/// The field of a graph, quickly: minimises the energy of BuildFieldProblem, with hard alignments, as one function
/// (FieldEnergy) by MinimizeLbfgs, from coarse to fine, and finishes on frames.
///
///  1. The graph is coarsened again and again (CoarsenGraph).
///  2. On the finest graph of at most `max_start_vertices` several starts are tried: the linear one, that of
///     SolveRaySokolov, random ones, one that comes from the coarsest graph, and with more than five also random ones
///     found in the other degree. The better half are compared on the next finer graph, and the lowest after polishing
///     wins.
///  3. The field is copied to the next finer graph and minimised there, until the finest. On the finest other graph of
///     at most 80,000 vertices it is compared with another linear start, and the lower of the two goes on.
///  4. It is projected to frames, which are polished: their FrameDifference<4>, summed over the edges, is minimised
///     (FrameEnergy).
///
/// The result's energy is that of its coefficients (cost_weight.h); its frames are the polished, and keep to the
/// alignments to rounding.
///
/// Any graph will do: disconnected, without any alignment, with isolated vertices. The result does not depend on the
/// number of threads.
///
/// Floats are minimised in until their rounding might matter.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), a weight is negative or not finite,
/// or num_threads or num_starts is below 1.
template <int kDegree>
FieldSolution<kDegree> SolveFast(const FieldGraph& graph, const EnergyWeights& weights,
                                 const MinimizerOptions& options = {},
                                 std::size_t max_start_vertices = kMaxStartVertices);

/// The same from a field of the caller's, one harmonic per vertex, on the finest graph only.
/// \throw std::invalid_argument also when `start` has another size or a value that is not finite.
template <int kDegree>
FieldSolution<kDegree> SolveFastFrom(const FieldGraph& graph, const EnergyWeights& weights,
                                     const std::vector<Harmonic<kDegree>>& start, const MinimizerOptions& options = {});

/// The same from frames of an earlier field, one per vertex, after a local change: they are brought to the alignments
/// and polished, step 4 alone. A fraction of the time of SolveFast, and singular curves stay where they are but near
/// the change. The coefficients are the frames' harmonics. \throw std::invalid_argument also when there is not one
/// frame per vertex, or one of them is no rotation.
template <int kDegree>
FieldSolution<kDegree> PolishField(const FieldGraph& graph, const EnergyWeights& weights,
                                   const std::vector<Eigen::Matrix3d>& frames, const MinimizerOptions& options = {});

}  // namespace octupole
