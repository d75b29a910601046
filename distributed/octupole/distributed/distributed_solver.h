#pragma once

#include <mpi.h>
#include <petscdm.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/alignment/interfaces.h"
#include "octupole/distributed/mesh_part.h"
#include "octupole/energies/field_problem.h"
#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// What SolveDistributed has of the finest graph while it works or when it ends: enough to go on from, on any number of
/// ranks.
template <int kDegree>
struct DistributedState {
  /// The level at work, 0 the finest. A coarser one's field is that of all its vertices' fine ones.
  int level = 0;
  /// One per owned point.
  std::vector<Harmonic<kDegree>> coefficients;
  /// The same when the level is done and frames are polished; else empty.
  std::vector<Eigen::Matrix3d> frames;
};

template <int kDegree>
struct DistributedOptions {
  /// As in FieldOptions.
  double feature_angle_deg = 40;
  RegionUse regions = RegionUse::kAutomatic;
  EdgeWeights edge_weights = EdgeWeights::kUniform;
  EnergyWeights weights;
  /// The callbacks are called on every rank; what one's answers ends all ranks' work. Threads are each rank's.
  MinimizerOptions minimizer;
  /// The first coarse graph with at most so many vertices is gathered and solved by the first rank, by SolveFast.
  std::size_t max_gathered_vertices = 20000;
  /// If given, `keep` is called on all ranks when `is_keep_due` says so on the first, which is asked at every
  /// iteration.
  std::function<bool()> is_keep_due;
  std::function<void(const DistributedState<kDegree>& state)> keep;
  /// If given, what was kept of an earlier run that did not end; it goes on from there.
  const DistributedState<kDegree>* start = nullptr;
};

/// What a rank sends for one evaluation on the finest graph, in the halo exchange; besides, there is one reduction.
struct HaloTraffic {
  std::size_t messages = 0;
  std::size_t vertices = 0;
  std::size_t bytes = 0;
};

/// The solution with one harmonic, frame and alignment per point of the part, ghosts too. Energy, iterations and
/// unknowns are of the whole mesh; non-zeros are not counted.
template <int kDegree>
struct DistributedField : FieldSolution<kDegree> {
  std::vector<Alignment> alignments;
  HaloTraffic traffic;
  std::size_t num_evaluations = 0;
};

/// A boundary-aligned frame field on a mesh that is dealt out to the ranks of a communicator: what SolveField does by
/// the penalty method, by PETSc's TAO. Collective.
///
///  1. Each rank aligns its vertices (AlignToBoundary). Whether faces inside the mesh are interfaces, and whether
///     features are marked, is settled for the whole mesh.
///  2. Each rank coarsens its part of the graph (CoarsenGraph) until all ranks' together have at most
///     max_gathered_vertices; the first rank solves that by SolveFast.
///  3. From level to level the field is copied to the finer graph and minimised there (FieldEnergy) by LMVM, the
///     limited-memory quasi-Newton method of TAO. An evaluation takes one exchange of the values at ghosts, while the
///     vertices inside are swept, and one reduction. Options of PETSc count, as -tao_monitor does.
///  4. Frames are polished likewise (FrameEnergy).
///
/// The result depends on the number of ranks as on a seed. PETSc must have been initialised.
///
/// \throw DistributedError when an option is out of range, or a rank fails.
template <int kDegree>
DistributedField<kDegree> SolveDistributed(MPI_Comm comm, const MeshPart& part,
                                           const DistributedOptions<kDegree>& options = {});

/// The same for users of PETSc, on a DMPlex of tetrahedra (see MeshPartOfPlex): the result has one value of each per
/// vertex of `dm` that this rank has, from the first of DMPlexGetDepthStratum(0) on.
template <int kDegree>
DistributedField<kDegree> SolveDistributed(DM dm, const DistributedOptions<kDegree>& options = {});

}  // namespace octupole
