#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/alignment.h"
#include "octupole/harmonics.h"
#include "octupole/tet_mesh.h"

namespace octupole {

/// Writes a field for ParaView, meshio and the like: the mesh as WriteVtu does, with the point arrays
///  - `frame_x`, `frame_y`, `frame_z`: the three axes, orthonormal and right-handed,
///  - `octupole` (7 numbers) or `hexadecapole` (9 numbers): the coefficients as they are, not normalised,
///  - `alignment`: 0 free, 1 an axis is prescribed, 2 the frame is prescribed,
/// and the cell array `region` where the mesh has regions.
///
/// \throw std::invalid_argument unless there is one value of each per point.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
template <int kDegree>
void WriteField(const std::filesystem::path& path, const TetMesh& mesh,
                const std::vector<Harmonic<kDegree>>& coefficients, const std::vector<Eigen::Matrix3d>& frames,
                const std::vector<Alignment>& alignments);

}  // namespace octupole
