#pragma once

#include <array>
#include <string>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole::internal {

/// What a surface bounds: shells that are added to the solid or taken away from it, one after the other.
struct SolidBySurface {
  struct Part {
    bool is_cavity;
    std::vector<std::array<int, 3>> triangles;
  };
  /// Those of the surface, and the middles of its holes.
  std::vector<Eigen::Vector3d> points;
  /// The first is no cavity.
  std::vector<Part> parts;
};

/// Finds out what solid a surface bounds, see MakeGrid.
/// \param warnings receives a line about each thing that is odd.
/// \throw std::invalid_argument when the surface is open and is not to be closed.
SolidBySurface FindSolid(const TriangleMesh& surface, HoleRepair repair, std::vector<std::string>* warnings);

/// The memory that programs can still have, in bytes; 0 where the system does not tell.
double AvailableMemory();

}  // namespace octupole::internal
