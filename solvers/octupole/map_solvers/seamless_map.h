#pragma once

#include <ceres/iteration_callback.h>
#include <ceres/types.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "octupole/maps/map_domain.h"
#include "octupole/maps/map_quality.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

struct MapOptions {
  /// H: the length that one unit of a parameter stands for, so that of the hexahedra's edges. By default, where it is
  /// 0, twice the mean length of the mesh's edges.
  double size = 0;
  /// Which feature edges and interfaces hold parameters constant (MakeMapDomain).
  BoundaryOptions boundary;
  /// An integer-grid map: sheets, singular edges and shifts of the cut are rounded to integers, the surest first.
  bool integer = false;
  /// Of Newton's method against foldovers, each time that there are some: after the fit, after the mesh was refined
  /// where no step helped, and for an integer-grid map after each batch that was rounded.
  int max_iterations = 200;
  int num_threads = 1;
  /// An earlier map of the same mesh to begin with, whatever H it has and however its axes are named: the least squares
  /// fit is of its gradients instead of the frames. Where singular edges or sheets have changed it is of less use.
  std::optional<MeshMap> start;
  /// Called after every iteration; of the summary, `iteration`, `cost`, `cost_change`, `gradient_max_norm` and
  /// `cumulative_time_in_seconds` are set. The cost is that of the least squares, counted anew in each fit, or the
  /// foldover-free energy.
  ceres::IterationCallback* callback = nullptr;
};

struct SeamlessMap {
  MapDomain domain;
  double size = 0;
  /// Of the tetrahedra of domain.mesh.
  CornerParameters parameters;
  /// CONVERGENCE: no tetrahedron is turned over but those that are flat in every map. NO_CONVERGENCE: some are, and
  /// either max_iterations were spent or no step would help. USER_SUCCESS, USER_FAILURE: the callback ended it.
  ceres::TerminationType termination = ceres::NO_CONVERGENCE;
  /// Tetrahedra that the map turns over or flattens, before and after Newton's method, in ascending order.
  std::vector<int> flipped_before;
  std::vector<int> flipped;
  int num_iterations = 0;
  /// Unknowns that were rounded, of an integer-grid map.
  int num_rounded = 0;
  /// A valid integer-grid map: all is whole, nothing turned over, and the boundary held everywhere.
  bool is_integer_grid = false;
  double setup_seconds = 0;
  double linear_seconds = 0;
  double foldover_seconds = 0;
};

/// A seamless map from a frame field: parameters u whose gradients follow the frames, grad u_k ~ (axis k) / H, that go
/// on across every inner face up to a rotation of the cube and a shift, and of which one is constant on every face of
/// the boundary (docs/maps.md).
///
///  1. MakeMapDomain: the constraints become linear combinations of free unknowns, so that they hold to rounding.
///  2. Least squares: the sum over tetrahedra of volume |H grad u - F^T|^2, by conjugate gradients.
///  3. Newton's method on the foldover-free energy (foldover_energy.h), from there, until no tetrahedron is turned
///     over; each step by conjugate gradients, no matrix is assembled.
///
/// \param frames one rotation per point.
/// \throw std::invalid_argument as MakeMapDomain does; when an option is out of range or the start of another mesh.
SeamlessMap SolveSeamlessMap(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                             const MapOptions& options = {});

}  // namespace octupole
