#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/alignment/internal/spectral_rule.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole::internal {

using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// The sum of the corners' normals, weighted by their angles.
/// \param corners each with a normal.
NormalSum SumOfNormals(const std::vector<SurfaceCorner>& corners);

/// The mean of the projectors I - U_i U_i^T of the corners' normals, weighted by their angles (theory.md, section 4).
/// Its lowest eigenvalue says how far the normals are from being axes of one frame, its eigenvector which frame.
/// \param corners not empty, and each with a normal.
Matrix7 AveragedProjector(const std::vector<SurfaceCorner>& corners);

/// The corners that have a normal.
std::vector<SurfaceCorner> WithNormal(std::vector<SurfaceCorner> corners);

}  // namespace octupole::internal
