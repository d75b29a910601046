#include "octupole/distributed/internal/plex.h"

#include <petscviewerhdf5.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/distributed/distributed_error.h"

namespace octupole::internal {
namespace {

constexpr const char* kRegions = "Cell Sets";
constexpr const char* kSurfaces = "Face Sets";
constexpr const char* kCurves = "Edge Sets";

using Viewer = PetscHandle<PetscViewer, PetscViewerDestroy>;

struct Range {
  PetscInt begin = 0;
  PetscInt end = 0;
  bool Contains(PetscInt point) const { return begin <= point && point < end; }
};

Range PointsOf(DM dm) {
  Range range;
  Check(DMPlexGetChart(dm, &range.begin, &range.end));
  return range;
}

Range AtDepth(DM dm, PetscInt depth) {
  Range range;
  Check(DMPlexGetDepthStratum(dm, depth, &range.begin, &range.end));
  return range;
}

Range CellsOf(DM dm) {
  Range range;
  Check(DMPlexGetHeightStratum(dm, 0, &range.begin, &range.end));
  return range;
}

// The vertices of a cell, face or edge.
std::vector<PetscInt> VerticesOf(DM dm, PetscInt point, const Range& vertices) {
  PetscInt size = 0;
  PetscInt* closure = nullptr;
  const PetscInt* cone = nullptr;
  std::vector<PetscInt> result;
  Check(DMPlexGetConeSize(dm, point, &size));
  Check(DMPlexGetCone(dm, point, &cone));
  if (size > 0 && vertices.Contains(cone[0])) return {cone, cone + size};
  Check(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &size, &closure));
  for (PetscInt i = 0; i < size; ++i) {
    if (vertices.Contains(closure[2 * i])) result.push_back(closure[2 * i]);
  }
  Check(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &size, &closure));
  return result;
}

DMLabel LabelOf(DM dm, const char* name) {
  DMLabel label = nullptr;
  Check(DMGetLabel(dm, name, &label));
  return label;
}

// Calls visit(vertices, tag) for the points of `range` that have the label.
template <std::size_t kSize, typename Visit>
void ForEachTagged(DM dm, const char* name, const Range& range, const Range& vertices,
                   const std::vector<PetscInt>& points_of_part, const Visit& visit) {
  const DMLabel label = LabelOf(dm, name);
  if (label == nullptr) return;
  for (PetscInt point = range.begin; point < range.end; ++point) {
    PetscInt tag = -1;
    Check(DMLabelGetValue(label, point, &tag));
    if (tag < 0) continue;
    std::array<int, kSize> simplex;
    const std::vector<PetscInt> corners = VerticesOf(dm, point, vertices);
    for (std::size_t k = 0; k < kSize; ++k) simplex[k] = points_of_part[corners.at(k)];
    visit(simplex, static_cast<int>(tag));
  }
}

struct SharedPoints {
  PetscSF star_forest = nullptr;
  std::vector<PetscInt> leaves;
  const PetscSFNode* roots = nullptr;
};

SharedPoints SharedPointsOf(DM dm) {
  SharedPoints shared;
  Check(DMGetPointSF(dm, &shared.star_forest));
  PetscInt num_roots = 0, num_leaves = 0;
  const PetscInt* leaves = nullptr;
  Check(PetscSFGetGraph(shared.star_forest, &num_roots, &num_leaves, &leaves, &shared.roots));
  for (PetscInt i = 0; i < num_leaves; ++i) shared.leaves.push_back(leaves == nullptr ? i : leaves[i]);
  return shared;
}

void CheckCells(DM dm, const Range& cells) {
  PetscInt dimension = 0;
  Check(DMGetCoordinateDim(dm, &dimension));
  if (dimension != 3) {
    throw std::runtime_error("MeshPartOfPlex: a mesh in " + std::to_string(dimension) + " dimensions, not 3");
  }
  for (PetscInt cell = cells.begin; cell < cells.end; ++cell) {
    DMPolytopeType type = DM_POLYTOPE_UNKNOWN;
    Check(DMPlexGetCellType(dm, cell, &type));
    if (type == DM_POLYTOPE_TETRAHEDRON) continue;
    throw std::runtime_error("MeshPartOfPlex: cell " + std::to_string(cell) + " is no tetrahedron but a " +
                             DMPolytopeTypes[type]);
  }
}

void SetPoints(DM dm, const Range& vertices, const std::vector<PetscInt>& points_of_part, TetMesh* mesh) {
  Vec coordinates = nullptr;
  PetscSection section = nullptr;
  Check(DMGetCoordinatesLocal(dm, &coordinates));
  Check(DMGetCoordinateSection(dm, &section));
  mesh->points.resize(vertices.end - vertices.begin);
  if (mesh->points.empty()) return;
  const PetscScalar* values = nullptr;
  Check(VecGetArrayRead(coordinates, &values));
  for (PetscInt v = vertices.begin; v < vertices.end; ++v) {
    PetscInt offset = 0;
    Check(PetscSectionGetOffset(section, v, &offset));
    mesh->points[points_of_part[v]] = {values[offset], values[offset + 1], values[offset + 2]};
  }
  Check(VecRestoreArrayRead(coordinates, &values));
}

}  // namespace

std::vector<PetscInt> PushForward(PetscSF star_forest, std::vector<PetscInt> values, DM target) {
  PetscInt num_roots = 0;
  Check(PetscSFGetGraph(star_forest, &num_roots, nullptr, nullptr, nullptr));
  values.resize(num_roots);
  std::vector<PetscInt> result(PointsOf(target).end);
  Check(PetscSFBcastBegin(star_forest, MPIU_INT, values.data(), result.data(), MPI_REPLACE));
  Check(PetscSFBcastEnd(star_forest, MPIU_INT, values.data(), result.data(), MPI_REPLACE));
  return result;
}

NumberedPlex LoadPlex(MPI_Comm comm, const std::filesystem::path& path) {
  Viewer viewer;
  Check(PetscViewerHDF5Open(comm, path.c_str(), FILE_MODE_READ, &viewer));
  Check(PetscViewerPushFormat(viewer, PETSC_VIEWER_HDF5_PETSC));
  NumberedPlex plex;
  Check(DMCreate(comm, &plex.dm));
  Check(DMSetType(plex.dm, DMPLEX));
  StarForest from_file;
  Check(DMPlexTopologyLoad(plex.dm, viewer, &from_file));
  Check(DMPlexCoordinatesLoad(plex.dm, viewer, from_file));
  Check(DMPlexLabelsLoad(plex.dm, viewer, from_file));
  // The vertices among the points of the file, in its order.
  PetscInt num_roots = 0;
  Check(PetscSFGetGraph(from_file, &num_roots, nullptr, nullptr, nullptr));
  std::vector<PetscInt> is_vertex(PointsOf(plex.dm).end, 0), numbers(num_roots, 0);
  const Range vertices = AtDepth(plex.dm, 0);
  for (PetscInt v = vertices.begin; v < vertices.end; ++v) is_vertex[v] = 1;
  Check(PetscSFReduceBegin(from_file, MPIU_INT, is_vertex.data(), numbers.data(), MPI_MAX));
  Check(PetscSFReduceEnd(from_file, MPIU_INT, is_vertex.data(), numbers.data(), MPI_MAX));
  PetscInt num_mine = 0, next = 0;
  for (const PetscInt one : numbers) num_mine += one;
  MPI_Exscan(&num_mine, &next, 1, MPIU_INT, MPI_SUM, comm);
  for (PetscInt& number : numbers) number = number == 1 ? next++ : -1;
  plex.numbers = PushForward(from_file, std::move(numbers), plex.dm);
  return plex;
}

NumberedPlex Distribute(NumberedPlex plex) {
  PetscPartitioner partitioner = nullptr;
  Check(DMPlexGetPartitioner(plex.dm, &partitioner));
  Check(PetscPartitionerSetType(partitioner, PETSCPARTITIONERPTSCOTCH));
  Check(PetscPartitionerSetFromOptions(partitioner));
  Check(DMPlexSetPartitionBalance(plex.dm, PETSC_TRUE));
  NumberedPlex result;
  StarForest migration;
  constexpr PetscInt kOverlap = 1;
  Check(DMPlexDistribute(plex.dm, kOverlap, &migration, &result.dm));
  if (result.dm == nullptr) return plex;
  result.numbers = PushForward(migration, std::move(plex.numbers), result.dm);
  return result;
}

MeshPart PartOfPlex(DM dm, const std::vector<PetscInt>& numbers, std::vector<PetscInt>* points_of_part) {
  MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(dm));
  const Range all = PointsOf(dm), cells = CellsOf(dm), vertices = AtDepth(dm, 0);
  DoTogether(comm, [&] { CheckCells(dm, cells); });
  const SharedPoints shared = SharedPointsOf(dm);
  std::vector<bool> is_owned(all.end, true);
  for (const PetscInt leaf : shared.leaves) is_owned[leaf] = false;

  MeshPart part;
  constexpr PetscInt kNone = -1;
  std::vector<PetscInt> place(all.end, kNone);
  for (const bool owned : {true, false}) {
    for (PetscInt v = vertices.begin; v < vertices.end; ++v) {
      if (is_owned[v] != owned) continue;
      place[v] = static_cast<PetscInt>(part.numbers.size());
      part.numbers.push_back(numbers[v]);
    }
    if (owned) part.num_owned_points = part.numbers.size();
  }
  part.ghosts.resize(part.numbers.size() - part.num_owned_points);
  if (!part.ghosts.empty() || shared.roots != nullptr) {
    std::vector<PetscInt> sources = place;
    Check(PetscSFBcastBegin(shared.star_forest, MPIU_INT, place.data(), sources.data(), MPI_REPLACE));
    Check(PetscSFBcastEnd(shared.star_forest, MPIU_INT, place.data(), sources.data(), MPI_REPLACE));
    for (std::size_t i = 0; i < shared.leaves.size(); ++i) {
      const PetscInt point = shared.leaves[i];
      if (!vertices.Contains(point)) continue;
      part.ghosts[place[point] - part.num_owned_points] = {static_cast<int>(shared.roots[i].rank),
                                                           static_cast<int>(sources[point])};
    }
  }
  SetPoints(dm, vertices, place, &part.mesh);

  const DMLabel regions = LabelOf(dm, kRegions);
  part.mesh.tets.reserve(cells.end - cells.begin);
  for (const bool owned : {true, false}) {
    for (PetscInt cell = cells.begin; cell < cells.end; ++cell) {
      if (is_owned[cell] != owned) continue;
      const std::vector<PetscInt> corners = VerticesOf(dm, cell, vertices);
      std::array<int, 4>& tet = part.mesh.tets.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) tet[k] = place[corners.at(k)];
      if (regions == nullptr) continue;
      PetscInt region = 0;
      Check(DMLabelGetValue(regions, cell, &region));
      part.mesh.regions.push_back(region);
    }
    if (owned) part.num_owned_tets = part.mesh.tets.size();
  }
  PetscInt depth = 0;
  Check(DMPlexGetDepth(dm, &depth));
  if (depth == 3) {
    ForEachTagged<3>(dm, kSurfaces, AtDepth(dm, 2), vertices, place, [&](const std::array<int, 3>& triangle, int tag) {
      part.mesh.surface_triangles.push_back(triangle);
      part.mesh.surface_tags.push_back(tag);
    });
    ForEachTagged<2>(dm, kCurves, AtDepth(dm, 1), vertices, place,
                     [&](const std::array<int, 2>& edge, int) { part.mesh.feature_edges.push_back(edge); });
  }
  if (points_of_part != nullptr) *points_of_part = std::move(place);
  return part;
}

}  // namespace octupole::internal
