#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace octupole::internal {

/// The edges of at least `min_faces` triangles between which normals differ by more than the angle.
std::vector<std::array<int, 2>> SharpEdges(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles, double feature_angle_deg,
                                           int min_faces = 2);

}  // namespace octupole::internal
