#include "octupole/maps/boundary_sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "octupole/maps/edge_turns.h"
#include "octupole/maps/internal/union_find.h"

namespace octupole {
namespace {

using Face = BoundarySheets::Face;

constexpr double kDegreesPerRadian = 57.29577951308232;

// The corners of the face opposite corner i, outward in a tetrahedron of positive volume.
constexpr std::array<std::array<int, 3>, 4> kOutwardFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

// Twice the area times the outward normal.
Eigen::Vector3d AreaNormal(const TetMesh& mesh, int tet, int corner) {
  const auto& [a, b, c] = kOutwardFaces[corner];
  const std::array<int, 4>& v = mesh.tets[tet];
  return (mesh.points[v[b]] - mesh.points[v[a]]).cross(mesh.points[v[c]] - mesh.points[v[a]]);
}

// The interior angle between two boundary faces at their edge, from the first to the last step of its ring.
double InteriorAngle(const TetMesh& mesh, const EdgeRings& rings, std::size_t ring) {
  const EdgeRings::Step &first = rings.steps[rings.begin[ring]], &last = rings.steps[rings.begin[ring + 1] - 1];
  const Eigen::Vector3d& a = mesh.points[rings.vertices[ring][0]];
  const Eigen::Vector3d edge = (mesh.points[rings.vertices[ring][1]] - a).normalized();
  const auto across = [&](int vertex) -> Eigen::Vector3d {
    const Eigen::Vector3d d = mesh.points[vertex] - a;
    return d - d.dot(edge) * edge;
  };
  const Eigen::Vector3d from = across(mesh.tets[first.tet][first.out]), to = across(mesh.tets[last.tet][last.in]);
  const double angle = std::atan2(edge.dot(from.cross(to)), from.dot(to)) * kDegreesPerRadian;
  return angle < 0 ? angle + 360 : angle;
}

struct Meeting {
  std::array<int, 2> vertices;
  double angle_deg;
  std::array<int, 2> faces;
};

}  // namespace

BoundarySheets FindBoundarySheets(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings) {
  BoundarySheets result;
  std::vector<double> areas;
  std::vector<std::array<int, 4>> face_of(mesh.tets.size(), {-1, -1, -1, -1});
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      if (matched.neighbours[t][i] >= 0) continue;
      const Eigen::Vector3d normal = AreaNormal(mesh, t, i), in_frame = matched.frames[t].transpose() * normal;
      int axis;
      in_frame.cwiseAbs().maxCoeff(&axis);
      face_of[t][i] = static_cast<int>(result.faces.size());
      result.faces.push_back({t, i, axis, in_frame[axis] < 0 ? -1 : 1, 0});
      areas.push_back(0.5 * normal.norm());
    }
  }
  internal::UnionFind sheets(static_cast<int>(result.faces.size()));
  std::vector<Meeting> meetings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (rings.is_closed[r]) continue;
    const EdgeRings::Step &first = rings.steps[rings.begin[r]], &last = rings.steps[rings.begin[r + 1] - 1];
    const int f = face_of[first.tet][first.in], g = face_of[last.tet][last.out];
    // The first face's axis e_k becomes turn^T e_k in the last frame.
    const OctahedralRotation turn = TurnAround(matched, rings, r);
    const Face &one = result.faces[f], &other = result.faces[g];
    if (turn.axis[one.axis] != other.axis) continue;
    if (turn.sign[one.axis] * one.sign == other.sign) {
      sheets.Unite(f, g);
    } else if (const double angle = InteriorAngle(mesh, rings, r); angle < 180) {
      meetings.push_back({rings.vertices[r], angle, {f, g}});
    }
  }
  std::vector<int> sheet_of_root(result.faces.size(), -1);
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    int& sheet = sheet_of_root[sheets.Root(static_cast<int>(f))];
    if (sheet < 0) {
      sheet = static_cast<int>(result.sheets.size());
      result.sheets.emplace_back();
    }
    result.faces[f].sheet = sheet;
    result.sheets[sheet].area += areas[f];
  }
  std::stable_sort(meetings.begin(), meetings.end(),
                   [](const Meeting& a, const Meeting& b) { return a.angle_deg < b.angle_deg; });
  for (const Meeting& meeting : meetings) {
    const int s = result.faces[meeting.faces[0]].sheet, t = result.faces[meeting.faces[1]].sheet;
    int released = s;
    if (result.sheets[t].is_released ||
        (!result.sheets[s].is_released && result.sheets[t].area < result.sheets[s].area))
      released = t;
    result.sheets[released].is_released = true;
    result.wedges.push_back({meeting.vertices, meeting.angle_deg, released});
  }
  return result;
}

}  // namespace octupole
