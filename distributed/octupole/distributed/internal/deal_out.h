#pragma once

#include <mpi.h>

#include <vector>

#include "octupole/distributed/mesh_part.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole::internal {

/// Sends each rank its part of the mesh that the first rank has, with its regions, by the owner of each tetrahedron. A
/// vertex belongs to the owner of most tetrahedra around it, the lowest of those where there is a tie. Points of no
/// tetrahedron are left out, the others keep their order. Collective; `mesh` and `owner_of_tet` matter on the first
/// rank.
MeshPart DealOut(MPI_Comm comm, const TetMesh& mesh, const std::vector<int>& owner_of_tet);

}  // namespace octupole::internal
