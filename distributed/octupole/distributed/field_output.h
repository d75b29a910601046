#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>

#include "octupole/distributed/distributed_solver.h"
#include "octupole/distributed/mesh_part.h"

namespace octupole {

/// Writes a field for ParaView: a `.pvtu` file that names one `.vtu` file per rank with tetrahedra, NAME_0.vtu and so
/// on beside it, as WriteField does, with the point array `vertex`, its number in the whole mesh: points on the border
/// of two parts are in the files of both. All files take their names when all are complete. Collective. \throw
/// DistributedError naming path and cause when a file cannot be written; existing ones stay as they were.
template <int kDegree>
void WritePvtu(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part,
               const DistributedField<kDegree>& field);

/// Writes a field to HDF5, in the order of the vertices' numbers in the whole mesh, all ranks together:
/// `coefficients`, 7 or 9 numbers each, and, unless there are none, `frames`, the three axes one after the other; and
/// as attributes of the file `degree` and `level` (see DistributedState). Numbers that are of no vertex have zeros. The
/// file takes its name when it is complete. Collective. \throw DistributedError as above.
template <int kDegree>
void WriteFieldHdf5(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part,
                    const DistributedState<kDegree>& state);

/// Reads what WriteFieldHdf5 writes, of the same mesh on any number of ranks. Collective.
/// \throw DistributedError naming the path when it is no such file, of another degree or of another mesh.
template <int kDegree>
DistributedState<kDegree> ReadFieldHdf5(MPI_Comm comm, const std::filesystem::path& path, const MeshPart& part);

}  // namespace octupole
