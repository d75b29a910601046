#pragma once

#include <Eigen/Core>
#include <array>
#include <set>
#include <vector>

#include "octupole/maps/boundary_sheets.h"
#include "octupole/maps/edge_turns.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A mesh with frames, on the way to one that has a map.
struct FramedMesh {
  TetMesh mesh;
  std::vector<Eigen::Matrix3d> point_frames;
  /// Of the tetrahedra. Splitting leaves its `neighbours` behind.
  MatchedFrames matched;
  /// The tetrahedron of the mesh that one began with.
  std::vector<int> parents;
  /// Of the face opposite each corner, whether it is an interface inside; the same on both of its sides.
  std::vector<std::array<bool, 4>> is_interface;
  /// Vertices of the boundary whose faces hold no parameter constant, as no map could.
  std::set<int> released_vertices;
};

/// Straightens the singular edges by changing matches, one face at a time, so that no turn of the whole is lost:
///  - an edge of another turn than a quarter turn becomes three edges of quarter turns, the sides of a triangle;
///  - where two singular edges are sides of a triangle and its third can take their place, it does: a shortcut.
/// \param singular_edges of the mesh; not up to date any more if something was changed, which is what is returned.
bool StraightenSingularEdges(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
                             FramedMesh* framed);

/// Splits what would be flat in every map for want of a vertex, and says whether there was anything:
///  - all edges at a boundary vertex that a singular edge touches without ending there on the boundary as on a plane
///    across it. The tetrahedra left at the vertex get the vertex's frame, so that the singular edges go around it;
///  - if there are none, edges with both ends on one sheet without lying in it, at their midpoints: they would lie in
///    the plane of the sheet, and what is between them would be flat; likewise regular edges with both ends on one
///    connected part of the singular edges, and edges with both ends on one line of features or creases;
///  - if there are none, inner faces with all corners on one sheet, at their centres.
/// Otherwise parts of a tetrahedron keep its frame and matches, so that all turns stay as they are. Points and
/// tetrahedra stay first, as far as they are left; regions, feature edges and interfaces are handed down.
/// \param framed all its tetrahedra of positive volume; the others are found on it.
bool SplitForMap(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges, const BoundarySheets& sheets,
                 FramedMesh* framed);

/// Splits of each of the tetrahedra the longest inner edge that is neither singular nor a feature nor in a sheet, where
/// it has one, as SplitForMap does; and says whether there was any.
bool SplitTets(const std::vector<int>& tets, const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
               const BoundarySheets& sheets, FramedMesh* framed);

}  // namespace octupole
