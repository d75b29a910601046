#pragma once

#include "octupole/grids/internal/grid_input.h"
#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole::internal {

/// \throw as MakeGrid where options are out of range or memory is short.
void CheckGridSize(const TriangleMesh& surface, const GridOptions& options);

/// MakeGrid of a surface whose solid has been found, without that check.
SurfaceGrid MakeGridOfSolid(const TriangleMesh& surface, const SolidBySurface& solid, const GridOptions& options);

}  // namespace octupole::internal
