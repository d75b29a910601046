#include "octupole/mesh/box_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace octupole {
namespace {

constexpr int kTetsPerCell = 6;

/// The grid steps of a tetrahedron that goes from a cell's first corner to its last along the axes
/// in this order; an odd order needs two vertices swapped.
struct Path {
  std::array<int, 3> axes;
  bool is_odd;
};
constexpr Path kPaths[kTetsPerCell] = {{{0, 1, 2}, false}, {{1, 2, 0}, false}, {{2, 0, 1}, false},
                                       {{0, 2, 1}, true},  {{1, 0, 2}, true},  {{2, 1, 0}, true}};

void CheckArguments(const std::array<int, 3>& cells, const Eigen::Vector3d& size) {
  double num_points = 1.0;
  double num_tets = kTetsPerCell;
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    if (cells[i] < 1) {
      throw std::invalid_argument("MakeBoxMesh: " + std::to_string(cells[i]) + " cells along " + axis);
    }
    if (!(size[i] > 0.0) || !std::isfinite(size[i])) {
      throw std::invalid_argument("MakeBoxMesh: the size along " + axis + " is " + std::to_string(size[i]));
    }
    num_points *= cells[i] + 1.0;
    num_tets *= cells[i];
  }
  if (std::max(num_points, num_tets) > std::numeric_limits<int>::max()) {
    throw std::invalid_argument("MakeBoxMesh: " + std::to_string(cells[0]) + " x " + std::to_string(cells[1]) + " x " +
                                std::to_string(cells[2]) + " cells are too many");
  }
}

}  // namespace

TetMesh MakeBoxMesh(const std::array<int, 3>& cells, const Eigen::Vector3d& size) {
  CheckArguments(cells, size);
  const std::array<int, 3> stride = {1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)};
  TetMesh mesh;
  mesh.points.reserve(static_cast<std::size_t>(stride[2]) * (cells[2] + 1));
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) {
        mesh.points.emplace_back(size.x() * i / cells[0], size.y() * j / cells[1], size.z() * k / cells[2]);
      }
    }
  }
  mesh.tets.reserve(static_cast<std::size_t>(kTetsPerCell) * cells[0] * cells[1] * cells[2]);
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        for (const Path& path : kPaths) {
          std::array<int, 4> tet;
          tet[0] = i * stride[0] + j * stride[1] + k * stride[2];
          for (int step = 0; step < 3; ++step) {
            tet[step + 1] = tet[step] + stride[path.axes[step]];
          }
          if (path.is_odd) {
            std::swap(tet[1], tet[2]);
          }
          mesh.tets.push_back(tet);
        }
      }
    }
  }
  return mesh;
}

}  // namespace octupole
