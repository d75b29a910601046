#include "octupole/mesh/edge_rings.h"

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

using Step = EdgeRings::Step;
using Tets = std::vector<std::array<int, 4>>;

// The step through a tetrahedron by the right hand about the edge from a to b.
Step StepThrough(const TetMesh& mesh, int tet, int a, int b) {
  // The other two corners, in the order that makes an even permutation of a, b, in, out; the face opposite `out` is the
  // one that the ring enters by.
  constexpr std::int8_t kOthers[4][4][2] = {{{}, {2, 3}, {3, 1}, {1, 2}},
                                            {{3, 2}, {}, {0, 3}, {2, 0}},
                                            {{1, 3}, {3, 0}, {}, {0, 1}},
                                            {{2, 1}, {0, 2}, {1, 0}, {}}};
  const auto& others = kOthers[CornerOf(mesh.tets[tet], a)][CornerOf(mesh.tets[tet], b)];
  return {tet, others[1], others[0]};
}

// The step that leaves through the face by which that step entered, for walking back.
Step Reversed(const Step& step) { return {step.tet, step.out, step.in}; }

class Walker {
 public:
  Walker(const TetMesh& mesh, const Tets& neighbours) : mesh_(mesh), neighbours_(neighbours) {}

  /// Steps on through step->out; false at the boundary.
  bool Next(Step* step) const {
    const int next = neighbours_[step->tet][step->out];
    if (next < 0) return false;
    // The corner opposite the face that is left is the next one's, and the corner opposite the face that was entered
    // is not: it turns into the next one's opposite corner of its new face.
    const std::array<int, 4>&tet = mesh_.tets[step->tet], &next_tet = mesh_.tets[next];
    const int pivot = CornerOf(next_tet, tet[step->in]);  // stays on the face that is crossed
    int entered = 0;
    for (int i = 0; i < 4; ++i) {
      if (neighbours_[next][i] == step->tet && IsShared(tet, next_tet, i, step->out)) entered = i;
    }
    *step = {next, static_cast<std::int8_t>(entered), static_cast<std::int8_t>(pivot)};
    return true;
  }

 private:
  // Whether the face opposite corner i of `next` is the face opposite corner `out` of `tet`.
  static bool IsShared(const std::array<int, 4>& tet, const std::array<int, 4>& next, int i, int out) {
    for (int k = 0; k < 4; ++k) {
      if (k != out && tet[k] == next[i]) return false;
    }
    return true;
  }

  const TetMesh& mesh_;
  const Tets& neighbours_;
};

}  // namespace

EdgeRings FindEdgeRings(const TetMesh& mesh, const Tets& neighbours) {
  const auto sorted = internal::SortedSimplices(mesh.tets, internal::kTetEdges, mesh.points.size());
  const Walker walker(mesh, neighbours);
  EdgeRings rings;
  rings.steps.reserve(sorted.size());
  std::vector<int> visited;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    const auto [a, b] = sorted[begin].vertices;
    while (end < sorted.size() && sorted[end].vertices == sorted[begin].vertices) ++end;
    visited.clear();
    for (std::size_t i = begin; i < end && visited.size() < end - begin; ++i) {
      bool is_new = true;
      for (const int tet : visited) is_new = is_new && tet != sorted[i].cell;
      if (!is_new) continue;
      // Back to the boundary, or all around.
      const Step first = StepThrough(mesh, sorted[i].cell, a, b);
      Step back = Reversed(first);
      bool is_closed = false;
      while (!is_closed && walker.Next(&back)) is_closed = back.tet == first.tet;
      Step step = is_closed ? first : Reversed(back);
      const int start = step.tet;
      rings.vertices.push_back({a, b});
      rings.is_closed.push_back(is_closed);
      rings.begin.push_back(rings.steps.size());
      do {
        rings.steps.push_back(step);
        visited.push_back(step.tet);
      } while (walker.Next(&step) && step.tet != start);
    }
  }
  rings.begin.push_back(rings.steps.size());
  return rings;
}

}  // namespace octupole
