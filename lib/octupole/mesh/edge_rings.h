#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The tetrahedra around every edge, in order.
///
/// Ring r goes by the right hand about its edge (vertices[r][0] to vertices[r][1]) in tetrahedra of positive volume: it
/// is the steps begin[r] up to begin[r + 1]. An inner edge has one closed ring, from the last step on to the first. A
/// ring at the boundary begins and ends with a boundary face; an edge where the boundary touches itself has several.
struct EdgeRings {
  struct Step {
    int tet;
    /// The corners opposite the face through which the ring enters the tetrahedron, and the one through which it
    /// leaves.
    std::int8_t in;
    std::int8_t out;
  };

  std::vector<std::array<int, 2>> vertices;
  std::vector<bool> is_closed;
  std::vector<std::size_t> begin;
  std::vector<Step> steps;

  std::size_t size() const { return vertices.size(); }
};

/// \param mesh satisfies CheckTetMesh().
/// \param neighbours of TetNeighbours.
EdgeRings FindEdgeRings(const TetMesh& mesh, const std::vector<std::array<int, 4>>& neighbours);

}  // namespace octupole
