#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole::internal {

/// The tetrahedra around each vertex: tets[first[v]] up to tets[first[v + 1]].
struct Stars {
  explicit Stars(const TetMesh& mesh) : first(mesh.points.size() + 1, 0), tets(4 * mesh.tets.size()) {
    for (const std::array<int, 4>& tet : mesh.tets) {
      for (const int v : tet) ++first[v + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (const int v : mesh.tets[t]) tets[next[v]++] = static_cast<int>(t);
    }
  }

  std::vector<std::size_t> first;
  std::vector<int> tets;
};

}  // namespace octupole::internal
