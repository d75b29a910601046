#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// What can be said of a field on a grid.
struct GridQuality {
  /// Sums over the edges of weight times FrameDifference<3> and FrameDifference<4>.
  double energy3 = 0;
  double energy4 = 0;
  /// The angle in degrees between the surface's own normal and the nearest axis, at points of the surface less than a
  /// cell apart, wherever a normal is all that the surface asks of the nodes around.
  double boundary_rms_deg = 0;
  double boundary_max_deg = 0;
  std::size_t boundary_samples = 0;
};

/// Between nodes, the field is that frame whose hexadecapole is nearest to those of the nodes, interpolated.
/// \param surface that the grid was made of.
/// \param frames one rotation per node, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per node and each is a rotation.
GridQuality MeasureGridField(const TriangleMesh& surface, const SurfaceGrid& grid,
                             const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
