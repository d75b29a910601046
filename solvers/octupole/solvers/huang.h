#pragma once

#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// The method of J. Huang, Y. Tong, H. Wei and H. Bao, *Boundary aligned smooth 3D cross-frame field*, ACM Transactions
/// on Graphics 30 (2011): descent on rotations, three unknowns per vertex, of
///
///   sum over edges  weight |h_a - h_b|^2  +  sum over aligned vertices  kHuangBoundaryWeight * distance^2,
///
/// with the unit harmonics h of degree 4 and the squared distance of h from those that the alignment allows
/// (FrameEnergy with soft alignments), from one and the same frame everywhere. It is the energy of the result.
///
/// Ours departs in this: that frame is random instead of the coordinate axes, with which many a part is aligned;
/// rotations are Cayley's instead of Euler's angles, so that no start is singular; the soft term measures the distance
/// to the whole aligned subspace, which on frames vanishes where theirs does, with the component of Y_{4,0} along the
/// normal; and edges of a graph stand for faces between tets. L-BFGS is ours.
///
/// Any graph will do. The result does not depend on the number of threads. Boundary errors of about a tenth of a degree
/// remain, the price of soft alignment. The size is that of three unknowns at every vertex.
///
/// \param hard_vertices those whose alignment holds exactly, as what a caller prescribes must.
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), num_threads is below 1, or a hard
/// vertex is out of range.
FrameSolution SolveHuang(const FieldGraph& graph, const MinimizerOptions& options = {},
                         const std::vector<int>& hard_vertices = {});

/// Against edges of mean weight 1. Ten times less leaves ten times the boundary error; ten times more doubles the time.
inline constexpr double kHuangBoundaryWeight = 100;

}  // namespace octupole
