#include "octupole/maps/edge_turns.h"

namespace octupole {
namespace {

// A frame that goes along unchanged but for what matching asks of it is F g^T when it comes back to F.
int ValenceOf(const Eigen::Matrix3d& frame, const Eigen::Vector3d& edge, const OctahedralRotation& g) {
  return edge.dot(frame * QuarterAxis(g.Inverse())) > 0 ? 3 : 5;
}

}  // namespace

Eigen::Vector3d QuarterAxis(const OctahedralRotation& turn) {
  const Eigen::Matrix3d m = turn.matrix();
  return 0.5 * Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

OctahedralRotation TurnAround(const MatchedFrames& matched, const EdgeRings& rings, std::size_t ring) {
  OctahedralRotation turn;
  const std::size_t end = rings.begin[ring + 1] - (rings.is_closed[ring] ? 0 : 1);
  for (std::size_t i = rings.begin[ring]; i < end; ++i) {
    const EdgeRings::Step& step = rings.steps[i];
    if (matched.matches[step.tet][step.out] != 0) turn = turn * matched.match(step.tet, step.out);
  }
  return turn;
}

std::vector<SingularEdge> FindSingularEdges(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings) {
  std::vector<SingularEdge> edges;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!rings.is_closed[r]) continue;
    const OctahedralRotation turn = TurnAround(matched, rings, r);
    if (turn == OctahedralRotation()) continue;
    const auto [a, b] = rings.vertices[r];
    const TurnType type = TypeOf(turn);
    const Eigen::Matrix3d& frame = matched.frames[rings.steps[rings.begin[r]].tet];
    const int valence = type == TurnType::kQuarter ? ValenceOf(frame, mesh.points[b] - mesh.points[a], turn) : 0;
    edges.push_back({{a, b}, r, type, valence});
  }
  return edges;
}

std::map<int, int> CarryAxis(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                             const SingularEdge& edge, int v) {
  std::map<int, int> axis_in;
  if (edge.valence == 0) return axis_in;
  const int first = rings.steps[rings.begin[edge.ring]].tet;
  QuarterAxis(TurnAround(matched, rings, edge.ring)).cwiseAbs().maxCoeff(&axis_in[first]);
  std::vector<int> queue = {first};
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int t = queue[next];
    for (int i = 0; i < 4; ++i) {
      const int s = matched.neighbours[t][i];
      if (s < 0 || mesh.tets[t][i] == v || axis_in.count(s) > 0) continue;
      axis_in[s] = matched.match(t, i).axis[axis_in[t]];
      queue.push_back(s);
    }
  }
  return axis_in;
}

}  // namespace octupole
