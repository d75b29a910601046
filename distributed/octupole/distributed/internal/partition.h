#pragma once

#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole::internal {

/// Divides the tetrahedra of a whole mesh into parts of about equal size with few vertices between them: compact blocks
/// of tetrahedra, cut along Morton's curve, are what PT-Scotch divides, a small share of its work on tetrahedra.
/// \return the part of each tetrahedron, from 0 on. Not collective.
std::vector<int> PartitionTets(const TetMesh& mesh, int num_parts);

}  // namespace octupole::internal
