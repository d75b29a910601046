#pragma once

#include <Eigen/Core>

#include "octupole/mesh/box_mesh.h"

namespace octupole {

/// The unit ball: a cube's grid of `cells` cells each way, its concentric shells pushed onto spheres. For tests and
/// benchmarks.
inline TetMesh MakeBallMesh(int cells) {
  TetMesh mesh = MakeBoxMesh({cells, cells, cells}, {2, 2, 2});
  for (Eigen::Vector3d& p : mesh.points) {
    p -= Eigen::Vector3d::Ones();
    const double largest = p.cwiseAbs().maxCoeff();
    if (largest > 0) p *= largest / p.norm();
  }
  return mesh;
}

}  // namespace octupole
