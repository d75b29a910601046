#include "octupole/tet_mesh.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace octupole {
namespace {

[[noreturn]] void Fail(const std::string& message) { throw std::invalid_argument("CheckTetMesh: " + message); }

void CheckIndex(const char* kind, std::size_t number, int index, int num_points) {
  if (index < 0 || index >= num_points) {
    Fail(kind + (" " + std::to_string(number)) + " has the vertex index " + std::to_string(index) +
         ", out of range 0.." + std::to_string(num_points - 1));
  }
}

// That the vertices of each cell are in range and different.
template <std::size_t kSize>
void CheckCells(const char* kind, const std::vector<std::array<int, kSize>>& cells, int num_points) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::array<int, kSize>& cell = cells[c];
    for (std::size_t i = 0; i < kSize; ++i) {
      CheckIndex(kind, c, cell[i], num_points);
      for (std::size_t j = 0; j < i; ++j) {
        if (cell[i] == cell[j]) {
          Fail(kind + (" " + std::to_string(c)) + " has vertex " + std::to_string(cell[i]) + " twice");
        }
      }
    }
  }
}

}  // namespace

void CheckTetMesh(const TetMesh& mesh) {
  if (mesh.tets.empty()) Fail("the mesh has no tetrahedra");
  if (!mesh.regions.empty() && mesh.regions.size() != mesh.tets.size()) {
    Fail(std::to_string(mesh.regions.size()) + " regions for " + std::to_string(mesh.tets.size()) + " tetrahedra");
  }
  const int num_points = static_cast<int>(mesh.points.size());
  for (int v = 0; v < num_points; ++v) {
    for (const double x : mesh.points[v]) {
      if (!std::isfinite(x)) Fail("point " + std::to_string(v) + " has the coordinate " + std::to_string(x));
    }
  }
  CheckCells("tetrahedron", mesh.tets, num_points);
  CheckCells("feature edge", mesh.feature_edges, num_points);
  for (std::size_t i = 0; i < mesh.feature_points.size(); ++i) {
    CheckIndex("feature point", i, mesh.feature_points[i], num_points);
  }
}

}  // namespace octupole
