#include "octupole/mesh/tet_mesh.h"

#include <string>

#include "octupole/mesh/internal/mesh_checks.h"

namespace octupole {
namespace {

void CheckMidEdgeNodes(const TetMesh& mesh, const internal::MeshChecker& checker) {
  if (mesh.mid_edge_nodes.empty()) return;
  const std::vector<bool> is_corner = CornersOfTets(mesh);
  for (std::size_t i = 0; i < mesh.mid_edge_nodes.size(); ++i) {
    const auto& [node, a, b] = mesh.mid_edge_nodes[i];
    if (!is_corner[node] && is_corner[a] && is_corner[b]) continue;
    checker.Fail("mid-edge node " + std::to_string(i) + ": vertex " + std::to_string(node) + " between " +
                 std::to_string(a) + " and " + std::to_string(b) + " is in a tetrahedron, or one of them in none");
  }
}

}  // namespace

void CheckTetMesh(const TetMesh& mesh) {
  const internal::MeshChecker checker("CheckTetMesh", mesh.points);
  if (mesh.tets.empty()) checker.Fail("the mesh has no tetrahedra");
  if (!mesh.regions.empty() && mesh.regions.size() != mesh.tets.size()) {
    checker.Fail(std::to_string(mesh.regions.size()) + " regions for " + std::to_string(mesh.tets.size()) +
                 " tetrahedra");
  }
  checker.CheckCells("tetrahedron", mesh.tets);
  checker.CheckFeatures(mesh.feature_edges, mesh.feature_points);
  if (mesh.surface_tags.size() != mesh.surface_triangles.size()) {
    checker.Fail(std::to_string(mesh.surface_tags.size()) + " surface tags for " +
                 std::to_string(mesh.surface_triangles.size()) + " surface triangles");
  }
  checker.CheckCells("surface triangle", mesh.surface_triangles);
  checker.CheckCells("mid-edge node", mesh.mid_edge_nodes);
  CheckMidEdgeNodes(mesh, checker);
}

std::vector<bool> CornersOfTets(const TetMesh& mesh) {
  std::vector<bool> is_corner(mesh.points.size(), false);
  for (const std::array<int, 4>& tet : mesh.tets) {
    for (const int v : tet) is_corner[v] = true;
  }
  return is_corner;
}

}  // namespace octupole
