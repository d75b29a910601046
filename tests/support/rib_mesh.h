#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A plate, 6 x 8 x `scale`, a wall on it at y = 6 to 8, and between them, at x = 2 to 4, a rib whose slope rises from
/// the plate at y = 2 by `scale` per unit of y.
inline TetMesh MakeRibMesh(double scale) {
  const TetMesh box = MakeBoxMesh({6, 8, 6}, {6, 8, 6});
  TetMesh mesh;
  std::vector<int> number(box.points.size(), -1);
  for (auto tet : box.tets) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : tet) middle += box.points[v] / 4;
    const bool is_in_rib = middle.x() > 2 && middle.x() < 4 && middle.z() - 1 < middle.y() - 2;
    if (middle.z() > 1 && middle.y() < 6 && !is_in_rib) continue;
    for (int& v : tet) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(box.points[v].cwiseProduct(Eigen::Vector3d(1, 1, scale)));
      }
      v = number[v];
    }
    mesh.tets.push_back(tet);
  }
  return mesh;
}

}  // namespace octupole
