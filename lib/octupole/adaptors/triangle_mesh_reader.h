#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// Whether the name has an ending that ReadTriangleMesh knows, in upper or lower case.
bool IsSurfaceFile(const std::filesystem::path& path);

/// Reads the surface in an .obj, .off, .stl or .ply file with OpenMesh. Polygons are cut into fans (see FanOfPolygon),
/// the corners of an STL file are merged where they coincide, and coordinates have the precision of floats but in OBJ
/// files. Faces stay as they are also where they are no manifold, which a mesh of OpenMesh could not hold. Of OBJ files
/// only vertices and faces are read.
/// \param warnings if given, receives a line about each thing that is odd.
/// \param faces if given, receives for each triangle the number of its face in the file, from 0 and in ascending order.
/// \throw std::runtime_error "path:line: what is wrong", or "path: what is wrong" where OpenMesh tells no line: another
/// format, a file that is cut off or damaged, coordinates that are not finite, indices out of range, no faces.
TriangleMesh ReadTriangleMesh(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr,
                              std::vector<int>* faces = nullptr);

}  // namespace octupole
