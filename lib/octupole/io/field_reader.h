#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"

namespace octupole {

/// A field as it stands in a file. Either mesh has no cells: the file holds tetrahedra, or else a surface.
struct FieldFile {
  TetMesh tet_mesh;
  TriangleMesh surface;
  /// One rotation per point, its columns the axes; on a surface the third is the normal.
  std::vector<Eigen::Matrix3d> frames;
};

/// Reads the mesh and the frames of a `.vtu` file: what WriteField and the commands `field` and `surface` write, or any
/// with the point arrays `frame_x`, `frame_y`, `frame_z`, on triangles also `tangent_u`, `tangent_v`, `normal`. Axes
/// may be rounded and left-handed; the frames are right-handed and orthonormal.
///
/// \throw std::runtime_error naming the path, and the point where an axis is wrong: as ReadTetMesh, and when there are
/// no such arrays or axes are more than 0.01 off from being orthonormal.
FieldFile ReadField(const std::filesystem::path& path);

/// Singular curves and points on the boundary.
struct SingularStructure {
  SingularCurves curves;
  std::vector<SingularPoint> points;
};

/// Reads what WriteSingularities writes. The ends of curves follow from their nodes; mean cosines are not in the file.
/// \throw std::runtime_error naming the path when it is no such file.
SingularStructure ReadSingularities(const std::filesystem::path& path);

}  // namespace octupole
