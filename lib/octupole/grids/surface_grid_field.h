#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// Finds a field on a grid.
/// \param start frames to begin with, one rotation per node, from a coarser grid; empty for the first.
/// \return one rotation per node, its columns the axes.
using GridSolver =
    std::function<std::vector<Eigen::Matrix3d>(const SurfaceGrid& grid, std::vector<Eigen::Matrix3d> start)>;

/// A grid as MakeGrid makes it, and a field on it from coarse to fine. `solve` is called for grids of cells 2^k, ...,
/// 4, 2 times as large and then for the one wanted, which is returned; each begins with the field of the one before.
/// The first, of cells of one size and at most 500,000 nodes or so, finds the field, such as by SolveFast; on the
/// others little is left to do, such as by PolishField, so that details which the first does not resolve have what
/// field it had there. Coarser grids have as many levels less. Where there are several, cells along the singular curves
/// of the grid before are the finest, too.
///
/// \throw std::invalid_argument when `solve` gives other than one frame per node; and all that MakeGrid throws.
SurfaceGrid SolveOnGrids(const TriangleMesh& surface, const GridOptions& options, const GridSolver& solve,
                         std::vector<std::string>* warnings = nullptr);

}  // namespace octupole
