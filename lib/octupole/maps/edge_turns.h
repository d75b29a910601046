#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "octupole/frames/octahedral_group.h"
#include "octupole/maps/combed_frames.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The product of the matches around a closed ring, from its first tetrahedron on, or along an open one.
OctahedralRotation TurnAround(const MatchedFrames& matched, const EdgeRings& rings, std::size_t ring);

/// The axis of a quarter turn, with the sign of a right-handed turn by 90 degrees, in the coordinates of the frame.
Eigen::Vector3d QuarterAxis(const OctahedralRotation& turn);

/// An inner edge around which the matches do not multiply to the identity.
struct SingularEdge {
  std::array<int, 2> vertices;
  /// Its ring in the EdgeRings.
  std::size_t ring;
  TurnType type;
  /// Where the frame makes a quarter turn as one goes around the edge by the right hand, 3 or 5: whether it turns the
  /// same way about the direction of the edge or the other; else 0: there is no map around such an edge.
  int valence;
};

/// All of them, in the order of the rings.
std::vector<SingularEdge> FindSingularEdges(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings);

/// The axis of a singular edge with a quarter turn in every tetrahedron at one of its vertices, v, if it is the only
/// one there. Matches take an axis from one tetrahedron to the next; it does not matter on which way, as the turn
/// around the edge leaves its own axis alone.
std::map<int, int> CarryAxis(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                             const SingularEdge& edge, int v);

}  // namespace octupole
