#pragma once

#include <mpi.h>

#include <Eigen/Core>
#include <vector>

#include "octupole/distributed/mesh_part.h"
#include "octupole/field/field_quality.h"

namespace octupole {

/// MeasureField of the whole mesh, the same on all ranks: edges and singular triangles are counted by the rank that
/// owns the vertex of lowest number. Collective. \param frames one rotation per point of the part, those of ghosts as
/// their owners have them. \throw DistributedError unless there is one frame per point.
FieldQuality MeasureField(MPI_Comm comm, const MeshPart& part, const std::vector<Eigen::Matrix3d>& frames);

/// How large a mesh is that is dealt out.
struct MeshSize {
  std::size_t points = 0;
  std::size_t tets = 0;
};

/// Of the whole mesh. Collective.
MeshSize SizeOfMesh(MPI_Comm comm, const MeshPart& part);

}  // namespace octupole
