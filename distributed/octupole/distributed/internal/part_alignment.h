#pragma once

#include <mpi.h>

#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/alignment/boundary_alignment.h"
#include "octupole/distributed/mesh_part.h"

namespace octupole::internal {

/// AlignToBoundary for the points of a part; of its counts, those of points are not of the whole mesh, nor right where
/// points are ghosts. Collective.
BoundaryAlignment AlignPart(MPI_Comm comm, const MeshPart& part, double feature_angle_deg, RegionUse regions);

}  // namespace octupole::internal
