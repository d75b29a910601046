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

using Edge = std::array<int, 2>;

Edge Sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Which vertices and edges are on which sheets that are held flat, in ascending order.
class SheetsAt {
 public:
  SheetsAt(const TetMesh& mesh, const BoundarySheets& sheets) : of_vertex_(mesh.points.size()) {
    for (const BoundarySheets::Face& face : sheets.faces) {
      if (face.is_released) continue;
      for (int k = 0; k < 4; ++k) {
        if (k == face.corner) continue;
        std::vector<int>& list = of_vertex_[mesh.tets[face.tet][k]];
        const auto place = std::lower_bound(list.begin(), list.end(), face.sheet);
        if (place == list.end() || *place != face.sheet) list.insert(place, face.sheet);
      }
      for (int k = 0; k < 4; ++k) {
        for (int l = 0; l < k; ++l) {
          if (k != face.corner && l != face.corner) {
            in_edge_.insert({Sorted(mesh.tets[face.tet][k], mesh.tets[face.tet][l]), face.sheet});
          }
        }
      }
      faces_.insert(SortedFace(mesh.tets[face.tet], face.corner));
    }
  }

  // Whether an edge has both ends on a sheet without lying in it.
  bool IsChord(int a, int b) const {
    for (const int sheet : of_vertex_[a]) {
      if (IsOn(b, sheet) && in_edge_.count({Sorted(a, b), sheet}) == 0) return true;
    }
    return false;
  }

  // Whether a face has all corners on a sheet, but is none of it.
  bool IsFlatFace(const std::array<int, 4>& tet, int corner) const {
    const std::array<int, 3> face = SortedFace(tet, corner);
    for (const int sheet : of_vertex_[face[0]]) {
      if (IsOn(face[1], sheet) && IsOn(face[2], sheet) && faces_.count(face) == 0) return true;
    }
    return false;
  }

 private:
  static std::array<int, 3> SortedFace(const std::array<int, 4>& tet, int corner) {
    std::array<int, 3> face = {tet[(corner + 1) % 4], tet[(corner + 2) % 4], tet[(corner + 3) % 4]};
    std::sort(face.begin(), face.end());
    return face;
  }

  bool IsOn(int v, int sheet) const { return std::binary_search(of_vertex_[v].begin(), of_vertex_[v].end(), sheet); }

  std::vector<std::vector<int>> of_vertex_;
  std::set<std::pair<Edge, int>> in_edge_;
  std::set<std::array<int, 3>> faces_;
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
    for (const auto& [a, b] : framed_.mesh.feature_edges) features_.insert(Sorted(a, b));
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
      JoinAt(half, b);
      JoinAt(t, a);
    }
    if (features_.erase(Sorted(a, b)) == 0) return;
    features_.insert(Sorted(a, m));
    features_.insert(Sorted(b, m));
  }

  void SplitFace(int t, int s, const std::array<int, 3>& face) {
    const int m = AddPoint((points()[face[0]] + points()[face[1]] + points()[face[2]]) / 3, framed_.matched.frames[t]);
    for (const int whole : {t, s}) {
      const int one = AddCopy(whole), two = AddCopy(whole);
      ReplaceCorner(whole, face[0], m);
      ReplaceCorner(one, face[1], m);
      ReplaceCorner(two, face[2], m);
      for (const auto& [tet, own] : {std::pair(whole, 0), std::pair(one, 1), std::pair(two, 2)}) {
        for (int k = 0; k < 3; ++k) {
          if (k != own) JoinAt(tet, face[k]);
        }
      }
    }
  }

  /// Gives the tetrahedra left at v its frame; what they match across the faces opposite v is for Finish.
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

  /// Matches anew what SplitAround changed, and hands the features back.
  void Finish() {
    framed_.mesh.feature_edges.assign(features_.begin(), features_.end());
    if (reframed_.empty()) return;
    framed_.matched.neighbours = TetNeighbours(framed_.mesh);
    for (const auto& [t, v] : reframed_) {
      const int corner = CornerOf(tets()[t], v), s = framed_.matched.neighbours[t][corner];
      if (s < 0) continue;
      const auto& frames = framed_.matched.frames;
      framed_.matched.SetMatch(framed_.mesh, t, corner, MatchFrames(frames[t], frames[s]));
    }
  }

 private:
  // A face between parts of one tetrahedron.
  void JoinAt(int t, int opposite) {
    const int corner = CornerOf(tets()[t], opposite);
    framed_.matched.matches[t][corner] = 0;
    framed_.is_interface[t][corner] = false;
  }

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
    append_copy(&framed_.is_interface);
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
  std::set<Edge> features_;
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

// Features and creases as lines on which two parameters are constant: those of feature edges that go straight on into
// each other, by less than 45 degrees, and of two creases that meet at a vertex where there is no third one.
class FeatureLines {
 public:
  FeatureLines(const TetMesh& mesh, const std::vector<Edge>& creases)
      : lines_(static_cast<int>(mesh.feature_edges.size() + creases.size())) {
    std::vector<Edge> all = mesh.feature_edges;
    all.insert(all.end(), creases.begin(), creases.end());
    const int num_features = static_cast<int>(mesh.feature_edges.size());
    std::map<int, std::vector<int>> creases_of;
    std::map<Edge, int> first;
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
      const auto [a, b] = all[i];
      edges_.insert(Sorted(a, b));
      const auto [place, is_new] = first.emplace(Sorted(a, b), i);
      if (!is_new) lines_.Unite(place->second, i);
      for (const int v : {a, b}) {
        edges_of_[v].push_back(i);
        if (i >= num_features) creases_of[v].push_back(i);
      }
    }
    for (const auto& [v, edges] : creases_of) {
      if (edges.size() == 2) lines_.Unite(edges[0], edges[1]);
    }
    for (const auto& [v, edges] : edges_of_) {
      const auto direction = [&mesh, &all, v = v](int edge) -> Eigen::Vector3d {
        const auto [a, b] = all[edge];
        return (mesh.points[a == v ? b : a] - mesh.points[v]).normalized();
      };
      for (const int i : edges) {
        for (const int j : edges) {
          constexpr double kHalfRightAngle = 0.7071;
          if (i < num_features && j < num_features && direction(i).dot(direction(j)) < -kHalfRightAngle) {
            lines_.Unite(i, j);
          }
        }
      }
    }
  }

  // Whether an edge that is none of them has both ends on one line.
  bool IsChord(int a, int b) {
    const auto at_a = edges_of_.find(a), at_b = edges_of_.find(b);
    if (at_a == edges_of_.end() || at_b == edges_of_.end() || edges_.count(Sorted(a, b)) > 0) return false;
    for (const int i : at_a->second) {
      for (const int j : at_b->second) {
        if (lines_.Root(i) == lines_.Root(j)) return true;
      }
    }
    return false;
  }

 private:
  internal::UnionFind lines_;
  std::set<Edge> edges_;
  std::map<int, std::vector<int>> edges_of_;
};

// The boundary vertices that singular edges touch, not to end there as on a plane across: with the outward axis.
std::vector<int> FindTouchedVertices(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                                     const std::vector<SingularEdge>& singular_edges, const BoundarySheets& sheets) {
  std::map<int, std::vector<const SingularEdge*>> edges_of;
  for (const SingularEdge& edge : singular_edges) {
    for (const int v : edge.vertices) edges_of[v].push_back(&edge);
  }
  std::map<int, std::map<int, int>> axes_at;
  std::set<int> touched;
  for (const BoundarySheets::Face& face : sheets.faces) {
    if (face.is_released) continue;
    for (int k = 0; k < 4; ++k) {
      const int v = mesh.tets[face.tet][k];
      const auto edges = edges_of.find(v);
      if (k == face.corner || edges == edges_of.end() || touched.count(v) > 0) continue;
      // A curve may go on behind an interface.
      const bool is_inside = matched.neighbours[face.tet][face.corner] >= 0;
      if (edges->second.size() > (is_inside ? 2 : 1)) {
        touched.insert(v);
        continue;
      }
      const auto [axes, is_new] = axes_at.emplace(v, std::map<int, int>());
      if (is_new) axes->second = CarryAxis(mesh, matched, rings, *edges->second[0], v);
      const auto axis = axes->second.find(face.tet);
      if (axis == axes->second.end() || axis->second != face.axis) touched.insert(v);
    }
  }
  return {touched.begin(), touched.end()};
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
std::vector<InnerFace> FindFlatFaces(const TetMesh& mesh, const MatchedFrames& matched, const SheetsAt& sheets) {
  std::vector<InnerFace> faces;
  std::vector<bool> is_taken(mesh.tets.size(), false);
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = matched.neighbours[t][i];
      if (s < t || is_taken[s] || is_taken[t]) continue;
      const std::array<int, 4>& tet = mesh.tets[t];
      const std::array<int, 3> face = {tet[(i + 1) % 4], tet[(i + 2) % 4], tet[(i + 3) % 4]};
      if (!sheets.IsFlatFace(tet, i)) continue;
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
  Splitter splitter(framed);
  if (!touched.empty()) {
    for (const int v : touched) splitter.SplitAround(v);
    splitter.Finish();
    return true;
  }
  const SheetsAt sheets_at(mesh, sheets);
  SingularParts singular(mesh.points.size(), rings.size(), singular_edges);
  FeatureLines lines(mesh, sheets.creases);
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto [a, b] = rings.vertices[r];
    const bool is_chord = sheets_at.IsChord(a, b) || lines.IsChord(a, b);
    if (is_chord || (rings.is_closed[r] && singular.IsShortcut(r, a, b))) edges.push_back(Sorted(a, b));
  }
  // Where the boundary touches itself an edge has several rings.
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto faces = edges.empty() ? FindFlatFaces(mesh, framed->matched, sheets_at) : std::vector<InnerFace>();
  for (const auto& [a, b] : edges) splitter.SplitEdge(a, b);
  for (const InnerFace& face : faces) splitter.SplitFace(face.t, face.s, face.vertices);
  splitter.Finish();
  return !edges.empty() || !faces.empty();
}

bool SplitTets(const std::vector<int>& tets, const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
               const BoundarySheets& sheets, FramedMesh* framed) {
  const TetMesh& mesh = framed->mesh;
  std::set<Edge> kept(mesh.feature_edges.begin(), mesh.feature_edges.end());
  for (const SingularEdge& edge : singular_edges) kept.insert(Sorted(edge.vertices[0], edge.vertices[1]));
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!rings.is_closed[r]) kept.insert(Sorted(rings.vertices[r][0], rings.vertices[r][1]));
  }
  for (const BoundarySheets::Face& face : sheets.faces) {
    const std::array<int, 4>& tet = mesh.tets[face.tet];
    for (int k = 1; k < 4; ++k) kept.insert(Sorted(tet[(face.corner + k) % 4], tet[(face.corner + k % 3 + 1) % 4]));
  }
  std::set<Edge> edges;
  for (const int t : tets) {
    std::optional<Edge> longest;
    const auto length = [&](const Edge& edge) { return (mesh.points[edge[0]] - mesh.points[edge[1]]).norm(); };
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        const Edge edge = Sorted(mesh.tets[t][i], mesh.tets[t][j]);
        if (kept.count(edge) == 0 && (!longest || length(edge) > length(*longest))) longest = edge;
      }
    }
    if (longest) edges.insert(*longest);
  }
  Splitter splitter(framed);
  for (const auto& [a, b] : edges) splitter.SplitEdge(a, b);
  splitter.Finish();
  return !edges.empty();
}

}  // namespace octupole
