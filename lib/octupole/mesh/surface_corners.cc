#include "octupole/mesh/surface_corners.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace octupole {
namespace {

// Relative to the squares of lengths and to angles; rounding errors are some 1e-16.
constexpr double kZero = 1e-12;

}  // namespace

Eigen::Vector3d TriangleNormal(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& triangle) {
  const Eigen::Vector3d ab = points[triangle[1]] - points[triangle[0]];
  const Eigen::Vector3d bc = points[triangle[2]] - points[triangle[1]];
  const Eigen::Vector3d ca = points[triangle[0]] - points[triangle[2]];
  const Eigen::Vector3d area = ab.cross(bc);
  const double norm = area.norm();
  if (norm <= kZero * std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()})) return Eigen::Vector3d::Zero();
  return area / norm;
}

std::vector<std::vector<SurfaceCorner>> SurfaceCorners(const std::vector<Eigen::Vector3d>& points,
                                                       const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::vector<SurfaceCorner>> corners(points.size());
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d normal = TriangleNormal(points, triangle);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& at = points[triangle[i]];
      const Eigen::Vector3d next = points[triangle[(i + 1) % 3]] - at;
      const Eigen::Vector3d last = points[triangle[(i + 2) % 3]] - at;
      corners[triangle[i]].push_back({normal, std::atan2(next.cross(last).norm(), next.dot(last))});
    }
  }
  return corners;
}

Eigen::Vector3d MeanNormal(const std::vector<SurfaceCorner>& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SurfaceCorner& corner : corners) sum += corner.angle * corner.normal;
  const double norm = sum.norm();
  if (norm <= kZero) return Eigen::Vector3d::Zero();
  return sum / norm;
}

bool NormalsAgree(const std::vector<SurfaceCorner>& corners, double angle_deg) {
  const double min_cosine = std::cos(angle_deg * M_PI / 180);
  for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
    if (corner->normal.isZero(0)) return false;
    for (auto other = corners.begin(); other != corner; ++other) {
      if (corner->normal.dot(other->normal) < min_cosine) return false;
    }
  }
  return true;
}

std::vector<Eigen::Vector3d> VertexNormals(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(points.size());
  for (const auto& corners : SurfaceCorners(points, triangles)) normals.push_back(MeanNormal(corners));
  return normals;
}

}  // namespace octupole
