#include "octupole/maps/boundary_sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
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

// A face as seen from one of its tetrahedra; an interface has two sides.
struct Side {
  int tet;
  int corner;
  int face;
  // What points out of the tetrahedron.
  int axis;
  int sign;
};

enum class MeetingKind { kSheet, kCrease, kOpposite };

// From one side of faces to the next across an edge, around the vertex `pivot` of both.
struct Passage {
  Side from, to;
  int other;  // the end of the edge that is not the pivot
  OctahedralRotation turn;
  double angle_deg;
  MeetingKind kind;

  // An axis of a parameter and its sign, in the frame of `from`, as it is in that of `to`.
  std::pair<int, int> Carry(const std::pair<int, int>& axis) const {
    return {turn.axis[axis.first], turn.sign[axis.first] * axis.second};
  }

  Passage Reversed() const { return {to, from, other, turn.Inverse(), angle_deg, kind}; }
};

// Finds the corners of sheets that have angle 0 in every map.
class FlatCornerFinder {
 public:
  FlatCornerFinder(const TetMesh& mesh, const std::vector<Face>& faces) : mesh_(mesh), faces_(faces) {}

  void Add(const std::array<int, 2>& edge, Passage passage) {
    if (faces_[passage.from.face].is_released || faces_[passage.to.face].is_released) return;
    // Around its other end one goes back.
    passage.other = edge[1];
    AddAround(edge[0], passage);
    passage.other = edge[0];
    AddAround(edge[1], passage.Reversed());
  }

  std::vector<BoundarySheets::FlatCorner> Find() const {
    std::map<int, BoundarySheets::FlatCorner> corners;
    for (const auto& [key, passage] : passages_) {
      if (!IsSharpCrease(passage)) continue;
      const int v = key.first;
      if (const auto angle = FlatAngleFrom(v, passage)) corners[v] = {v, *angle, {}};
    }
    std::vector<BoundarySheets::FlatCorner> result;
    for (auto& [v, corner] : corners) {
      corner.bend = TraceBend(corner);
      result.push_back(std::move(corner));
    }
    return result;
  }

 private:
  // The vertex and the side that one comes from.
  using Key = std::pair<int, std::pair<int, int>>;

  void AddAround(int v, const Passage& passage) {
    passages_.emplace(Key(v, {passage.from.tet, passage.from.corner}), passage);
  }

  // On a smooth surface creases zigzag along edges, as it happens, and their corners mean nothing.
  static bool IsSharpCrease(const Passage& passage) {
    constexpr double kHalfRightAngleDeg = 45;
    return passage.kind == MeetingKind::kCrease && std::abs(passage.angle_deg - 180) >= kHalfRightAngleDeg;
  }

  const Passage* Next(int v, const Side& side) const {
    const auto place = passages_.find(Key(v, {side.tet, side.corner}));
    return place == passages_.end() ? nullptr : &place->second;
  }

  // The axis along which one leaves the sheet at crease.to across the crease, in the frame there: that which points out
  // of the sheet beyond, or, at a concave crease, into it.
  static std::pair<int, int> Conormal(const Passage& crease) {
    return crease.Carry({crease.from.axis, crease.angle_deg > 180 ? -crease.from.sign : crease.from.sign});
  }

  double CornerAngleDeg(int v, const Side& side) const {
    std::array<Eigen::Vector3d, 2> along;
    int count = 0;
    for (int k = 0; k < 4; ++k) {
      const int w = mesh_.tets[side.tet][k];
      if (k != side.corner && w != v) along[count++] = mesh_.points[w] - mesh_.points[v];
    }
    return std::atan2(along[0].cross(along[1]).norm(), along[0].dot(along[1])) * kDegreesPerRadian;
  }

  // The angle of the corner of a sheet that begins with the crease, if it is less than a right one and the conormals of
  // its two creases are opposite.
  std::optional<double> FlatAngleFrom(int v, const Passage& crease) const {
    constexpr double kRightAngleDeg = 90;
    std::pair<int, int> conormal = Conormal(crease);
    double angle = 0;
    for (Side side = crease.to;;) {
      angle += CornerAngleDeg(v, side);
      const Passage* next = Next(v, side);
      if (angle >= kRightAngleDeg || next == nullptr || next->kind == MeetingKind::kOpposite) return std::nullopt;
      if (next->kind == MeetingKind::kCrease) {
        if (!IsSharpCrease(*next)) return std::nullopt;
        const std::pair<int, int> last = Conormal(next->Reversed());
        if (last.first == conormal.first && last.second == -conormal.second) return angle;
        return std::nullopt;
      }
      conormal = next->Carry(conormal);
      side = next->to;
    }
  }

  // Along edges inside of sheets at which these bend by at least half of the corner's angle, and more than a surface
  // that is rough.
  std::vector<int> TraceBend(const BoundarySheets::FlatCorner& corner) const {
    constexpr double kLeastBendDeg = 20;
    const double least = std::max(corner.angle_deg / 2, kLeastBendDeg);
    std::vector<int> bend = {corner.vertex};
    for (std::size_t i = 0; i < bend.size(); ++i) {
      const int v = bend[i];
      for (auto p = passages_.lower_bound(Key(v, {-1, -1})); p != passages_.end() && p->first.first == v; ++p) {
        const Passage& passage = p->second;
        const bool bends = std::abs(passage.angle_deg - 180) >= least;
        if (passage.kind != MeetingKind::kSheet || !bends) continue;
        if (std::find(bend.begin(), bend.end(), passage.other) == bend.end()) bend.push_back(passage.other);
      }
    }
    return bend;
  }

  const TetMesh& mesh_;
  const std::vector<Face>& faces_;
  std::map<Key, Passage> passages_;
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
  const auto is_released = [&](int f) {
    const Face& face = result.faces[f];
    for (int k = 0; k < 4; ++k) {
      if (k != face.corner && released_vertices.count(mesh.tets[face.tet][k]) > 0) return true;
    }
    return false;
  };
  for (int f = 0; f < static_cast<int>(result.faces.size()); ++f) result.faces[f].is_released = is_released(f);
  std::vector<Meeting> meetings;
  std::vector<std::pair<std::size_t, Passage>> passages;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<Sector> sectors = SectorsOf(rings, r, is_face);
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      Sector sector = {rings, r, {}};
      // To the next face, and beyond it to others: a sheet may go on behind one that it meets.
      for (std::size_t j = i; j < sectors.size(); ++j) {
        sector.steps.insert(sector.steps.end(), sectors[j].steps.begin(), sectors[j].steps.end());
        const EdgeRings::Step &first = sector.first(), &last = sector.last();
        const int f = face_of[first.tet][first.in], g = face_of[last.tet][last.out];
        if (f == g || result.faces[f].is_released || result.faces[g].is_released) continue;
        const auto [axis, sign] = outward(first.tet, first.in);
        const auto [other_axis, other_sign] = outward(last.tet, last.out);
        // The first face's axis e_k becomes turn^T e_k in the last frame.
        const OctahedralRotation turn = sector.Turn(matched);
        MeetingKind kind = MeetingKind::kCrease;
        if (turn.axis[axis] == other_axis) {
          kind = turn.sign[axis] * sign == other_sign ? MeetingKind::kSheet : MeetingKind::kOpposite;
        }
        if (kind == MeetingKind::kSheet) sheets.Unite(f, g);
        if (j != i) continue;
        const double angle = sector.AngleDeg(mesh);
        if (kind == MeetingKind::kCrease) result.creases.push_back(rings.vertices[r]);
        if (kind == MeetingKind::kOpposite && angle < 180) meetings.push_back({rings.vertices[r], angle, {f, g}});
        passages.emplace_back(r, Passage{{first.tet, first.in, f, axis, sign},
                                         {last.tet, last.out, g, other_axis, other_sign},
                                         -1,
                                         turn,
                                         angle,
                                         kind});
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
    face.is_released = face.is_released || result.sheets[face.sheet].is_released;
  }
  FlatCornerFinder corners(mesh, result.faces);
  for (const auto& [ring, passage] : passages) corners.Add(rings.vertices[ring], passage);
  result.flat_corners = corners.Find();
  return result;
}

}  // namespace octupole
