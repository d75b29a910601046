#include "octupole/io/cross_field_writer.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "octupole/io/vtu_writer.h"

namespace octupole {
namespace {

void CheckSize(const char* what, std::size_t size, const char* of, std::size_t expected) {
  if (size == expected) return;
  throw std::invalid_argument("WriteCrossField: " + std::to_string(size) + " " + what + " for " +
                              std::to_string(expected) + " " + of);
}

}  // namespace

std::vector<int> QuarterIndicesOfFaces(const std::vector<int>& faces, const std::vector<int>& quarter_indices) {
  std::vector<int> indices(faces.empty() ? 0 : faces.back() + 1, 0);
  for (std::size_t t = 0; t < faces.size(); ++t) indices[faces[t]] += quarter_indices[t];
  return indices;
}

void WriteCrossField(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<int>& faces,
                     const std::vector<Eigen::Matrix3d>& crosses, const std::vector<Alignment>& alignments,
                     const std::vector<int>& face_indices) {
  CheckSize("crosses", crosses.size(), "points", mesh.points.size());
  CheckSize("alignments", alignments.size(), "points", mesh.points.size());
  CheckSize("faces", faces.size(), "triangles", mesh.triangles.size());
  std::array<std::vector<double>, 3> axes;
  for (int k = 0; k < 3; ++k) {
    axes[k].reserve(3 * crosses.size());
    for (const Eigen::Matrix3d& cross : crosses)
      axes[k].insert(axes[k].end(), cross.col(k).begin(), cross.col(k).end());
  }
  std::vector<std::int32_t> kinds;
  kinds.reserve(alignments.size());
  for (const Alignment& alignment : alignments) kinds.push_back(static_cast<std::int32_t>(alignment.kind()));
  std::vector<std::int32_t> indices;
  indices.reserve(faces.size());
  for (const int face : faces) {
    if (face < 0 || static_cast<std::size_t>(face) >= face_indices.size()) {
      throw std::invalid_argument("WriteCrossField: face " + std::to_string(face) + " has no index");
    }
    indices.push_back(face_indices[face]);
  }
  WriteVtu(path, mesh.points,
           {{VtuCellType::kTriangle, reinterpret_cast<const int*>(mesh.triangles.data()), mesh.triangles.size()}},
           {{"tangent_u", 3, axes[0].data()},
            {"tangent_v", 3, axes[1].data()},
            {"normal", 3, axes[2].data()},
            {"alignment", 1, kinds.data()}},
           {{"face", 1, faces.data()}, {"quarter_index", 1, indices.data()}});
}

}  // namespace octupole
