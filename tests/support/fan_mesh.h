#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A prism over a regular polygon, cut into wedges about its axis, the z axis: of radius 1 and height 1. The wedges
/// that share a number in `region_of_wedge` are one region. Point k is on the axis at z = k / layers.
inline TetMesh MakeFanMesh(const std::vector<int>& region_of_wedge, int layers) {
  const int sides = static_cast<int>(region_of_wedge.size());
  TetMesh mesh;
  for (int column = -1; column < sides; ++column) {
    const double phi = 2 * EIGEN_PI * column / sides;
    for (int k = 0; k <= layers; ++k) {
      const double z = static_cast<double>(k) / layers;
      mesh.points.push_back(column < 0 ? Eigen::Vector3d(0, 0, z) : Eigen::Vector3d(std::cos(phi), std::sin(phi), z));
    }
  }
  for (int wedge = 0; wedge < sides; ++wedge) {
    std::array<int, 3> columns = {0, 1 + wedge, 1 + (wedge + 1) % sides};
    // Each side of a prism is cut from its first column's foot, so that neighbours agree.
    std::sort(columns.begin(), columns.end());
    for (int k = 0; k < layers; ++k) {
      const auto at = [&](int corner, int up) { return columns[corner] * (layers + 1) + k + up; };
      mesh.tets.push_back({at(0, 0), at(1, 0), at(2, 0), at(2, 1)});
      mesh.tets.push_back({at(0, 0), at(1, 0), at(1, 1), at(2, 1)});
      mesh.tets.push_back({at(0, 0), at(0, 1), at(1, 1), at(2, 1)});
      mesh.regions.insert(mesh.regions.end(), 3, region_of_wedge[wedge]);
    }
  }
  return mesh;
}

}  // namespace octupole
