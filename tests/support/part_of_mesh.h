#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The tetrahedra of a mesh whose middle is kept, and the points that they use.
template <typename IsKept>
TetMesh PartOf(const TetMesh& whole, const IsKept& is_kept) {
  TetMesh mesh;
  std::vector<int> number(whole.points.size(), -1);
  for (auto tet : whole.tets) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : tet) middle += whole.points[v] / 4;
    if (!is_kept(middle)) continue;
    for (int& v : tet) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(whole.points[v]);
      }
      v = number[v];
    }
    mesh.tets.push_back(tet);
  }
  return mesh;
}

}  // namespace octupole
