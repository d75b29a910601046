#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace octupole {

/// The unit normal of a triangle, (b - a) x (c - a) normalised; zero when its area is zero to rounding.
Eigen::Vector3d TriangleNormal(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& triangle);

/// A corner of a surface triangle, as its vertex sees it.
struct SurfaceCorner {
  /// The triangle's unit normal, or zero when it has none.
  Eigen::Vector3d normal;
  /// The triangle's angle at the vertex, in radians.
  double angle;
};

/// For every point, the corners of the triangles around it, in the order of the triangles.
std::vector<std::vector<SurfaceCorner>> SurfaceCorners(const std::vector<Eigen::Vector3d>& points,
                                                       const std::vector<std::array<int, 3>>& triangles);

/// The angle-weighted unit normal of a vertex; zero when its corners give none.
Eigen::Vector3d MeanNormal(const std::vector<SurfaceCorner>& corners);

/// Whether all the normals are within `angle_deg` of each other; false when a corner has no normal.
bool NormalsAgree(const std::vector<SurfaceCorner>& corners, double angle_deg);

/// MeanNormal at every point of a surface.
std::vector<Eigen::Vector3d> VertexNormals(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles);

}  // namespace octupole
