#include "octupole/maps/map_cut.h"

#include <utility>

#include "octupole/maps/edge_turns.h"
#include "octupole/maps/internal/union_find.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

// Inner faces, each with one number for both of its sides.
class Faces {
 public:
  Faces(const TetMesh& mesh, const CombedFrames& combed) : number_(mesh.tets.size(), {-1, -1, -1, -1}) {
    for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
      for (int i = 0; i < 4; ++i) {
        const int s = combed.neighbours[t][i];
        if (s < t) continue;
        number_[t][i] = static_cast<int>(sides_.size());
        for (int j = 0; j < 4; ++j) {
          if (combed.neighbours[s][j] == t && SharesFace(mesh.tets[t], i, mesh.tets[s], j)) number_[s][j] = size();
        }
        sides_.push_back({t, i});
      }
    }
  }

  int size() const { return static_cast<int>(sides_.size()); }
  int number(int tet, int corner) const { return number_[tet][corner]; }
  /// The tetrahedron of the smaller index, and its corner opposite.
  std::pair<int, int> side(int face) const { return sides_[face]; }

 private:
  static bool SharesFace(const std::array<int, 4>& t, int i, const std::array<int, 4>& s, int j) {
    for (int k = 0; k < 4; ++k) {
      if (k != i && t[k] == s[j]) return false;
    }
    return true;
  }

  std::vector<std::array<int, 4>> number_;
  std::vector<std::pair<int, int>> sides_;
};

// Which faces are cut.
std::vector<bool> FindCutFaces(const CombedFrames& combed, const EdgeRings& rings, const Faces& faces) {
  std::vector<bool> is_cut(faces.size());
  for (int f = 0; f < faces.size(); ++f) {
    const auto [tet, corner] = faces.side(f);
    is_cut[f] = !combed.is_in_tree[tet][corner];
  }
  // The closed rings of each face, of which it has at most three.
  std::vector<std::array<int, 3>> rings_of_face(faces.size(), {-1, -1, -1});
  std::vector<int> num_cut(rings.size(), 0);
  std::vector<std::size_t> queue;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!rings.is_closed[r]) continue;
    for (std::size_t i = rings.begin[r]; i < rings.begin[r + 1]; ++i) {
      const int f = faces.number(rings.steps[i].tet, rings.steps[i].out);
      num_cut[r] += is_cut[f];
      int slot = 0;
      while (rings_of_face[f][slot] >= 0) ++slot;
      rings_of_face[f][slot] = static_cast<int>(r);
    }
    if (num_cut[r] == 1) queue.push_back(r);
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::size_t r = queue[next];
    if (num_cut[r] != 1 || TurnAround(combed, rings, r) != OctahedralRotation()) continue;
    for (std::size_t i = rings.begin[r]; i < rings.begin[r + 1]; ++i) {
      const int f = faces.number(rings.steps[i].tet, rings.steps[i].out);
      if (!is_cut[f]) continue;
      is_cut[f] = false;
      for (const int ring : rings_of_face[f]) {
        if (ring >= 0 && --num_cut[ring] == 1) queue.push_back(ring);
      }
      break;
    }
  }
  return is_cut;
}

// Two cut faces with a regular edge between them that has no third one are of one patch; the parity says whether the
// sides of the smaller index are on one side of it.
internal::UnionFind JoinPatches(const CombedFrames& combed, const EdgeRings& rings, const Faces& faces,
                                const std::vector<bool>& is_cut) {
  internal::UnionFind patches(faces.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!rings.is_closed[r]) continue;
    std::array<int, 2> cut = {-1, -1};
    std::array<bool, 2> is_forward = {};
    int count = 0;
    for (std::size_t i = rings.begin[r]; i < rings.begin[r + 1]; ++i) {
      const EdgeRings::Step& step = rings.steps[i];
      const int f = faces.number(step.tet, step.out);
      if (!is_cut[f]) continue;
      if (count < 2) {
        cut[count] = f;
        is_forward[count] = faces.side(f) == std::pair(step.tet, static_cast<int>(step.out));
      }
      ++count;
    }
    if (count != 2 || TurnAround(combed, rings, r) != OctahedralRotation()) continue;
    patches.Unite(cut[0], cut[1], is_forward[0] == is_forward[1]);
  }
  return patches;
}

void NumberNodes(const TetMesh& mesh, const CombedFrames& combed, const Faces& faces, const std::vector<bool>& is_cut,
                 MapCut* cut) {
  internal::UnionFind corners(4 * static_cast<int>(mesh.tets.size()));
  for (int f = 0; f < faces.size(); ++f) {
    if (is_cut[f]) continue;
    const auto [t, i] = faces.side(f);
    const int s = combed.neighbours[t][i];
    for (int k = 0; k < 4; ++k) {
      if (k != i) corners.Unite(4 * t + k, 4 * s + CornerOf(mesh.tets[s], mesh.tets[t][k]));
    }
  }
  cut->nodes.resize(mesh.tets.size());
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int k = 0; k < 4; ++k) {
      const int root = corners.Root(4 * t + k);  // the smallest corner of its set
      cut->nodes[t][k] = root == 4 * t + k ? cut->num_nodes++ : cut->nodes[root / 4][root % 4];
    }
  }
}

}  // namespace

MapCut CutForMap(const TetMesh& mesh, const CombedFrames& combed, const EdgeRings& rings) {
  const Faces faces(mesh, combed);
  const std::vector<bool> is_cut = FindCutFaces(combed, rings, faces);
  internal::UnionFind patches = JoinPatches(combed, rings, faces, is_cut);
  MapCut cut;
  std::vector<int> patch_of_root(faces.size(), -1);
  for (int f = 0; f < faces.size(); ++f) {
    if (!is_cut[f]) continue;
    const auto [root, is_reversed] = patches.Find(f);
    if (patch_of_root[root] < 0) patch_of_root[root] = cut.num_patches++;
    auto [tet, corner] = faces.side(f);
    if (is_reversed) {
      const int t = tet;
      tet = combed.neighbours[t][corner];
      corner = 0;
      while (faces.number(tet, corner) != f) ++corner;
    }
    cut.faces.push_back({tet, corner, patch_of_root[root]});
  }
  NumberNodes(mesh, combed, faces, is_cut, &cut);
  return cut;
}

}  // namespace octupole
