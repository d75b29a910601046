#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "octupole/mesh/box_mesh.h"

namespace octupole {

/// The cube [-1, 1]^3 of region 1 with a ball of radius 1/2 of region 2 inside: a grid of `cells` cells each way, a
/// multiple of 4, its concentric shells pushed onto spheres up to the ball and from there gradually back onto cubes.
/// The vertices of the interface lie on the sphere.
inline TetMesh MakeBallInBoxMesh(int cells) {
  TetMesh mesh = MakeBoxMesh({cells, cells, cells}, {2, 2, 2});
  for (Eigen::Vector3d& p : mesh.points) p -= Eigen::Vector3d::Ones();
  const auto shell_of = [&](int v) { return mesh.points[v].cwiseAbs().maxCoeff(); };
  for (const auto& tet : mesh.tets) {
    bool is_in_ball = true;
    for (const int v : tet) is_in_ball = is_in_ball && shell_of(v) < 0.5 + 1e-9;
    mesh.regions.push_back(is_in_ball ? 2 : 1);
  }
  for (Eigen::Vector3d& p : mesh.points) {
    const double shell = p.cwiseAbs().maxCoeff();
    if (shell == 0) continue;
    const double share_of_cube = std::max(0., 2 * shell - 1);
    p = share_of_cube * p + (1 - share_of_cube) * Eigen::Vector3d(p * (shell / p.norm()));
  }
  return mesh;
}

}  // namespace octupole
