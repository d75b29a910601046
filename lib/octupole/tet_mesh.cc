#include "octupole/tet_mesh.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace octupole {
namespace {

[[noreturn]] void Fail(const std::string& message) { throw std::invalid_argument("CheckTetMesh: " + message); }

}  // namespace

void CheckTetMesh(const TetMesh& mesh) {
  if (mesh.tets.empty()) {
    Fail("the mesh has no tetrahedra");
  }
  if (!mesh.regions.empty() && mesh.regions.size() != mesh.tets.size()) {
    Fail(std::to_string(mesh.regions.size()) + " regions for " + std::to_string(mesh.tets.size()) + " tetrahedra");
  }
  const int num_points = static_cast<int>(mesh.points.size());
  for (int v = 0; v < num_points; ++v) {
    for (const double x : mesh.points[v]) {
      if (!std::isfinite(x)) {
        Fail("point " + std::to_string(v) + " has the coordinate " + std::to_string(x));
      }
    }
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::array<int, 4>& tet = mesh.tets[t];
    for (int i = 0; i < 4; ++i) {
      if (tet[i] < 0 || tet[i] >= num_points) {
        Fail("tetrahedron " + std::to_string(t) + " has the vertex index " + std::to_string(tet[i]) +
             ", out of range 0.." + std::to_string(num_points - 1));
      }
      for (int j = 0; j < i; ++j) {
        if (tet[i] == tet[j]) {
          Fail("tetrahedron " + std::to_string(t) + " has vertex " + std::to_string(tet[i]) + " twice");
        }
      }
    }
  }
}

}  // namespace octupole
