#pragma once

#include <array>
#include <vector>

#include "octupole/maps/combed_frames.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A mesh cut open so that a map into space has no turn left across any face that holds together: what is cut are faces
/// between singular edges, the boundary and handles.
struct MapCut {
  /// A face that is cut, from the tetrahedron `tet` through the face opposite `corner`.
  struct Face {
    int tet;
    int corner;
    /// Faces of one patch belong together across regular edges: they share the match and the shift.
    int patch;
  };

  /// Each cut face once, all faces of a patch from the same side.
  std::vector<Face> faces;
  int num_patches = 0;
  /// For every corner of every tetrahedron the point of the cut mesh; corners share it where faces hold together.
  std::vector<std::array<int, 4>> nodes;
  int num_nodes = 0;
};

/// Cuts all faces off the spanning tree, then glues one whenever an edge has it as its last cut face and turns by the
/// identity: its match is then the identity, too.
MapCut CutForMap(const TetMesh& mesh, const CombedFrames& combed, const EdgeRings& rings);

}  // namespace octupole
