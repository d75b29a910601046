#include "octupole/mesh/tet_neighbours.h"

#include <stdexcept>
#include <string>

#include "octupole/mesh/internal/sorted_simplices.h"

namespace octupole {
namespace {

int CornerOpposite(const std::array<int, 4>& tet, const std::array<int, 3>& face) {
  const auto is_in_face = [&](int v) { return v == face[0] || v == face[1] || v == face[2]; };
  int i = 0;
  while (is_in_face(tet[i])) ++i;
  return i;
}

}  // namespace

std::vector<std::array<int, 4>> TetNeighbours(const TetMesh& mesh) {
  const auto faces = internal::SortedSimplices(mesh.tets, internal::kTetFaces, mesh.points.size());
  std::vector<std::array<int, 4>> neighbours(mesh.tets.size(), {-1, -1, -1, -1});
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    const auto& [a, b, c] = faces[begin].vertices;
    while (end < faces.size() && faces[end].vertices == faces[begin].vertices) ++end;
    if (end - begin > 2) {
      throw std::invalid_argument("TetNeighbours: triangle " + std::to_string(a) + " " + std::to_string(b) + " " +
                                  std::to_string(c) + " belongs to " + std::to_string(end - begin) + " tetrahedra");
    }
    if (end - begin < 2) continue;
    const int s = faces[begin].cell, t = faces[begin + 1].cell;
    neighbours[s][CornerOpposite(mesh.tets[s], faces[begin].vertices)] = t;
    neighbours[t][CornerOpposite(mesh.tets[t], faces[begin].vertices)] = s;
  }
  return neighbours;
}

int CornerAcross(const TetMesh& mesh, const std::vector<std::array<int, 4>>& neighbours, int tet, int corner) {
  const int neighbour = neighbours[tet][corner];
  // Two tetrahedra may share several faces.
  for (int i = 0; i < 3; ++i) {
    if (neighbours[neighbour][i] != tet) continue;
    bool is_same = true;
    for (int k = 0; k < 4; ++k) is_same = is_same && (k == corner || mesh.tets[tet][k] != mesh.tets[neighbour][i]);
    if (is_same) return i;
  }
  return 3;
}

}  // namespace octupole
