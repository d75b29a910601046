#include "octupole/mesh/tet_mesh.h"

#include <string>

#include "octupole/mesh/internal/mesh_checks.h"

namespace octupole {

void CheckTetMesh(const TetMesh& mesh) {
  const internal::MeshChecker checker("CheckTetMesh", mesh.points);
  if (mesh.tets.empty()) checker.Fail("the mesh has no tetrahedra");
  if (!mesh.regions.empty() && mesh.regions.size() != mesh.tets.size()) {
    checker.Fail(std::to_string(mesh.regions.size()) + " regions for " + std::to_string(mesh.tets.size()) +
                 " tetrahedra");
  }
  checker.CheckCells("tetrahedron", mesh.tets);
  checker.CheckFeatures(mesh.feature_edges, mesh.feature_points);
}

}  // namespace octupole
