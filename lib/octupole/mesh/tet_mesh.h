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
  /// Edges of the mesh, as pairs of vertices, to which the file or the caller asks the field to be aligned: creases,
  /// curves of the CAD model; and points that are marked as their corners. Empty when nothing is marked.
  std::vector<std::array<int, 2>> feature_edges = {};
  std::vector<int> feature_points = {};
};

/// Checks that a mesh can carry a field: at least one tetrahedron, finite points, indices in range
/// and different within each tetrahedron and feature edge, `regions` empty or one per tetrahedron. Inverted and flat
/// tetrahedra are allowed.
///
/// \throw std::invalid_argument naming the first offending tetrahedron, point or feature and its value.
void CheckTetMesh(const TetMesh& mesh);

}  // namespace octupole
