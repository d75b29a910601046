#include "octupole/alignment/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "octupole/mesh/surface_corners.h"

namespace octupole {

std::vector<std::array<int, 2>> SharpEdges(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles, double feature_angle_deg,
                                           int min_faces) {
  const double min_cosine = std::cos(feature_angle_deg * M_PI / 180);
  struct Side {
    int a, b;
    Eigen::Vector3d normal;
  };
  std::vector<Side> sides;
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d normal = TriangleNormal(points, triangle);
    // A face of zero area has nothing to compare.
    if (normal.isZero(0)) continue;
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      sides.push_back({a, b, normal});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& s, const Side& t) { return std::pair(s.a, s.b) < std::pair(t.a, t.b); });
  std::vector<std::array<int, 2>> edges;
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& s) { return s.a != first->a || s.b != first->b; });
    // Where more than two faces meet, any pair makes a feature.
    bool is_feature = false;
    for (auto s = first; s != last; ++s) {
      for (auto t = first; t != s; ++t) {
        is_feature |= s->normal.dot(t->normal) < min_cosine;
      }
    }
    if (is_feature && last - first >= min_faces) edges.push_back({first->a, first->b});
    first = last;
  }
  return edges;
}

}  // namespace octupole
