#pragma once

#include <Eigen/Core>

#include "octupole/mesh/box_mesh.h"

namespace octupole {

/// The cylinder of radius 1 about the z axis, from z = 0 to `height`: a grid of `cells` x `cells` x `layers` cells, the
/// concentric squares of each layer pushed onto circles.
inline TetMesh MakeCylinderMesh(int cells, int layers, double height) {
  TetMesh mesh = MakeBoxMesh({cells, cells, layers}, {2, 2, height});
  for (Eigen::Vector3d& p : mesh.points) {
    const Eigen::Vector2d q(p.x() - 1, p.y() - 1);
    const double largest = q.cwiseAbs().maxCoeff();
    p.head<2>() = largest > 0 ? Eigen::Vector2d(q * (largest / q.norm())) : Eigen::Vector2d::Zero();
  }
  return mesh;
}

}  // namespace octupole
