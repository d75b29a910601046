#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

// All functions here expect a mesh that satisfies CheckTetMesh().

/// The edges of all tetrahedra, each once with the smaller vertex first, in lexicographic order.
std::vector<std::array<int, 2>> MeshEdges(const TetMesh& mesh);

/// The faces of all tetrahedra, each once with ascending vertices, in lexicographic order.
std::vector<std::array<int, 3>> MeshTriangles(const TetMesh& mesh);

/// The faces of exactly one tetrahedron, ordered by their ascending vertices. Each is oriented so
/// that its normal (b - a) x (c - a) points out of its tetrahedron, whatever the orientation of
/// that; a tetrahedron of volume zero counts as positively oriented.
std::vector<std::array<int, 3>> BoundaryTriangles(const TetMesh& mesh);

/// Six times the signed volume of every tetrahedron, det(b - a, c - a, d - a).
std::vector<double> SixfoldVolumes(const TetMesh& mesh);

}  // namespace octupole
