#include "octupole/mesh/seams.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using internal::Simplex;

// The tags of surface triangles, whatever the order of their vertices.
class SurfaceTags {
 public:
  explicit SurfaceTags(const TetMesh& mesh) {
    tags_.reserve(mesh.surface_triangles.size());
    for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
      tags_.emplace_back(Sorted(mesh.surface_triangles[t]), mesh.surface_tags[t]);
    }
    std::sort(tags_.begin(), tags_.end());
  }

  std::optional<int> Find(const std::array<int, 3>& triangle) const {
    const std::array<int, 3> vertices = Sorted(triangle);
    const auto tag = std::lower_bound(tags_.begin(), tags_.end(), vertices,
                                      [](const auto& entry, const auto& key) { return entry.first < key; });
    if (tag == tags_.end() || tag->first != vertices) return std::nullopt;
    return tag->second;
  }

 private:
  static std::array<int, 3> Sorted(std::array<int, 3> triangle) {
    std::sort(triangle.begin(), triangle.end());
    return triangle;
  }

  std::vector<std::pair<std::array<int, 3>, int>> tags_;
};

}  // namespace

std::vector<std::array<int, 2>> FindSeams(const TetMesh& mesh, const std::vector<std::array<int, 3>>& triangles,
                                          double feature_angle_deg) {
  std::vector<std::array<int, 2>> seams;
  if (mesh.feature_edges.empty() || mesh.surface_triangles.empty()) return seams;
  std::vector<std::array<int, 2>> marked = mesh.feature_edges;
  for (std::array<int, 2>& edge : marked) std::sort(edge.begin(), edge.end());
  std::sort(marked.begin(), marked.end());
  const SurfaceTags tags(mesh);
  const double min_cosine = std::cos(feature_angle_deg * M_PI / 180);
  const auto visit = [&](const Simplex<2>& edge, int count) {
    if (count != 2 || !std::binary_search(marked.begin(), marked.end(), edge.vertices)) return;
    const std::array<int, 3>& one = triangles[(&edge)[0].cell];
    const std::array<int, 3>& other = triangles[(&edge)[1].cell];
    const std::optional<int> tag = tags.Find(one);
    if (!tag || tag != tags.Find(other)) return;
    if (TriangleNormal(mesh.points, one).dot(TriangleNormal(mesh.points, other)) < min_cosine) return;
    seams.push_back(edge.vertices);
  };
  internal::ForEachDistinct(triangles, internal::kTriangleEdges, mesh.points.size(), visit);
  return seams;
}

}  // namespace octupole
