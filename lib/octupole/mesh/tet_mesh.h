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
  /// Triangles that the file or the caller tags as parts of surfaces, and the tag of each. Inside the mesh they are
  /// interfaces, and a feature edge between two of one tag may be a seam (alignment/interfaces.h, mesh/seams.h). Those
  /// that are no faces of tetrahedra mean nothing.
  std::vector<std::array<int, 3>> surface_triangles = {};
  std::vector<int> surface_tags = {};
  /// The nodes {v, a, b} on the edges of second-order tetrahedra: v, a vertex of no tetrahedron, lies between a and b.
  std::vector<std::array<int, 3>> mid_edge_nodes = {};
};

/// Checks that a mesh can carry a field: at least one tetrahedron, finite points, indices in range
/// and different within each tetrahedron, feature edge, surface triangle and mid-edge node, `regions` empty or one per
/// tetrahedron, one surface tag per surface triangle, mid-edge nodes between vertices of tetrahedra and none itself.
/// Inverted and flat tetrahedra are allowed.
///
/// \throw std::invalid_argument naming the first offending tetrahedron, point, feature, triangle or node and its value.
void CheckTetMesh(const TetMesh& mesh);

/// For every point, whether it is a vertex of a tetrahedron.
std::vector<bool> CornersOfTets(const TetMesh& mesh);

}  // namespace octupole
