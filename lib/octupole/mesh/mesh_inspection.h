#pragma once

#include <string>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// What is odd about a mesh, as counts. None of it keeps a mesh from carrying a field, but all of
/// it is worth a look.
struct MeshInspection {
  int tets = 0;
  /// Tetrahedra whose volume is negative, beyond rounding.
  int inverted_tets = 0;
  /// Tetrahedra whose volume is zero up to rounding, relative to their longest edge and to the
  /// size of their coordinates.
  int zero_volume_tets = 0;
  /// Tetrahedra with the vertices of an earlier one.
  int duplicate_tets = 0;
  /// Vertices that belong to no tetrahedron.
  int isolated_vertices = 0;
  /// Vertices of tetrahedra that lie exactly on an earlier one: the mesh may be cracked there.
  int duplicate_vertices = 0;
  /// Sets of tetrahedra that are connected by common vertices.
  int components = 0;
  /// Triangles that belong to more than two tetrahedra.
  int overfull_triangles = 0;
  /// Edges that belong to boundary triangles, but not to two of them.
  int non_manifold_boundary_edges = 0;
};

/// Expects a mesh that satisfies CheckTetMesh().
MeshInspection InspectMesh(const TetMesh& mesh);

/// A line for the user about each count that is odd; empty for a clean mesh.
std::vector<std::string> MeshWarnings(const MeshInspection& inspection);

/// The mean ratio of each tetrahedron, 12 (3 V)^(2/3) over the sum of its squared edge lengths: 1 for a regular one, 0
/// for one without volume, and negative, with the magnitude of its mirror image, for an inverted one. Expects a mesh
/// that satisfies CheckTetMesh().
std::vector<double> MeanRatios(const TetMesh& mesh);

}  // namespace octupole
