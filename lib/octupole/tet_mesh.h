#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace octupole {

/// A tetrahedral mesh as plain arrays, in the order in which the caller (or the file) gave them.
struct TetMesh {
  /// Vertex positions, in the caller's unit of length.
  std::vector<Eigen::Vector3d> points;
  /// Four indices into `points` per tetrahedron; either orientation is allowed.
  std::vector<std::array<int, 4>> tets;
  /// One region tag per tetrahedron, or empty when the mesh has none.
  std::vector<int> regions;
};

/// Checks that a mesh can carry a field: at least one tetrahedron, finite points, indices in range
/// and different within each tetrahedron, `regions` empty or one per tetrahedron. Inverted and flat
/// tetrahedra are allowed.
///
/// \throw std::invalid_argument naming the first offending tetrahedron or point and its value.
void CheckTetMesh(const TetMesh& mesh);

}  // namespace octupole
