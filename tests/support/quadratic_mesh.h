#pragma once

#include <algorithm>
#include <array>
#include <map>

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The same mesh of second-order tetrahedra: each edge has a node in its middle, behind the points of the mesh.
inline TetMesh MakeQuadratic(const TetMesh& linear) {
  TetMesh mesh = linear;
  std::map<std::array<int, 2>, int> node_of;
  for (std::array<int, 4> tet : mesh.tets) {
    std::sort(tet.begin(), tet.end());
    for (const auto& [i, j] : internal::kTetEdges) {
      if (!node_of.emplace(std::array{tet[i], tet[j]}, static_cast<int>(mesh.points.size())).second) continue;
      mesh.mid_edge_nodes.push_back({static_cast<int>(mesh.points.size()), tet[i], tet[j]});
      mesh.points.push_back((mesh.points[tet[i]] + mesh.points[tet[j]]) / 2);
    }
  }
  return mesh;
}

}  // namespace octupole
