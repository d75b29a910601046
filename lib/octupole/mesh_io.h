#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octupole/tet_mesh.h"

namespace octupole {

/// Reads the tetrahedra of a text file, in the format that its extension names:
///
/// - `.mesh`: Medit. The region of a tetrahedron is its tag.
/// - `.vtk`: legacy VTK, an unstructured grid. The regions are the first scalar array of integers
///   among the cell data.
/// - `.msh`: Gmsh 2.x and 4.1. The region is the first physical tag, or in 4.1 the number of the
///   volume if it has none.
///
/// Points and tetrahedra keep the order of the file, and all points are kept, used or not.
/// Tetrahedra of second order (in Gmsh also third) are read as their corners; other cells are left
/// out. `warnings`, if given, receives a line for each of these.
///
/// The result satisfies CheckTetMesh().
///
/// \throw std::runtime_error "path:line: what is wrong", or "path: what is wrong" where no line is
/// to blame: the file cannot be read, is no such mesh, is cut off or damaged, has an index out of
/// range or twice in a tetrahedron, a coordinate that is not finite, or no tetrahedra.
TetMesh ReadTetMesh(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

}  // namespace octupole
