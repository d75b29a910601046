#pragma once

#include <Eigen/Core>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/tet_mesh.h"
#include "part_of_mesh.h"

namespace octupole {

/// A plate, 6 x 8 x `scale`, a wall on it at y = 6 to 8, and between them, at x = 2 to 4, a rib whose slope rises from
/// the plate at y = 2 by `scale` per unit of y.
inline TetMesh MakeRibMesh(double scale) {
  TetMesh mesh = PartOf(MakeBoxMesh({6, 8, 6}, {6, 8, 6}), [](const Eigen::Vector3d& p) {
    const bool is_in_rib = p.x() > 2 && p.x() < 4 && p.z() - 1 < p.y() - 2;
    return p.z() <= 1 || p.y() >= 6 || is_in_rib;
  });
  for (Eigen::Vector3d& p : mesh.points) p.z() *= scale;
  return mesh;
}

}  // namespace octupole
