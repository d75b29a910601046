#pragma once

#include <ceres/solver.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "octupole/boundary_alignment.h"
#include "octupole/fast_solver.h"
#include "octupole/field_problem.h"
#include "octupole/harmonics.h"
#include "octupole/tet_mesh.h"

namespace octupole {

template <int kDegree>
struct FieldOptions {
  EnergyWeights weights;
  /// See AlignToBoundary.
  double feature_angle_deg = 40;
  /// Seed of the random starts, which are used when `start` is empty.
  std::uint32_t seed = 0;
  /// Starting values, one per point.
  std::vector<Harmonic<kDegree>> start;
  /// How SolveFast minimises; its seed is that above.
  FastSolverOptions fast;
  /// If given, Ceres minimises instead, on residual blocks; see MakeSolverOptions. Its iteration callbacks go in here.
  std::optional<ceres::Solver::Options> solver;
};

template <int kDegree>
struct Field {
  /// As Ceres left it; `summary.IsSolutionUsable()` tells whether the field is one. From SolveFast: the termination and
  /// its message, iterations with their costs, the final cost, the number of unknowns and the time.
  ceres::Solver::Summary summary;
  /// One harmonic per point.
  std::vector<Harmonic<kDegree>> coefficients;
  /// One frame per point, the nearest to its harmonic, from SolveFast also polished; the columns are the axes.
  std::vector<Eigen::Matrix3d> frames;
  BoundaryAlignment alignment;
  /// The energy of `coefficients` (cost_weight.h): twice the final cost. For energies of the frames see MeasureField.
  double energy = 0;
  /// Wall-clock seconds before the solver was called and after it returned; in between, see `summary`. SolveFast makes
  /// the frames itself.
  double setup_seconds = 0;
  double project_seconds = 0;
};

/// A boundary-aligned frame field on a tet mesh: AlignToBoundary, MakeFieldGraph and SolveFast in a row, or with Ceres
/// RandomField, BuildFieldProblem, ceres::Solve and NearestFrame. Compose them yourself for anything else.
/// The same seed gives the same field on the same machine, with Ceres on one thread.
///
/// \throw std::invalid_argument when the mesh cannot carry a field (see CheckTetMesh) or an option is out of range.
template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options = {});

}  // namespace octupole
