#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/tet_mesh.h"

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

/// The same on cells of any kind, with further arrays of the caller's.
template <int kDegree>
void WriteField(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
                const std::vector<VtuCells>& cells, const std::vector<Harmonic<kDegree>>& coefficients,
                const std::vector<Eigen::Matrix3d>& frames, const std::vector<Alignment>& alignments,
                std::vector<VtuArray> point_data, const std::vector<VtuArray>& cell_data);

/// Writes one frame per tetrahedron (see TetFrames) in the text format .fra of hexahedral meshers such as CubeCover:
/// the line "FRA 1", a line with the number of tetrahedra, 3 (vectors for each) and 0 (the type), then the vectors, one
/// a line, in the order of the tetrahedra. Numbers are written so that they read back as they are.
///
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
void WriteFra(const std::filesystem::path& path, const std::vector<Eigen::Matrix3d>& tet_frames);

/// Writes frames as unit quaternions in text, one a line: w x y z, with w >= 0. Numbers are written so that they read
/// back as they are. Errors as above. \throw std::invalid_argument when a frame is not a rotation.
void WriteQuaternions(const std::filesystem::path& path, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
