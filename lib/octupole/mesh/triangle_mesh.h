#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A surface as plain arrays, open or closed, of any topology: edges may have more than two triangles.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;
  /// Three indices into `points` per triangle. Neighbours are expected to be oriented alike.
  std::vector<std::array<int, 3>> triangles;
  /// As those of TetMesh.
  std::vector<std::array<int, 2>> feature_edges = {};
  std::vector<int> feature_points = {};
};

/// Checks that a mesh can carry a field: at least one triangle, finite points, indices in range and different within
/// each triangle and feature edge. Triangles of zero area are allowed.
/// \throw std::invalid_argument naming the first offending triangle, point or feature and its value.
void CheckTriangleMesh(const TriangleMesh& mesh);

// What follows expects meshes that satisfy CheckTriangleMesh() and CheckTetMesh().

/// The edges of all triangles, each once with the smaller vertex first, in lexicographic order.
std::vector<std::array<int, 2>> MeshEdges(const TriangleMesh& mesh);

/// The edges of exactly one triangle, in its direction, ordered by their ascending vertices.
std::vector<std::array<int, 2>> OpenEdges(const TriangleMesh& mesh);

/// A polygon as triangles that share one of its corners: the one for which the smallest area of a triangle is largest,
/// areas being signed and seen along the polygon's mean normal. This cuts convex polygons and all quadrilaterals
/// without overlaps. \throw std::invalid_argument when the polygon has less than three corners.
std::vector<std::array<int, 3>> FanOfPolygon(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<int>& polygon);

/// The boundary of a tet mesh: BoundaryTriangles on the points of the mesh, interior ones included, with its features,
/// those inside included.
TriangleMesh BoundarySurface(const TetMesh& mesh);

/// A surface cut open where it is no manifold, so that around every vertex the triangles form one fan. Triangles stay
/// together across an edge that exactly two of them have, in opposite directions. What an oriented surface becomes has
/// no edge of more than two triangles.
struct ManifoldSurface {
  /// Indices into `points`; triangles are in the order of the given.
  std::vector<std::array<int, 3>> triangles;
  /// Of each vertex of `triangles` the point of the mesh that it stands for, in ascending order. Points without
  /// triangles have no vertex, those where the surface was cut have several.
  std::vector<int> points;
};
ManifoldSurface CutToManifold(const TriangleMesh& mesh);

}  // namespace octupole
