#pragma once

#include <array>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// For every tetrahedron the ones across its four faces, the i-th opposite its i-th corner; -1 on the boundary.
/// \param mesh satisfies CheckTetMesh().
/// \throw std::invalid_argument naming a triangle that belongs to more than two tetrahedra.
std::vector<std::array<int, 4>> TetNeighbours(const TetMesh& mesh);

/// The corner of the neighbour across the face opposite `corner` that is opposite the same face.
int CornerAcross(const TetMesh& mesh, const std::vector<std::array<int, 4>>& neighbours, int tet, int corner);

/// The position of `vertex` among the corners of a tetrahedron that has it.
inline int CornerOf(const std::array<int, 4>& tet, int vertex) {
  int i = 0;
  while (tet[i] != vertex) ++i;
  return i;
}

}  // namespace octupole
