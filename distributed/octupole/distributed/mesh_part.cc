#include "octupole/distributed/mesh_part.h"

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/internal/contiguous_type.h"
#include "octupole/distributed/internal/deal_out.h"
#include "octupole/distributed/internal/partition.h"
#include "octupole/distributed/internal/petsc.h"
#include "octupole/distributed/internal/plex.h"
#include "octupole/readers/tet_mesh_reader.h"

namespace octupole {
namespace {

using internal::Check;
using internal::NumberedPlex;

// Sends the first rank's numbers to all.
template <typename Element>
void Broadcast(MPI_Comm comm, std::vector<Element>* values) {
  auto size = static_cast<int>(values->size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  values->resize(size);
  MPI_Bcast(values->data(), size, internal::ContiguousType(sizeof(Element), MPI_BYTE), 0, comm);
}

// The features and surface triangles of a mesh, whose numbers are those of the whole, that have all their vertices in a
// part.
class FeaturesOfPart {
 public:
  explicit FeaturesOfPart(const std::vector<std::int64_t>& numbers) {
    for (std::size_t v = 0; v < numbers.size(); ++v) place_of_[numbers[v]] = static_cast<int>(v);
  }

  // Rewrites the numbers; false where one is not in the part.
  template <std::size_t kSize>
  bool Find(std::array<int, kSize>* simplex) const {
    for (int& v : *simplex) {
      const auto place = place_of_.find(v);
      if (place == place_of_.end()) return false;
      v = place->second;
    }
    return true;
  }

 private:
  std::unordered_map<std::int64_t, int> place_of_;
};

void DealFeatures(MPI_Comm comm, TetMesh whole, MeshPart* part) {
  Broadcast(comm, &whole.feature_edges);
  Broadcast(comm, &whole.feature_points);
  Broadcast(comm, &whole.surface_triangles);
  Broadcast(comm, &whole.surface_tags);
  const FeaturesOfPart features(part->numbers);
  for (std::array<int, 2> edge : whole.feature_edges) {
    if (features.Find(&edge)) part->mesh.feature_edges.push_back(edge);
  }
  for (const int v : whole.feature_points) {
    if (std::array<int, 1> point = {v}; features.Find(&point)) part->mesh.feature_points.push_back(point[0]);
  }
  for (std::size_t i = 0; i < whole.surface_triangles.size(); ++i) {
    std::array<int, 3> triangle = whole.surface_triangles[i];
    if (!features.Find(&triangle)) continue;
    part->mesh.surface_triangles.push_back(triangle);
    part->mesh.surface_tags.push_back(whole.surface_tags[i]);
  }
}

}  // namespace

MeshPart ReadMeshPart(MPI_Comm comm, const std::filesystem::path& path, std::vector<std::string>* warnings) {
  int rank = 0, num_ranks = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &num_ranks);
  if (path.extension() == ".h5") {
    NumberedPlex plex;
    DoTogether(comm, [&] {
      if (rank == 0 && !std::filesystem::is_regular_file(path)) {
        throw std::runtime_error(path.string() + ": no such file");
      }
    });
    DoTogether(comm, [&] {
      try {
        plex = internal::LoadPlex(comm, path);
      } catch (const std::exception& error) {
        throw std::runtime_error(path.string() + ": not read as a DMPlex: " + error.what());
      }
    });
    plex = internal::Distribute(std::move(plex));
    return internal::PartOfPlex(plex.dm, plex.numbers);
  }
  TetMesh whole;
  DoTogether(comm, [&] {
    if (rank == 0) whole = ReadTetMesh(path, warnings);
  });
  std::vector<int> part_of_tet;
  DoTogether(comm, [&] { part_of_tet = internal::PartitionTets(whole, num_ranks); });
  MeshPart part = internal::DealOut(comm, whole, part_of_tet);
  DealFeatures(comm, std::move(whole), &part);
  return part;
}

MeshPart MeshPartOfPlex(DM dm, std::vector<int>* plex_points) {
  // Vertices of other ranks have their numbers turned into negative ones.
  IS numbering = nullptr;
  const PetscInt* numbers = nullptr;
  PetscInt begin = 0, end = 0, num_points = 0, overlap = 0;
  Check(DMPlexGetVertexNumbering(dm, &numbering));
  Check(ISGetIndices(numbering, &numbers));
  Check(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  Check(DMPlexGetChart(dm, nullptr, &num_points));
  std::vector<PetscInt> number_of_point(num_points, 0);
  for (PetscInt v = begin; v < end; ++v) {
    const PetscInt number = numbers[v - begin];
    number_of_point[v] = number < 0 ? -(number + 1) : number;
  }
  Check(ISRestoreIndices(numbering, &numbers));
  Check(DMPlexGetOverlap(dm, &overlap));

  MeshPart part;
  internal::PlexHandle overlapped;
  internal::StarForest migration;
  // PETSc adds none to a mesh that is all on one rank.
  PetscBool is_distributed = PETSC_FALSE;
  Check(DMPlexIsDistributed(dm, &is_distributed));
  if (overlap == 0 && is_distributed == PETSC_TRUE) Check(DMPlexDistributeOverlap(dm, 1, &migration, &overlapped));
  if (overlapped == nullptr) {
    part = internal::PartOfPlex(dm, number_of_point);
  } else {
    part = internal::PartOfPlex(overlapped, internal::PushForward(migration, number_of_point, overlapped));
  }
  if (plex_points == nullptr) return part;
  std::unordered_map<std::int64_t, int> place_of;
  for (std::size_t v = 0; v < part.numbers.size(); ++v) place_of[part.numbers[v]] = static_cast<int>(v);
  plex_points->clear();
  for (PetscInt v = begin; v < end; ++v) plex_points->push_back(place_of.at(number_of_point[v]));
  return part;
}

}  // namespace octupole
