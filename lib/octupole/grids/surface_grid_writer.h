#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// Writes a grid and its field for ParaView, meshio and the like: the cells as hexahedra, the point arrays of
/// WriteField and `distance`, as SurfaceGrid::distances, and the cell array `level`.
///
/// \throw std::invalid_argument unless there is one value of each per node.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
template <int kDegree>
void WriteGridField(const std::filesystem::path& path, const SurfaceGrid& grid,
                    const std::vector<Harmonic<kDegree>>& coefficients, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
