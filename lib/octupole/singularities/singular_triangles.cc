#include "octupole/singularities/singular_triangles.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "octupole/frames/frame.h"
#include "octupole/mesh/internal/sorted_simplices.h"

namespace octupole {
namespace {

using internal::kTetFaces;

// As in octahedral_group.cc: 3 - sin(45 deg)^2, with a margin for rounding.
constexpr double kWithin22Point5Degrees = 2.5001;

}  // namespace

std::vector<SingularTriangle> FindSingularTriangles(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  if (frames.size() != mesh.points.size()) {
    throw std::invalid_argument("FindSingularTriangles: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  struct Side {
    std::array<int, 3> vertices;
    int tet;
    TurnType type;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<int, 4> tet = mesh.tets[t];
    std::sort(tet.begin(), tet.end());
    const bool is_regular = std::all_of(tet.begin() + 1, tet.end(), [&](int v) {
      return SumOfFourthPowers(frames[tet[0]].transpose() * frames[v]) > kWithin22Point5Degrees;
    });
    if (is_regular) continue;
    for (const auto& [a, b, c] : kTetFaces) {
      const TurnType type = HolonomyType(frames[tet[a]], frames[tet[b]], frames[tet[c]]);
      if (type != TurnType::kNone) sides.push_back({{tet[a], tet[b], tet[c]}, static_cast<int>(t), type});
    }
  }
  // Stable, so the tets of a triangle stay in order.
  std::stable_sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.vertices < t.vertices; });
  std::vector<SingularTriangle> triangles;
  for (const Side& side : sides) {
    if (triangles.empty() || triangles.back().vertices != side.vertices) {
      triangles.push_back({side.vertices, side.type, {}});
    }
    triangles.back().tets.push_back(side.tet);
  }
  return triangles;
}

}  // namespace octupole
