#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// The quarter indices of faces that were cut into triangles: the sum of those of each face's triangles.
/// \param faces for each triangle its face, from 0 and in ascending order, as of ReadTriangleMesh.
std::vector<int> QuarterIndicesOfFaces(const std::vector<int>& faces, const std::vector<int>& quarter_indices);

/// Writes a cross field for ParaView, meshio and the like: the triangles with the point arrays
///  - `tangent_u`, `tangent_v`, `normal`: the axes of the CrossField, right-handed,
///  - `alignment`: 0 free, 1 an axis is prescribed, 2 the frame is prescribed,
/// and the cell arrays
///  - `face`: the polygon that the triangle was cut from,
///  - `quarter_index`: four times the index of the field in that face.
///
/// \param face_indices of QuarterIndicesOfFaces.
/// \throw std::invalid_argument unless there is one cross and alignment per point, and one face with an index per
///     triangle.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
void WriteCrossField(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<int>& faces,
                     const std::vector<Eigen::Matrix3d>& crosses, const std::vector<Alignment>& alignments,
                     const std::vector<int>& face_indices);

}  // namespace octupole
