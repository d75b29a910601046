#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace octupole {

/// The edges of at least `min_faces` triangles of a surface, between two of which normals differ by more than the
/// angle; each once with the smaller vertex first, in lexicographic order. Triangles of zero area have no normal.
std::vector<std::array<int, 2>> SharpEdges(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles, double feature_angle_deg,
                                           int min_faces = 2);

}  // namespace octupole
