#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// A surface as it is in a file.
struct SurfaceFile {
  /// Polygons are cut into fans.
  TriangleMesh mesh;
  /// Of each triangle, its face in the file.
  std::vector<int> faces;
  std::size_t num_faces = 0;
};

/// Reads .obj, .off, .stl or .ply with OpenMesh. The corners of an STL file are merged where they coincide. Faces stay
/// as they are also where they are no manifold, which a mesh of OpenMesh could not hold.
/// \param warnings receives a line about each thing that is odd.
/// \throw std::runtime_error "path: what is wrong": another format, a file that OpenMesh cannot read, coordinates that
/// are not finite, indices out of range, no faces.
SurfaceFile ReadSurface(const std::filesystem::path& path, std::vector<std::string>* warnings);

}  // namespace octupole
