#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/grids/surface_grid.h"

namespace octupole {

/// Writes a grid and its field as an OpenVDB file, for Houdini, Blender and the like. The nodes are the active voxels,
/// in a transform that takes them to their points, of the grids
///  - `distance`, single precision, as SurfaceGrid::distances,
///  - `frame_x`, `frame_y`, `frame_z`: the three axes, vectors of single precision.
/// Nodes of coarse cells are sparse: voxels between them are inactive.
///
/// \throw std::invalid_argument unless there is one frame per node.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
void WriteGridVdb(const std::filesystem::path& path, const SurfaceGrid& grid,
                  const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
