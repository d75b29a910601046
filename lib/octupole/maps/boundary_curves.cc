#include "octupole/maps/boundary_curves.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace octupole {
namespace {

class CurveTaker {
 public:
  CurveTaker(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges, const BoundarySheets& sheets,
             bool are_nodes_final, FramedMesh* framed)
      : rings_(rings),
        framed_(*framed),
        are_nodes_final_(are_nodes_final),
        edges_(singular_edges),
        is_singular_(rings.size(), false) {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      is_singular_[edges_[i].ring] = true;
      for (const int v : edges_[i].vertices) edges_of_[v].push_back(i);
    }
    for (std::size_t f = 0; f < sheets.faces.size(); ++f) {
      const BoundarySheets::Face& face = sheets.faces[f];
      if (framed_.matched.neighbours[face.tet][face.corner] >= 0) continue;  // an interface
      for (int k = 0; k < 4; ++k) {
        const int v = framed_.mesh.tets[face.tet][k];
        if (k != face.corner && edges_of_.count(v) > 0) faces_at_[v].push_back(&face);
      }
    }
  }

  bool Run() {
    std::vector<bool> is_done(edges_.size(), false);
    bool has_changed = false;
    for (const auto& [v, edges] : edges_of_) {
      if (edges.size() != 1) continue;
      if (const std::optional<int> end = FindBackwardEnd(v)) {
        framed_.released_vertices.insert(*end);
        has_changed = true;
      }
      if (is_done[edges[0]] || !EndsAlong(v)) continue;
      const std::vector<int> curve = Trace(v, &is_done);
      const bool ends_at_node = faces_at_.count(curve.back()) == 0;
      if (!ends_at_node && Take(curve)) {
        has_changed = true;
        continue;
      }
      if (ends_at_node && !are_nodes_final_) continue;
      for (const int end : {v, curve.back()}) {
        if (edges_of_.at(end).size() == 1 && EndsAlong(end)) framed_.released_vertices.insert(end);
      }
      has_changed = true;
    }
    return has_changed;
  }

 private:
  // Whether the one singular edge at v ends on the boundary, but on none of its faces as on a plane across it.
  bool EndsAlong(int v) const {
    const auto faces = faces_at_.find(v);
    if (faces == faces_at_.end() || framed_.released_vertices.count(v) > 0) return false;
    const auto axes = CarryAxis(framed_.mesh, framed_.matched, rings_, edges_[edges_of_.at(v)[0]], v);
    return !axes.empty() && std::none_of(faces->second.begin(), faces->second.end(), [&](const auto* face) {
      const auto axis = axes.find(face->tet);
      return axis == axes.end() || axis->second == face->axis;
    });
  }

  // Whether the one singular edge at v ends on the boundary as on a plane across it.
  bool EndsAcross(int v) const {
    return faces_at_.count(v) > 0 && framed_.released_vertices.count(v) == 0 && !EndsAlong(v);
  }

  // Of a curve that begins at v and ends so, too, but with the other valence, the end of the valence that it has for a
  // small part of its length only.
  std::optional<int> FindBackwardEnd(int v) const {
    if (!EndsAcross(v)) return std::nullopt;
    const int valence = edges_[edges_of_.at(v)[0]].valence;
    double length = 0, opposite_length = 0;
    int last = v, last_valence = valence;
    Walk(v, [&](std::size_t i, int end) {
      const auto [a, b] = edges_[i].vertices;
      last = end;
      last_valence = edges_[i].valence;
      const double more = (framed_.mesh.points[a] - framed_.mesh.points[b]).norm();
      if (last_valence == valence) length += more;
      if (last_valence == 8 - valence) opposite_length += more;
    });
    if (edges_of_.at(last).size() != 1 || last_valence != 8 - valence || !EndsAcross(last)) return std::nullopt;
    constexpr double kSmallPart = 0.05;
    if (length < kSmallPart * opposite_length) return v;
    if (opposite_length < kSmallPart * length) return last;
    return std::nullopt;
  }

  // Calls use(edge, its farther vertex) along the curve that begins at v, up to its end or a node.
  template <typename Use>
  void Walk(int v, const Use& use) const {
    for (std::size_t i = edges_of_.at(v)[0];;) {
      const auto [a, b] = edges_[i].vertices;
      v = v == a ? b : a;
      use(i, v);
      const std::vector<std::size_t>& there = edges_of_.at(v);
      if (there.size() != 2) return;
      i = there[0] == i ? there[1] : there[0];
    }
  }

  // The vertices of the curve that begins at v, up to its end or a node.
  std::vector<int> Trace(int v, std::vector<bool>* is_done) const {
    std::vector<int> curve = {v};
    Walk(v, [&](std::size_t i, int end) {
      (*is_done)[i] = true;
      curve.push_back(end);
    });
    return curve;
  }

  std::optional<std::size_t> FindRing(int a, int b) const {
    const std::array<int, 2> edge = {std::min(a, b), std::max(a, b)};
    const auto place = std::lower_bound(rings_.vertices.begin(), rings_.vertices.end(), edge);
    if (place == rings_.vertices.end() || *place != edge) return std::nullopt;
    return static_cast<std::size_t>(place - rings_.vertices.begin());
  }

  // The step of the closed ring of edge (a, b) that leaves by the face with c, if there is one.
  std::optional<std::size_t> FindFace(int a, int b, int c) const {
    const auto ring = FindRing(a, b);
    if (!ring || !rings_.is_closed[*ring]) return std::nullopt;
    for (std::size_t i = rings_.begin[*ring]; i < rings_.begin[*ring + 1]; ++i) {
      if (framed_.mesh.tets[rings_.steps[i].tet][rings_.steps[i].in] == c) return i;
    }
    return std::nullopt;
  }

  bool IsOuter(int a, int b) const {
    const auto ring = FindRing(a, b);
    return ring && !rings_.is_closed[*ring];
  }

  // A curve on its way to the boundary: all before its vertex `next` has become edges of the boundary up to the vertex
  // `outer`, and the edge between the two is singular instead.
  struct State {
    std::size_t next;
    int outer;
    bool operator<(const State& other) const { return std::tie(next, outer) < std::tie(other.next, other.outer); }
  };

  // Faces to change the matches of, each with an edge that becomes regular thereby: the shortest way along the
  // boundary.
  bool Take(const std::vector<int>& curve) {
    struct Arrival {
      double length;
      State from;
      std::array<int, 3> face;  // all 0 where none is needed
    };
    std::map<State, Arrival> arrivals;
    std::set<State> settled;
    using Entry = std::pair<double, State>;
    const auto is_later = [](const Entry& a, const Entry& b) { return b.first < a.first; };
    std::priority_queue<Entry, std::vector<Entry>, decltype(is_later)> queue(is_later);
    const State first = {1, curve[0]};
    arrivals[first] = {0, first, {}};
    queue.emplace(0, first);
    const auto& points = framed_.mesh.points;
    std::optional<State> last;
    while (!queue.empty()) {
      const auto [length, state] = queue.top();
      queue.pop();
      if (!settled.insert(state).second) continue;
      const int inner = curve[state.next];
      const auto offer = [&, length = length, state = state](const State& to, double more,
                                                             const std::array<int, 3>& face) {
        const auto [place, is_new] = arrivals.emplace(to, Arrival{length + more, state, face});
        if (!is_new && place->second.length <= length + more) return;
        place->second = {length + more, state, face};
        queue.emplace(length + more, to);
      };
      if (IsOuter(state.outer, inner)) {
        if (state.next + 1 == curve.size()) {
          last = state;
          break;
        }
        offer({state.next + 1, inner}, 0, {});
        continue;
      }
      if (state.next + 1 < curve.size()) {
        const int beyond = curve[state.next + 1];
        if (FindFace(state.outer, inner, beyond)) {
          offer({state.next + 1, state.outer}, 0, {state.outer, inner, beyond});
        }
      }
      const auto ring = FindRing(state.outer, inner);
      for (std::size_t i = rings_.begin[*ring]; i < rings_.begin[*ring + 1]; ++i) {
        const int c = framed_.mesh.tets[rings_.steps[i].tet][rings_.steps[i].in];
        const auto across = FindRing(inner, c);
        if (!IsOuter(state.outer, c) || is_singular_[*across]) continue;
        offer({state.next, c}, (points[c] - points[state.outer]).norm(), {state.outer, inner, c});
      }
    }
    if (!last) return false;
    std::vector<std::array<int, 3>> faces;
    for (State state = *last; !(state.next == 1 && state.outer == curve[0]); state = arrivals[state].from) {
      if (arrivals[state].face != std::array<int, 3>{}) faces.push_back(arrivals[state].face);
    }
    for (auto face = faces.rbegin(); face != faces.rend(); ++face) MakeRegular((*face)[0], (*face)[1], (*face)[2]);
    return true;
  }

  // Changes the match of the face (a, b, c) so that the edge (a, b) is regular.
  void MakeRegular(int a, int b, int c) {
    const std::size_t ring = *FindRing(a, b), i = *FindFace(a, b, c);
    OctahedralRotation rest;  // the product around the ring from this step on is match * rest
    for (std::size_t j = i + 1; j < rings_.begin[ring + 1]; ++j) rest = rest * MatchOf(j);
    for (std::size_t j = rings_.begin[ring]; j < i; ++j) rest = rest * MatchOf(j);
    framed_.matched.SetMatch(framed_.mesh, rings_.steps[i].tet, rings_.steps[i].out, rest.Inverse());
  }

  const OctahedralRotation& MatchOf(std::size_t step) const {
    return framed_.matched.match(rings_.steps[step].tet, rings_.steps[step].out);
  }

  const EdgeRings& rings_;
  FramedMesh& framed_;
  const bool are_nodes_final_;
  const std::vector<SingularEdge>& edges_;
  std::vector<bool> is_singular_;
  std::map<int, std::vector<std::size_t>> edges_of_;
  std::map<int, std::vector<const BoundarySheets::Face*>> faces_at_;
};

}  // namespace

bool TakeCurvesToBoundary(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
                          const BoundarySheets& sheets, bool are_nodes_final, FramedMesh* framed) {
  return CurveTaker(rings, singular_edges, sheets, are_nodes_final, framed).Run();
}

}  // namespace octupole
