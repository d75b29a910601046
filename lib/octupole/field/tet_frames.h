#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// One frame per tetrahedron from one per vertex, for programs that want a field constant on tetrahedra: the frame
/// nearest to the mean of the corners' octupoles, each with the sign that makes the sum s_1 a_1 + ... + s_4 a_4
/// longest. This is the frame of the x that minimises the sum of min(|x - a_i|^2, |x + a_i|^2), whichever way the
/// corners' axes are ordered and pointed.
///
/// \param frames one rotation per point, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per point and all are rotations.
std::vector<Eigen::Matrix3d> TetFrames(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
