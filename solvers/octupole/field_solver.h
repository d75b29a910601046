#pragma once

#include <ceres/solver.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "octupole/boundary_alignment.h"
#include "octupole/field_problem.h"
#include "octupole/harmonics.h"
#include "octupole/tet_mesh.h"

namespace octupole {

template <int kDegree>
struct FieldOptions {
  EnergyWeights weights;
  /// See AlignToBoundary.
  double feature_angle_deg = 40;
  /// Seed of the random start, which is used when `start` is empty.
  std::uint32_t seed = 0;
  /// Starting values, one per point.
  std::vector<Harmonic<kDegree>> start;
  /// How to minimise; without it, the preset that suits the mesh's size. Iteration callbacks go in here.
  std::optional<ceres::Solver::Options> solver;
};

template <int kDegree>
struct Field {
  /// As Ceres left it; `summary.IsSolutionUsable()` tells whether the field is one.
  ceres::Solver::Summary summary;
  /// One harmonic per point.
  std::vector<Harmonic<kDegree>> coefficients;
  /// One frame per point, the nearest to its harmonic; the columns are the axes.
  std::vector<Eigen::Matrix3d> frames;
  BoundaryAlignment alignment;
  /// The energy of `coefficients` (cost_weight.h): twice the final cost. For energies of the frames see MeasureField.
  double energy = 0;
  /// Wall-clock seconds before Ceres was called and after it returned; in between, see `summary`.
  double setup_seconds = 0;
  double project_seconds = 0;
};

/// A boundary-aligned frame field on a tet mesh: AlignToBoundary, MakeFieldGraph, RandomField, BuildFieldProblem,
/// ceres::Solve and NearestFrame in a row. Compose them yourself for anything else.
/// The same seed gives the same field on the same machine with one thread.
///
/// \throw std::invalid_argument when the mesh cannot carry a field (see CheckTetMesh) or an option is out of range.
template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options = {});

}  // namespace octupole
