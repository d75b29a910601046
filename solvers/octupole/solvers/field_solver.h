#pragma once

#include <ceres/solver.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/alignment/constraints.h"
#include "octupole/energies/field_problem.h"
#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/solvers/field_solution.h"

namespace octupole {

/// How a field is found. All but the first are the classics of degree 4, to compare with; their headers cite them.
enum class FieldMethod {
  /// The penalised energy of BuildFieldProblem, by SolveFast or by Ceres: of octupoles in degree 3; in degree 4 it is
  /// the counterpart with the implicit equations of octahedral harmonics as penalty (Yu. Nesterenko, *On spherical
  /// harmonics possessing octahedral symmetry*, arXiv 2012.12614, 2020).
  kPenalty,
  /// ray_sokolov.h
  kRaySokolov,
  /// huang.h
  kHuang,
  /// mbo.h
  kMbo,
};

template <int kDegree>
struct FieldOptions {
  FieldMethod method = FieldMethod::kPenalty;
  /// See AlignToSurface; of a tet mesh no boundary is open. Of a mesh only.
  double feature_angle_deg = 40;
  OpenBoundary open_boundary = OpenBoundary::kAligned;
  /// Of a tet mesh, whether its regions and inner surfaces align the field; see FindInterfaces.
  RegionUse regions = RegionUse::kAutomatic;
  /// See MakeFieldGraph. Of a mesh only.
  EdgeWeights edge_weights = EdgeWeights::kUniform;
  /// What the caller prescribes, on top of the boundary (see ApplyConstraints). Every method keeps to it exactly,
  /// kHuang, too.
  std::vector<Constraint> constraints;
  /// Seed of the random starts, which are used when no start is given.
  std::uint32_t seed = 0;
  /// How our own methods minimise; the seed is that above.
  MinimizerOptions minimizer;

  // The penalty method only.
  /// On a mesh they are against edges of mean weight 1, whatever the edge_weights.
  EnergyWeights weights;
  /// Starting values, one per point.
  std::vector<Harmonic<kDegree>> start;
  /// Or frames of an earlier field, one per point (see TransferFrames), after a local change: they are only polished
  /// (PolishField); Ceres starts from their harmonics.
  std::vector<Eigen::Matrix3d> start_frames;
  /// If given, Ceres minimises instead of SolveFast, on residual blocks; see MakeSolverOptions. Its iteration callbacks
  /// go in here.
  std::optional<ceres::Solver::Options> solver;
  /// With Ceres only: if given, the constraints are soft, an AlignmentCost of this weight each, and the alignments are
  /// as the boundary left them.
  std::optional<double> constraint_weight;
};

/// The solution with one harmonic and one frame per point. The penalty method minimises over harmonics: frames are the
/// nearest to them, from SolveFast also polished. The classics minimise over frames: harmonics are those of the frames.
template <int kDegree>
struct Field : FieldSolution<kDegree> {
  /// Its alignments are those that the field keeps to, with the constraints; its counts are the boundary's.
  BoundaryAlignment alignment;
  ConstraintSummary constraints;
  /// Wall-clock seconds before the minimisation, of it and after it. Our own methods make the frames as they minimise.
  double setup_seconds = 0;
  double solve_seconds = 0;
  double project_seconds = 0;
  /// As Ceres left it, if Ceres was asked.
  std::optional<ceres::Solver::Summary> ceres_summary;
};

/// A boundary-aligned frame field on a tet mesh: AlignToBoundary, MakeFieldGraph and the method in a row, with Ceres
/// RandomField, BuildFieldProblem, ceres::Solve and NearestFrame. Compose them yourself for anything else.
/// The same seed gives the same field on the same machine, with Ceres on one thread.
///
/// The mid-edge nodes of second-order tetrahedra are no unknowns: they get the mean of their edges' ends
/// (SetMidEdgeFrames); where a constraint says otherwise, the nearest frame that keeps to it. Other points of no
/// tetrahedron get any frame that their alignment allows.
///
/// \throw std::invalid_argument when the mesh cannot carry a field (see CheckTetMesh), an option is out of range, a
/// constraint is wrong (see ApplyConstraints), a start has another size, both are given, a start or solver is given to
/// a method that takes none, or a constraint_weight without solver.
template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options = {});

/// The same on a surface, by AlignToSurface: frames with the surface's normal as one axis, so a cross field (see
/// CrossField). The smoothness of frames in space is extrinsic: the field bends with the surface.
/// \throw std::invalid_argument likewise (see CheckTriangleMesh).
template <int kDegree>
Field<kDegree> SolveField(const TriangleMesh& surface, const FieldOptions<kDegree>& options = {});

/// The same on any graph: of a mesh type of the caller's own, with the caller's edges, weights and alignments. Whatever
/// asks for a mesh is left alone: of the field's alignment the counts are zero.
/// \throw std::invalid_argument likewise (see CheckFieldGraph).
template <int kDegree>
Field<kDegree> SolveField(const FieldGraph& graph, const FieldOptions<kDegree>& options = {});

}  // namespace octupole
