#pragma once

#include <mpi.h>
#include <petscdmplex.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Where the owner of a ghost keeps it.
struct GhostSource {
  int rank = 0;
  /// Among the vertices of that rank.
  int index = 0;
};

/// One rank's part of a tet mesh that is dealt out to the ranks of a communicator, as plain arrays.
///
/// Each vertex and each tetrahedron is owned by one rank. A part holds these and, as one layer of overlap, the
/// tetrahedra of others that touch a vertex that is owned, with their vertices, the ghosts. So an owned vertex has all
/// that is around it: what functions for whole meshes say of it holds for the whole mesh. At ghosts they may take what
/// the part lacks for the outside. A part may be empty.
struct MeshPart {
  /// Owned vertices first, then ghosts; owned tetrahedra first. Features and surface triangles are those of the whole
  /// mesh that have all their vertices here.
  TetMesh mesh;
  std::size_t num_owned_points = 0;
  std::size_t num_owned_tets = 0;
  /// One per ghost.
  std::vector<GhostSource> ghosts;
  /// The number of each point in the whole mesh: that of the file, where the part comes from one.
  std::vector<std::int64_t> numbers;
};

/// Reads a mesh and deals it out by PT-Scotch. Collective. Points of no tetrahedron are left out.
///
///  - `.h5`: a DMPlex in PETSc's own format, as DMView writes it (PETSC_VIEWER_HDF5_PETSC). All ranks read a share,
///    none ever holds the whole. Labels mean what MeshPartOfPlex says; another partitioner may be chosen by PETSc's
///    option -petscpartitioner_type.
///  - any other format: as ReadTetMesh, by the first rank, which deals it out.
///
/// \param warnings if given, receives those of ReadTetMesh, on the first rank.
/// \throw DistributedError what ReadTetMesh throws, or when the file is no DMPlex of tetrahedra.
MeshPart ReadMeshPart(MPI_Comm comm, const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// The part of this rank of a DMPlex of tetrahedra, interpolated or not. Collective. Of its labels, "Cell Sets" are
/// regions; where it is interpolated, "Face Sets" are the tags of surface triangles and "Edge Sets" mark feature edges.
/// An overlap is added where there is none; the DMPlex stays as it is.
///
/// `plex_points`, if given, receives for each of its vertices, from the first of DMPlexGetDepthStratum(0), its place
/// among the points of the part.
/// \throw DistributedError when it has other cells, is of another dimension or has coordinates that are not finite.
MeshPart MeshPartOfPlex(DM dm, std::vector<int>* plex_points = nullptr);

}  // namespace octupole
