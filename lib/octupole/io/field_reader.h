#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace octupole {

/// Reads the frames of a field that WriteField wrote: the point arrays `frame_x`, `frame_y` and `frame_z` of a VTU file
/// of one piece.
///
/// \param num_points of the mesh that the field has to be of.
/// \throw std::runtime_error naming the path, and the line where there is one, when the file cannot be read, has no
///     frames or another number of points, or holds axes that are not orthonormal and right-handed to 1e-6.
std::vector<Eigen::Matrix3d> ReadFrames(const std::filesystem::path& path, std::size_t num_points);

}  // namespace octupole
