#pragma once

#include "octupole/field/field_graph.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// The MBO method of D. Palmer, D. Bommes and J. Solomon, *Algebraic representations for volumetric frame fields*, ACM
/// Transactions on Graphics 39 (2020), section 5: from a random field, until it is stable,
///
///  1. diffuse: q = argmin over the harmonics of degree 4 that the alignments allow of
///     |q - h|^2 + t * sum over edges weight |q_a - q_b|^2, an implicit Euler step of length t from the field h;
///  2. project: h = the harmonics of the frames nearest to q.
///
/// It is their modified method, whose steps shrink: t = 50 / (k^3 lambda) in step k, lambda being the Laplacian's first
/// eigenvalue above zero. The field is stable when a step changes its energy, or itself, by less than 1e-5. The energy
/// of the result is the sum over edges of weight FrameDifference<4>.
///
/// Ours departs in this: the Laplacian is that of the graph and masses are 1; lambda is the order of magnitude that it
/// has on a graph of n vertices that fills a box, 2.5 W / n^(2/3) with the mean W of the weights at a vertex; steps are
/// minimised by L-BFGS; the projection is ours (NearestAlignedFrame). Steps that shrink as 1 / k^2 end lower (up to 5
/// %) and take some three times as long.
///
/// Any graph will do. The result does not depend on the number of threads. Iterations are those of the diffusion; the
/// size is that of its linear system.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph) or num_threads is below 1.
FrameSolution SolveMbo(const FieldGraph& graph, const MinimizerOptions& options = {});

}  // namespace octupole
