#include "octupole/maps/boundary_sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "octupole/maps/edge_turns.h"
#include "octupole/maps/internal/union_find.h"
#include "octupole/mesh/tet_neighbours.h"

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

// Steps of a ring from one face of a sheet, through which the first enters, to the next, through which the last leaves.
struct Sector {
  const EdgeRings& rings;
  std::size_t ring;
  std::vector<std::size_t> steps;

  const EdgeRings::Step& first() const { return rings.steps[steps.front()]; }
  const EdgeRings::Step& last() const { return rings.steps[steps.back()]; }

  OctahedralRotation Turn(const MatchedFrames& matched) const {
    OctahedralRotation turn;
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      turn = turn * matched.match(rings.steps[steps[i]].tet, rings.steps[steps[i]].out);
    }
    return turn;
  }

  // Between the two faces.
  double AngleDeg(const TetMesh& mesh) const {
    const Eigen::Vector3d& a = mesh.points[rings.vertices[ring][0]];
    const Eigen::Vector3d edge = (mesh.points[rings.vertices[ring][1]] - a).normalized();
    const auto across = [&](int vertex) -> Eigen::Vector3d {
      const Eigen::Vector3d d = mesh.points[vertex] - a;
      return d - d.dot(edge) * edge;
    };
    const Eigen::Vector3d from = across(mesh.tets[first().tet][first().out]),
                          to = across(mesh.tets[last().tet][last().in]);
    const double angle = std::atan2(edge.dot(from.cross(to)), from.dot(to)) * kDegreesPerRadian;
    return angle < 0 ? angle + 360 : angle;
  }
};

// What the faces of sheets divide a ring into; nothing where there is but one such face.
template <typename IsFace>
std::vector<Sector> SectorsOf(const EdgeRings& rings, std::size_t ring, const IsFace& is_face) {
  const std::size_t begin = rings.begin[ring], size = rings.begin[ring + 1] - begin;
  const auto enters = [&](std::size_t i) { return is_face(rings.steps[i].tet, rings.steps[i].in); };
  std::size_t start = 0;
  if (rings.is_closed[ring]) {
    while (start < size && !enters(begin + start)) ++start;
    if (start == size) return {};
  }
  std::vector<Sector> sectors;
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t i = begin + (start + k) % size;
    if (k == 0 || enters(i)) sectors.push_back({rings, ring, {}});
    sectors.back().steps.push_back(i);
  }
  if (rings.is_closed[ring] && sectors.size() == 1) return {};
  return sectors;
}

struct Meeting {
  std::array<int, 2> vertices;
  double angle_deg;
  std::array<int, 2> faces;
};

}  // namespace

BoundarySheets FindBoundarySheets(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                                  const std::vector<std::array<bool, 4>>& is_interface,
                                  const std::set<int>& released_vertices) {
  BoundarySheets result;
  std::vector<double> areas;
  // From either side of an interface.
  std::vector<std::array<int, 4>> face_of(mesh.tets.size(), {-1, -1, -1, -1});
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = matched.neighbours[t][i];
      if (face_of[t][i] >= 0 || (s >= 0 && !is_interface[t][i])) continue;
      const Eigen::Vector3d normal = AreaNormal(mesh, t, i), in_frame = matched.frames[t].transpose() * normal;
      int axis;
      in_frame.cwiseAbs().maxCoeff(&axis);
      face_of[t][i] = static_cast<int>(result.faces.size());
      if (s >= 0) face_of[s][CornerAcross(mesh, matched.neighbours, t, i)] = face_of[t][i];
      result.faces.push_back({t, i, axis, in_frame[axis] < 0 ? -1 : 1, 0, false});
      areas.push_back(0.5 * normal.norm());
    }
  }
  const auto is_face = [&](int t, int i) { return face_of[t][i] >= 0; };
  // The axis that points out of a tetrahedron, and its sign.
  const auto outward = [&](int t, int i) -> std::pair<int, int> {
    const Face& face = result.faces[face_of[t][i]];
    if (face.tet == t) return {face.axis, face.sign};
    // e_k becomes g^T e_k across the face, and out of one is into the other.
    const OctahedralRotation& g = matched.match(face.tet, face.corner);
    return {g.axis[face.axis], -g.sign[face.axis] * face.sign};
  };
  internal::UnionFind sheets(static_cast<int>(result.faces.size()));
  std::vector<Meeting> meetings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<Sector> sectors = SectorsOf(rings, r, is_face);
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      Sector sector = {rings, r, {}};
      // To the next face, and beyond it to others: a sheet may go on behind one that it meets.
      for (std::size_t j = i; j < sectors.size(); ++j) {
        sector.steps.insert(sector.steps.end(), sectors[j].steps.begin(), sectors[j].steps.end());
        const EdgeRings::Step &first = sector.first(), &last = sector.last();
        const int f = face_of[first.tet][first.in], g = face_of[last.tet][last.out];
        if (f == g) continue;
        const auto [axis, sign] = outward(first.tet, first.in);
        const auto [other_axis, other_sign] = outward(last.tet, last.out);
        // The first face's axis e_k becomes turn^T e_k in the last frame.
        const OctahedralRotation turn = sector.Turn(matched);
        if (turn.axis[axis] != other_axis) {
          if (j == i) result.creases.push_back(rings.vertices[r]);
        } else if (turn.sign[axis] * sign == other_sign) {
          sheets.Unite(f, g);
        } else if (const double angle = sector.AngleDeg(mesh); j == i && angle < 180) {
          meetings.push_back({rings.vertices[r], angle, {f, g}});
        }
      }
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
  for (Face& face : result.faces) {
    face.is_released = result.sheets[face.sheet].is_released;
    for (int k = 0; k < 4; ++k) {
      face.is_released = face.is_released || (k != face.corner && released_vertices.count(mesh.tets[face.tet][k]) > 0);
    }
  }
  return result;
}

}  // namespace octupole
