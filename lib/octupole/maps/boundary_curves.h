#pragma once

#include <vector>

#include "octupole/maps/boundary_sheets.h"
#include "octupole/maps/edge_turns.h"
#include "octupole/maps/map_splits.h"
#include "octupole/mesh/edge_rings.h"

namespace octupole {

/// Where a crease of the boundary fades out, the field has a singular curve that goes on inside from its end, below the
/// surface, its axis along the surface. No map has such an end: the two parameters that are constant on the curve are
/// those of the two sides of the crease, so that the curve would lie in the boundary. This takes such curves to the
/// boundary, edge by edge, by changing the matches across the faces between: the crease then goes on where the curve
/// went. Where there is no way, because the curve is more than an edge below, the vertex of the end is released.
///
/// No map has a curve either that ends on the boundary as on a plane across it at both ends, but with valence 3 at the
/// one and 5 at the other: as it runs along the curve one way only, it would come to one of the planes from outside.
/// Where it has one of the two for less than a twentieth of the other's length, the vertex of that end is released.
/// \param are_nodes_final if not, curves from a node inside are left to SplitForMap, which may give them another end.
/// \param singular_edges, sheets of the mesh; not up to date any more if something was changed, which is what is
///     returned.
bool TakeCurvesToBoundary(const EdgeRings& rings, const std::vector<SingularEdge>& singular_edges,
                          const BoundarySheets& sheets, bool are_nodes_final, FramedMesh* framed);

}  // namespace octupole
