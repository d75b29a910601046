#pragma once

#include "octupole/field/field_graph.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// The pipeline of N. Ray, D. Sokolov and B. Lévy, *Practical 3D frame field generation*, ACM Transactions on Graphics
/// 35 (2016), first in N. Ray and D. Sokolov, *On smooth frame field design*, arXiv 1507.03351 (2015):
///
///  1. a linear start: the harmonics of degree 4 that minimise the sum over edges of weight |h_a - h_b|^2 under the
///     alignments alone, with no penalty to keep them octahedral;
///  2. projection: the nearest frame at each vertex;
///  3. descent on the frames: the same sum, from their unit harmonics (FrameEnergy). It is the energy of the result.
///
/// Ours departs in this: alignments hold exactly in all three steps (an affine subspace, then one angle about an axis)
/// instead of by large weights; the projection is global instead of a descent from a guess; rotations are Cayley's
/// instead of Euler's angles; smoothing L-BFGS is ours. The size is that of the linear system.
///
/// Any graph will do. Without any alignment the linear start is constant, the mean of a random field; with alignments
/// the seed only starts the least squares, and shows as far as these are not solved to the last digit. The result does
/// not depend on the number of threads.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph) or num_threads is below 1.
FrameSolution SolveRaySokolov(const FieldGraph& graph, const MinimizerOptions& options = {});

}  // namespace octupole
