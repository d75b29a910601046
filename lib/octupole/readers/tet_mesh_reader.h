#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Reads the tetrahedra of a file, in the format that its extension names:
///
/// - `.mesh`: Medit as text. The region of a tetrahedron is its tag. Features are the Edges (of them only Ridges and
///   RequiredEdges if there are such) and Corners.
/// - `.vtk`: legacy VTK, text or binary, an unstructured grid. The regions are the first array of one integer per
///   cell. Features are the lines, polylines and vertices.
/// - `.vtu`: VTK's XML, the same. Arrays in text or binary, inline or appended, plain or compressed with zlib.
///   Pieces are put one behind the other.
/// - `.msh`: Gmsh 2.x and 4.1, text or binary. The region is the first physical tag, or the number of the volume if it
///   has none. Features are the lines and points.
/// - `.node` and `.ele`: TetGen; either is given, the other is beside it. Both count from 0 or from 1. The region is
///   the first attribute if all are integers. Features are the edges of an `.edge` file beside them that have a
///   marker other than 0.
/// - `.ovm`: OpenVolumeMesh as text, without its properties.
/// - `.tet`: lines "N vertices" and "N tets" or "N cells", the coordinates, then "4" and four indices from 0 per cell.
///
/// Points and tetrahedra keep the order of the file, and all points are kept, used or not.
/// Tetrahedra of higher order are read as their corners, lines as their ends, and of second-order tetrahedra the nodes
/// on their edges become TetMesh::mid_edge_nodes. Triangles give TetMesh::surface_triangles: Medit's with their tags,
/// VTK's with those of the array that has the regions, Gmsh's with the number of their surface (in format 2 the second
/// tag). Other cells are left out, and so are features that are not in the mesh. Edges that are all there are mark
/// nothing and are left out, too. Features are in ascending order. `warnings`, if given, receives a line for each kind
/// of what is left out.
///
/// The result satisfies CheckTetMesh().
///
/// \throw std::runtime_error "path:line: what is wrong", or "path: what is wrong" where no line is
/// to blame: the file cannot be read, is no such mesh, is cut off or damaged, has an index out of
/// range or twice in a tetrahedron, a coordinate that is not finite, or no tetrahedra.
TetMesh ReadTetMesh(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// The files that ReadTetMesh(path) reads: `path`, and those beside it that belong to the format, there or not.
std::vector<std::filesystem::path> TetMeshFiles(const std::filesystem::path& path);

}  // namespace octupole
