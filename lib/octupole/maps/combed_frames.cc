#include "octupole/maps/combed_frames.h"

#include <stdexcept>
#include <string>

#include "octupole/harmonics/rotation.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

std::uint8_t ShortIndex(const OctahedralRotation& g) { return static_cast<std::uint8_t>(IndexOf(g)); }

}  // namespace

void MatchedFrames::SetMatch(const TetMesh& mesh, int tet, int corner, const OctahedralRotation& match) {
  matches[tet][corner] = ShortIndex(match);
  matches[neighbours[tet][corner]][CornerAcross(mesh, neighbours, tet, corner)] = ShortIndex(match.Inverse());
}

MatchedFrames MatchTets(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& tet_frames) {
  if (tet_frames.size() != mesh.tets.size()) {
    throw std::invalid_argument("MatchTets: " + std::to_string(tet_frames.size()) + " frames for " +
                                std::to_string(mesh.tets.size()) + " tetrahedra");
  }
  for (const Eigen::Matrix3d& frame : tet_frames) CheckRotation("MatchTets", frame);
  MatchedFrames matched;
  matched.neighbours = TetNeighbours(mesh);
  matched.frames = tet_frames;
  matched.matches.assign(mesh.tets.size(), {});
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = matched.neighbours[t][i];
      if (s > t) matched.SetMatch(mesh, t, i, MatchFrames(matched.frames[t], matched.frames[s]));
    }
  }
  return matched;
}

CombedFrames CombFrames(const TetMesh& mesh, const MatchedFrames& matched) {
  const int num_tets = static_cast<int>(mesh.tets.size());
  CombedFrames combed;
  static_cast<MatchedFrames&>(combed) = matched;
  combed.is_in_tree.assign(num_tets, {});
  combed.component.assign(num_tets, -1);
  std::vector<int> queue;
  queue.reserve(num_tets);
  std::vector<OctahedralRotation> renamed(num_tets);  // the new frame is the old one times this
  for (int root = 0; root < num_tets; ++root) {
    if (combed.component[root] >= 0) continue;
    std::size_t next = queue.size();
    queue.push_back(root);
    combed.component[root] = combed.num_components;
    for (; next < queue.size(); ++next) {
      const int t = queue[next];
      for (int i = 0; i < 4; ++i) {
        const int s = combed.neighbours[t][i];
        if (s < 0 || combed.component[s] >= 0) continue;
        combed.component[s] = combed.num_components;
        // F_t g ~ F_s, so F_t r ~ F_s g^-1 r.
        renamed[s] = matched.match(t, i).Inverse() * renamed[t];
        combed.frames[s] *= renamed[s].matrix();
        combed.is_in_tree[t][i] = combed.is_in_tree[s][CornerAcross(mesh, combed.neighbours, t, i)] = true;
        queue.push_back(s);
      }
    }
    ++combed.num_components;
  }
  for (int t = 0; t < num_tets; ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = combed.neighbours[t][i];
      if (s < t) continue;
      const OctahedralRotation g = renamed[t].Inverse() * matched.match(t, i) * renamed[s];
      if (g != matched.match(t, i)) combed.SetMatch(mesh, t, i, g);
    }
  }
  return combed;
}

}  // namespace octupole
