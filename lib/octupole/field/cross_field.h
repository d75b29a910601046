#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// Frames on a surface as a cross field: the same frames with their axes in the order u, v, n, where n is the axis that
/// is nearest to the MeanNormal and points to its side, and u, v, the tangents, are right-handed about it. Where the
/// surface is smooth n is the normal; at creases it is within 55 degrees of it. At vertices without normal the order is
/// that of the frame.
/// \throw std::invalid_argument unless there is one frame per point.
std::vector<Eigen::Matrix3d> CrossField(const TriangleMesh& surface, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
