#pragma once

#include <petscdmplex.h>
#include <petscsf.h>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "octupole/distributed/internal/petsc.h"
#include "octupole/distributed/mesh_part.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole::internal {

using PlexHandle = PetscHandle<DM, DMDestroy>;
using StarForest = PetscHandle<PetscSF, PetscSFDestroy>;

/// A DMPlex, and for each of its points from 0 on the number of the vertex in the whole mesh; at other points anything.
struct NumberedPlex {
  PlexHandle dm;
  std::vector<PetscInt> numbers;
};

/// A DMPlex from PETSc's HDF5, each rank's share. The numbers are those of the vertices in the file.
NumberedPlex LoadPlex(MPI_Comm comm, const std::filesystem::path& path);

/// Deals the cells out anew, with one layer of overlap, by PT-Scotch, if PETSc's options name no other partitioner. On
/// one rank the same.
NumberedPlex Distribute(NumberedPlex plex);

/// The part, by a DMPlex with an overlap. `points_of_part`, if given, receives for each point of the DMPlex its place
/// among the points of the part, where it is a vertex.
MeshPart PartOfPlex(DM dm, const std::vector<PetscInt>& numbers, std::vector<PetscInt>* points_of_part = nullptr);

/// values[p] becomes that of the point in another DMPlex that `star_forest` maps p to.
std::vector<PetscInt> PushForward(PetscSF star_forest, std::vector<PetscInt> values, DM target);

}  // namespace octupole::internal
