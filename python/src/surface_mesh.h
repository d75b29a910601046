#pragma once

#include <vector>

#include "octupole/mesh/triangle_mesh.h"

namespace octupole::python {

/// What Python calls a TriangleMesh: with the face of each triangle, of those in the file.
struct SurfaceMesh : TriangleMesh {
  std::vector<int> faces;
};

}  // namespace octupole::python
