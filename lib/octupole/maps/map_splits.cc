#include "octupole/maps/map_splits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "octupole/frames/frame.h"
#include "octupole/maps/internal/union_find.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

// Which vertices are on which sheets that are held flat, in ascending order.
class VertexSheets {
 public:
  VertexSheets(const TetMesh& mesh, const BoundarySheets& sheets) : sheets_(mesh.points.size()) {
    for (const BoundarySheets::Face& face : sheets.faces) {
      if (sheets.sheets[face.sheet].is_released) continue;
      for (int k = 0; k < 4; ++k) {
        if (k == face.corner) continue;
        std::vector<int>& list = sheets_[mesh.tets[face.tet][k]];
        const auto place = std::lower_bound(list.begin(), list.end(), face.sheet);
        if (place == list.end() || *place != face.sheet) list.insert(place, face.sheet);
      }
    }
  }

  bool ShareOne(const std::vector<int>& vertices) const {
    for (const int sheet : sheets_[vertices[0]]) {
      const bool all = std::all_of(vertices.begin() + 1, vertices.end(), [&](int v) {
        return std::binary_search(sheets_[v].begin(), sheets_[v].end(), sheet);
      });
      if (all) return true;
    }
    return false;
  }

 private:
  std::vector<std::vector<int>> sheets_;
};

// The frame between two, whichever way their axes are ordered and pointed.
Eigen::Matrix3d MeanFrame(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Octupole h = HarmonicFromFrame<3>(a), g = HarmonicFromFrame<3>(b);
  return NearestFrame<3>(h.dot(g) < 0 ? Octupole(h - g) : Octupole(h + g));
}

// Splits the edges and faces of a mesh one by one.
class Splitter {
 public:
  explicit Splitter(FramedMesh* framed) : framed_(*framed), tets_of_(framed->mesh.points.size()) {
    for (int t = 0; t < static_cast<int>(tets().size()); ++t) {
      for (const int v : tets()[t]) tets_of_[v].push_back(t);
    }
  }

  void SplitEdge(int a, int b) {
    std::vector<int> ring;
    for (const int t : tets_of_[a]) {
      const auto& tet = tets()[t];
      if (std::find(tet.begin(), tet.end(), b) != tet.end()) ring.push_back(t);
    }
    const int m =
        AddPoint((points()[a] + points()[b]) / 2, MeanFrame(framed_.point_frames[a], framed_.point_frames[b]));
    for (const int t : ring) {
      const int half = AddCopy(t);
      ReplaceCorner(half, a, m);
      ReplaceCorner(t, b, m);
      // Between them.
      MatchAt(half, b) = MatchAt(t, a) = 0;
    }
  }

  void SplitFace(int t, int s, const std::array<int, 3>& face) {
    const int m = AddPoint((points()[face[0]] + points()[face[1]] + points()[face[2]]) / 3, framed_.matched.frames[t]);
    for (const int whole : {t, s}) {
      const int one = AddCopy(whole), two = AddCopy(whole);
      ReplaceCorner(whole, face[0], m);
      ReplaceCorner(one, face[1], m);
      ReplaceCorner(two, face[2], m);
      MatchAt(whole, face[1]) = MatchAt(whole, face[2]) = MatchAt(one, face[0]) = MatchAt(one, face[2]) = 0;
      MatchAt(two, face[0]) = MatchAt(two, face[1]) = 0;
    }
  }

  /// Gives the tetrahedra left at v its frame; what they match across the faces opposite v is for Rematch.
  void SplitAround(int v) {
    std::vector<int> others;
    for (const int t : tets_of_[v]) {
      for (const int w : tets()[t]) {
        if (w != v && !IsNew(w)) others.push_back(w);
      }
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const int w : others) SplitEdge(v, w);
    for (const int t : tets_of_[v]) {
      framed_.matched.frames[t] = framed_.point_frames[v];
      framed_.matched.matches[t] = {};
      reframed_.emplace_back(t, v);
    }
  }

  /// Matches anew what SplitAround changed.
  void Rematch() {
    framed_.matched.neighbours = TetNeighbours(framed_.mesh);
    for (const auto& [t, v] : reframed_) {
      const int corner = CornerOf(tets()[t], v), s = framed_.matched.neighbours[t][corner];
      if (s < 0) continue;
      const auto& frames = framed_.matched.frames;
      framed_.matched.SetMatch(framed_.mesh, t, corner, MatchFrames(frames[t], frames[s]));
    }
  }

 private:
  std::uint8_t& MatchAt(int t, int opposite) { return framed_.matched.matches[t][CornerOf(tets()[t], opposite)]; }
  std::vector<Eigen::Vector3d>& points() { return framed_.mesh.points; }
  std::vector<std::array<int, 4>>& tets() { return framed_.mesh.tets; }
  bool IsNew(int v) const { return v >= num_old_points_; }

  int AddPoint(const Eigen::Vector3d& point, const Eigen::Matrix3d& frame) {
    points().push_back(point);
    framed_.point_frames.push_back(frame);
    tets_of_.emplace_back();
    return static_cast<int>(points().size()) - 1;
  }

  int AddCopy(int t) {
    const int copy = static_cast<int>(tets().size());
    const auto append_copy = [t](auto* values) {
      auto value = (*values)[t];
      values->push_back(std::move(value));
    };
    append_copy(&tets());
    append_copy(&framed_.matched.frames);
    append_copy(&framed_.matched.matches);
    append_copy(&framed_.parents);
    if (!framed_.mesh.regions.empty()) append_copy(&framed_.mesh.regions);
    for (const int v : tets()[copy]) tets_of_[v].push_back(copy);
    return copy;
  }

  void ReplaceCorner(int t, int from, int to) {
    tets()[t][CornerOf(tets()[t], from)] = to;
    std::vector<int>& list = tets_of_[from];
    *std::find(list.begin(), list.end(), t) = list.back();
    list.pop_back();
    tets_of_[to].push_back(t);
  }

  FramedMesh& framed_;
  const int num_old_points_ = static_cast<int>(framed_.mesh.points.size());
  std::vector<std::vector<int>> tets_of_;
  std::vector<std::pair<int, int>> reframed_;
};

// Regular edges with both ends on one connected part of the singular edges.
class SingularParts {
 public:
  SingularParts(std::size_t num_points, std::size_t num_rings, const std::vector<SingularEdge>& edges)
      : parts_(static_cast<int>(num_points)), is_singular_vertex_(num_points), is_singular_ring_(num_rings) {
    for (const SingularEdge& edge : edges) {
      const auto [a, b] = edge.vertices;
      parts_.Unite(a, b);
      is_singular_vertex_[a] = is_singular_vertex_[b] = is_singular_ring_[edge.ring] = true;
    }
  }

  bool IsShortcut(std::size_t ring, int a, int b) {
    return !is_singular_ring_[ring] && is_singular_vertex_[a] && is_singular_vertex_[b] &&
           parts_.Root(a) == parts_.Root(b);
  }

 private:
  internal::UnionFind parts_;
  std::vector<bool> is_singular_vertex_;
  std::vector<bool> is_singular_ring_;
};

// Whether a singular edge ends at a boundary face as on a plane across it: its axis is the outward one.
bool IsAcross(const MatchedFrames& matched, const EdgeRings& rings, const SingularEdge& edge,
              const BoundarySheets::Face& face) {
  if (edge.valence == 0) return false;
  const Eigen::Matrix3d& frame = matched.frames[rings.steps[rings.begin[edge.ring]].tet];
  const Eigen::Vector3d axis = frame * QuarterAxis(TurnAround(matched, rings, edge.ring));
  constexpr double kHalfRightAngle = 0.7071;
  return std::abs(axis.dot(matched.frames[face.tet].col(face.axis))) > kHalfRightAngle;
}

// The boundary vertices that singular edges touch.
std::vector<int> FindTouchedVertices(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                                     const std::vector<SingularEdge>& singular_edges, const BoundarySheets& sheets) {
  std::map<int, std::vector<const SingularEdge*>> edges_of;
  for (const SingularEdge& edge : singular_edges) {
    for (const int v : edge.vertices) edges_of[v].push_back(&edge);
  }
  std::vector<int> touched;
  for (const BoundarySheets::Face& face : sheets.faces) {
    if (sheets.sheets[face.sheet].is_released) continue;
    for (int k = 0; k < 4; ++k) {
      const auto edges = edges_of.find(mesh.tets[face.tet][k]);
      if (k == face.corner || edges == edges_of.end()) continue;
      const bool is_end = edges->second.size() == 1 && IsAcross(matched, rings, *edges->second[0], face);
      if (!is_end) touched.push_back(edges->first);
    }
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

// Takes shortcuts, one triangle after the other.
class Straightener {
 public:
  Straightener(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges, FramedMesh* framed)
      : rings_(rings), framed_(*framed) {
    for (const SingularEdge& edge : singular_edges) Add(edge.ring);
  }

  bool Run() {
    bool has_changed = ResolveTurns();
    while (!open_.empty()) {
      const int v = *open_.begin();
      open_.erase(open_.begin());
      while (StraightenAt(v)) has_changed = true;
    }
    return has_changed;
  }

 private:
  void Add(std::size_t ring) {
    for (const int v : rings_.vertices[ring]) {
      rings_of_[v].insert(ring);
      open_.insert(v);
    }
  }

  void Remove(std::size_t ring) {
    for (const int v : rings_.vertices[ring]) {
      rings_of_[v].erase(ring);
      open_.insert(v);
    }
  }

  bool StraightenAt(int v) {
    const std::set<std::size_t> rings = rings_of_[v];
    for (const std::size_t r : rings) {
      for (std::size_t i = rings_.begin[r]; i < rings_.begin[r + 1]; ++i) {
        const EdgeRings::Step& step = rings_.steps[i];
        const int across = framed_.mesh.tets[step.tet][step.in];  // with the edge, the face that is left
        const auto other = FindInnerRing(v, across);
        if (other && *other != r && rings.count(*other) > 0 && TakeShortcut(r, i, *other, OtherEnd(r, v), across)) {
          return true;
        }
      }
    }
    return false;
  }

  // Gives every edge of another turn than a quarter turn, where that can be, a quarter turn or none, at the cost of
  // quarter turns of the other two sides of a triangle at it.
  bool ResolveTurns() {
    std::set<std::size_t> others;
    for (const auto& [v, rings] : rings_of_) {
      for (const std::size_t r : rings) {
        if (!IsQuarterOrNone(r)) others.insert(r);
      }
    }
    bool has_changed = false;
    for (const std::size_t r : others) has_changed = (!IsQuarterOrNone(r) && ResolveTurn(r)) || has_changed;
    return has_changed;
  }

  bool ResolveTurn(std::size_t r) {
    const auto [a, b] = rings_.vertices[r];
    for (std::size_t i = rings_.begin[r]; i < rings_.begin[r + 1]; ++i) {
      const EdgeRings::Step& step = rings_.steps[i];
      const int c = framed_.mesh.tets[step.tet][step.in];
      const auto second = FindInnerRing(a, c), third = FindInnerRing(b, c);
      if (!second || !third) continue;
      const std::array<std::size_t, 3> sides = {r, *second, *third};
      const OctahedralRotation before = framed_.matched.match(step.tet, step.out);
      for (const OctahedralRotation& g : OctahedralGroup()) {
        framed_.matched.SetMatch(framed_.mesh, step.tet, step.out, before * g);
        if (!std::all_of(sides.begin(), sides.end(), [&](std::size_t side) { return IsQuarterOrNone(side); })) continue;
        for (const std::size_t side : sides) {
          Remove(side);
          if (IsSingular(side)) Add(side);
        }
        return true;
      }
      framed_.matched.SetMatch(framed_.mesh, step.tet, step.out, before);
    }
    return false;
  }

  int OtherEnd(std::size_t ring, int v) const {
    const auto [a, b] = rings_.vertices[ring];
    return a == v ? b : a;
  }

  std::optional<std::size_t> FindInnerRing(int a, int b) const {
    const std::array<int, 2> edge = {std::min(a, b), std::max(a, b)};
    const auto place = std::lower_bound(rings_.vertices.begin(), rings_.vertices.end(), edge);
    if (place == rings_.vertices.end() || *place != edge) return std::nullopt;
    const auto ring = static_cast<std::size_t>(place - rings_.vertices.begin());
    return rings_.is_closed[ring] ? std::optional(ring) : std::nullopt;
  }

  // Changes the match of the face that step i of ring r leaves by, so that r is regular; undoes it unless there are
  // less singular edges then.
  bool TakeShortcut(std::size_t r, std::size_t i, std::size_t second, int a, int c) {
    const auto third = FindInnerRing(a, c);
    if (!third) return false;
    const EdgeRings::Step& step = rings_.steps[i];
    const OctahedralRotation before = framed_.matched.match(step.tet, step.out);
    // The product around r from this step on is before * rest.
    OctahedralRotation rest;
    for (std::size_t j = i + 1; j < rings_.begin[r + 1]; ++j) rest = rest * MatchOf(j);
    for (std::size_t j = rings_.begin[r]; j < i; ++j) rest = rest * MatchOf(j);
    const bool was_singular = IsSingular(*third);
    framed_.matched.SetMatch(framed_.mesh, step.tet, step.out, rest.Inverse());
    const bool is_singular = IsSingular(*third);
    // Two quarter turns must not become one that is none.
    const bool is_worse = is_singular && !IsQuarterOrNone(*third);
    if (IsSingular(second) || is_worse) {
      framed_.matched.SetMatch(framed_.mesh, step.tet, step.out, before);
      return false;
    }
    Remove(r);
    Remove(second);
    if (was_singular && !is_singular) Remove(*third);
    if (!was_singular && is_singular) Add(*third);
    return true;
  }

  const OctahedralRotation& MatchOf(std::size_t step) const {
    return framed_.matched.match(rings_.steps[step].tet, rings_.steps[step].out);
  }

  bool IsSingular(std::size_t ring) const { return TurnAround(framed_.matched, rings_, ring) != OctahedralRotation(); }

  bool IsQuarterOrNone(std::size_t ring) const {
    const TurnType type = TypeOf(TurnAround(framed_.matched, rings_, ring));
    return type == TurnType::kNone || type == TurnType::kQuarter;
  }

  const EdgeRings& rings_;
  FramedMesh& framed_;
  std::map<int, std::set<std::size_t>> rings_of_;
  std::set<int> open_;
};

struct InnerFace {
  int t, s;
  std::array<int, 3> vertices;
};

// Inner faces with all corners on one sheet, at most one of each tetrahedron.
std::vector<InnerFace> FindFlatFaces(const TetMesh& mesh, const MatchedFrames& matched, const VertexSheets& sheets) {
  std::vector<InnerFace> faces;
  std::vector<bool> is_taken(mesh.tets.size(), false);
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = matched.neighbours[t][i];
      if (s < t || is_taken[s] || is_taken[t]) continue;
      const std::array<int, 4>& tet = mesh.tets[t];
      const std::array<int, 3> face = {tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]};
      if (!sheets.ShareOne({face[0], face[1], face[2]})) continue;
      is_taken[s] = is_taken[t] = true;
      faces.push_back({t, s, face});
    }
  }
  return faces;
}

}  // namespace

bool StraightenSingularEdges(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
                             FramedMesh* framed) {
  return Straightener(rings, singular_edges, framed).Run();
}

bool SplitForMap(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges, const BoundarySheets& sheets,
                 FramedMesh* framed) {
  const TetMesh& mesh = framed->mesh;
  const auto touched = FindTouchedVertices(mesh, framed->matched, rings, singular_edges, sheets);
  if (!touched.empty()) {
    Splitter splitter(framed);
    for (const int v : touched) splitter.SplitAround(v);
    splitter.Rematch();
    return true;
  }
  const VertexSheets vertex_sheets(mesh, sheets);
  SingularParts singular(mesh.points.size(), rings.size(), singular_edges);
  std::vector<std::array<int, 2>> edges;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto [a, b] = rings.vertices[r];
    if (rings.is_closed[r] && (vertex_sheets.ShareOne({a, b}) || singular.IsShortcut(r, a, b))) edges.push_back({a, b});
  }
  if (!edges.empty()) {
    Splitter splitter(framed);
    for (const auto& [a, b] : edges) splitter.SplitEdge(a, b);
    return true;
  }
  const auto faces = FindFlatFaces(mesh, framed->matched, vertex_sheets);
  if (faces.empty()) return false;
  Splitter splitter(framed);
  for (const InnerFace& face : faces) splitter.SplitFace(face.t, face.s, face.vertices);
  return true;
}

}  // namespace octupole
