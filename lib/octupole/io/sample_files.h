#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/field/field_sampler.h"

namespace octupole {

// Files of `octupole sample`: where a field is wanted, and what it is there.

/// The points of a file: `.csv`, `.txt` or `.xyz`, x, y, z in each line, with commas or spaces ('#' begins a comment,
/// and the first line may name the columns); or the vertices of any mesh that ReadTetMesh knows the format of, whatever
/// its cells.
/// \throw std::runtime_error "path:line: what is wrong", or "path: what is wrong".
std::vector<Eigen::Vector3d> ReadPoints(const std::filesystem::path& path);

/// The centres of a mesh's cells, the means of their corners: of its tetrahedra in the order of the file, then of the
/// hexahedra, prisms and pyramids of a .mesh, .msh, .vtk or .vtu file.
/// \throw std::runtime_error also when there are no such cells.
std::vector<Eigen::Vector3d> ReadCellCenters(const std::filesystem::path& path);

/// Writes frames at points, as the extension says: `.vtu` with one vertex per point and the arrays `frame_x`,
/// `frame_y`, `frame_z` and `is_inside`; or `.csv` with these columns behind x, y, z, in numbers that read back as they
/// are. An existing file stays as it was until the new one is complete. \throw std::invalid_argument unless there is
/// one sample per point, std::runtime_error at another extension or when the file cannot be written.
void WriteSamples(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
                  const FieldSamples& samples);

}  // namespace octupole
