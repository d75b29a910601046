#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A field as WriteField leaves it in a file.
struct FieldFile {
  TetMesh mesh;
  /// One per point; the columns are the axes.
  std::vector<Eigen::Matrix3d> frames;
};

/// Reads the mesh of a .vtu file as ReadTetMesh does, and its frames from the point arrays `frame_x` and `frame_y`;
/// the third axis is their cross product. Single precision, as other programs may have saved them in, will do.
///
/// \throw std::runtime_error "path: what is wrong" also when there are no such arrays, or two axes are not within a
/// degree of a right angle.
FieldFile ReadField(const std::filesystem::path& path);

}  // namespace octupole
