#include "octupole/distributed/mesh_part.h"

#include <gtest/gtest.h>
#include <petscviewerhdf5.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "mesh_writers.h"
#include "octupole/distributed/distributed_error.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "ranks.h"

namespace octupole {
namespace {

using Numbered = std::array<std::int64_t, 4>;

// Every vertex and tet is owned once, and an owned vertex has all its tets.
void ExpectPartsOf(const TetMesh& whole, const MeshPart& part) {
  const std::vector<std::int64_t> owned(part.numbers.begin(),
                                        part.numbers.begin() + static_cast<std::ptrdiff_t>(part.num_owned_points));
  std::vector<std::int64_t> all = OfAllRanks(owned);
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), whole.points.size());
  for (std::size_t v = 0; v < all.size(); ++v) EXPECT_EQ(all[v], static_cast<std::int64_t>(v));
  for (std::size_t v = 0; v < part.numbers.size(); ++v) {
    EXPECT_EQ((part.mesh.points[v] - whole.points[part.numbers[v]]).norm(), 0) << v;
  }

  const auto numbered = [](const std::array<int, 4>& tet, const auto& number_of) {
    Numbered result;
    for (int k = 0; k < 4; ++k) result[k] = number_of(tet[k]);
    std::sort(result.begin(), result.end());
    return result;
  };
  std::vector<Numbered> here, expected;
  for (const auto& tet : part.mesh.tets) here.push_back(numbered(tet, [&](int v) { return part.numbers[v]; }));
  for (const auto& tet : whole.tets) expected.push_back(numbered(tet, [](int v) { return v; }));
  std::vector<Numbered> tets =
      OfAllRanks(std::vector<Numbered>(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(part.num_owned_tets)));
  std::sort(tets.begin(), tets.end());
  std::vector<Numbered> sorted = expected;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(tets, sorted);
  const std::set<Numbered> known(here.begin(), here.end());
  EXPECT_EQ(known.size(), here.size());
  const std::set<std::int64_t> mine(owned.begin(), owned.end());
  for (const Numbered& tet : expected) {
    const bool touches = std::any_of(tet.begin(), tet.end(), [&](std::int64_t v) { return mine.count(v) > 0; });
    EXPECT_TRUE(!touches || known.count(tet) > 0);
  }

  // The owner of a ghost has it where the part says.
  const std::vector<std::int64_t> firsts =
      OfAllRanks(std::vector<std::int64_t>{static_cast<std::int64_t>(owned.size())});
  ASSERT_EQ(part.ghosts.size(), part.numbers.size() - owned.size());
  const std::vector<std::int64_t> in_order = OfAllRanks(owned);
  for (std::size_t i = 0; i < part.ghosts.size(); ++i) {
    std::int64_t first = 0;
    for (int rank = 0; rank < part.ghosts[i].rank; ++rank) first += firsts[rank];
    EXPECT_NE(part.ghosts[i].rank, Rank());
    EXPECT_EQ(in_order[first + part.ghosts[i].index], part.numbers[owned.size() + i]);
  }
}

// Interpolated, its cells on the first rank, with tags of cells, faces and edges, which are their number modulo 5.
DM PlexOf(const TetMesh& mesh) {
  std::vector<PetscInt> corners;
  std::vector<PetscReal> coordinates;
  if (Rank() == 0) {
    for (const auto& tet : mesh.tets) corners.insert(corners.end(), tet.begin(), tet.end());
    for (const auto& p : mesh.points) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  }
  DM dm = nullptr;
  DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 3, static_cast<PetscInt>(corners.size() / 4),
                                static_cast<PetscInt>(coordinates.size() / 3), 4, PETSC_TRUE, corners.data(), 3,
                                coordinates.data(), &dm);
  for (const auto& [name, height] : {std::pair("Cell Sets", 0), std::pair("Face Sets", 1), std::pair("Edge Sets", 2)}) {
    DMCreateLabel(dm, name);
    PetscInt begin = 0, end = 0;
    DMPlexGetHeightStratum(dm, height, &begin, &end);
    for (PetscInt point = begin; point < end; ++point) {
      if (height == 0 || (point - begin) % 5 > 0) DMSetLabelValue(dm, name, point, (point - begin) % 5);
    }
  }
  return dm;
}

DM Dealt(DM dm) {
  DM dealt = nullptr;
  DMPlexDistribute(dm, 0, nullptr, &dealt);
  if (dealt == nullptr) return dm;
  DMDestroy(&dm);
  return dealt;
}

TEST(MeshPart, DividesAMeshThatIsRead) {
  const SharedFolder folder;
  const TetMesh whole = MakeBoxMesh({6, 5, 4}, {6, 5, 4});
  if (Rank() == 0) WriteVtu(folder / "mesh.vtu", whole, {});
  ExpectPartsOf(whole, ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.vtu"));
}

TEST(MeshPart, KeepsRegionsFeaturesAndSurfaces) {
  const SharedFolder folder;
  TetMesh whole = MakeBoxMesh({6, 5, 4}, {6, 5, 4});
  for (std::size_t t = 0; t < whole.tets.size(); ++t) whole.regions.push_back(static_cast<int>(t % 3) + 1);
  for (std::size_t t = 0; t < whole.tets.size(); t += 7) {
    whole.feature_edges.push_back({whole.tets[t][0], whole.tets[t][1]});
    whole.surface_triangles.push_back({whole.tets[t][0], whole.tets[t][1], whole.tets[t][2]});
    whole.surface_tags.push_back(static_cast<int>(t) + 1);
  }
  if (Rank() == 0) WriteText(folder / "mesh.mesh", MeditText(whole));
  MPI_Barrier(MPI_COMM_WORLD);
  const TetMesh read = ReadTetMesh(folder / "mesh.mesh");
  ASSERT_EQ(read.surface_triangles.size(), whole.surface_triangles.size());
  const MeshPart part = ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.mesh");
  ExpectPartsOf(read, part);
  std::map<std::int64_t, int> place;
  for (std::size_t v = 0; v < part.numbers.size(); ++v) place[part.numbers[v]] = static_cast<int>(v);
  const auto has_all = [&](const auto& simplex) {
    return std::all_of(simplex.begin(), simplex.end(), [&](int v) { return place.count(v) > 0; });
  };
  std::vector<std::array<int, 2>> edges;
  for (const auto& edge : read.feature_edges) {
    if (has_all(edge)) edges.push_back({place[edge[0]], place[edge[1]]});
  }
  EXPECT_EQ(part.mesh.feature_edges, edges);
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> tags;
  for (std::size_t i = 0; i < read.surface_triangles.size(); ++i) {
    const auto& [a, b, c] = read.surface_triangles[i];
    if (!has_all(read.surface_triangles[i])) continue;
    triangles.push_back({place[a], place[b], place[c]});
    tags.push_back(read.surface_tags[i]);
  }
  EXPECT_EQ(part.mesh.surface_triangles, triangles);
  EXPECT_EQ(part.mesh.surface_tags, tags);
  std::map<Numbered, int> region_of;
  for (std::size_t t = 0; t < read.tets.size(); ++t) {
    Numbered tet = {read.tets[t][0], read.tets[t][1], read.tets[t][2], read.tets[t][3]};
    std::sort(tet.begin(), tet.end());
    region_of[tet] = read.regions[t];
  }
  for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
    Numbered tet;
    for (int k = 0; k < 4; ++k) tet[k] = part.numbers[part.mesh.tets[t][k]];
    std::sort(tet.begin(), tet.end());
    EXPECT_EQ(part.mesh.regions[t], region_of.at(tet));
  }
}

TEST(MeshPart, LeavesOutPointsOfNoTetrahedron) {
  const SharedFolder folder;
  TetMesh whole = MakeBoxMesh({1, 1, 1}, {3, 3, 3});
  whole.points.insert(whole.points.begin(), Eigen::Vector3d(9, 9, 9));
  for (auto& tet : whole.tets) {
    for (int& v : tet) ++v;
  }
  if (Rank() == 0) WriteVtu(folder / "mesh.vtu", whole, {});
  const MeshPart part = ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.vtu");
  const std::vector<std::int64_t> counts =
      OfAllRanks(std::vector<std::int64_t>{static_cast<std::int64_t>(part.num_owned_points)});
  std::int64_t sum = 0;
  for (const std::int64_t count : counts) sum += count;
  EXPECT_EQ(sum, static_cast<std::int64_t>(whole.points.size()) - 1);
  for (std::size_t v = 0; v < part.numbers.size(); ++v) {
    EXPECT_EQ((part.mesh.points[v] - whole.points[part.numbers[v]]).norm(), 0);
  }
}

TEST(MeshPart, MayBeEmpty) {
  const SharedFolder folder;
  const TetMesh whole = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  if (Rank() == 0) WriteVtu(folder / "mesh.vtu", whole, {});
  ExpectPartsOf(whole, ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.vtu"));
}

TEST(MeshPart, SaysOnAllRanksWhatIsWrongWithAFile) {
  const SharedFolder folder;
  if (Rank() == 0) WriteText(folder / "mesh.vtk", "nothing");
  for (const char* name : {"mesh.vtk", "missing.msh", "missing.h5"}) {
    try {
      ReadMeshPart(MPI_COMM_WORLD, folder / name);
      ADD_FAILURE() << name;
    } catch (const DistributedError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(MeshPart, ComesFromADmplexWithItsLabels) {
  const TetMesh whole = MakeBoxMesh({5, 4, 3}, {5, 4, 3});
  DM dm = PlexOf(whole);
  PetscInt begin = 0, end = 0, num_tagged = 0;
  for (const char* name : {"Face Sets", "Edge Sets"}) {
    for (PetscInt value = 1; value < 5; ++value) {
      PetscInt size = 0;
      DMGetStratumSize(dm, name, value, &size);
      num_tagged += size;
    }
  }
  dm = Dealt(dm);
  std::vector<int> plex_points;
  const MeshPart part = MeshPartOfPlex(dm, &plex_points);
  // On one rank, the order is the mesh's own; on more, vertices are found again by where they are.
  std::vector<std::array<double, 3>> mine;
  for (std::size_t v = 0; v < part.num_owned_points; ++v) {
    mine.push_back({part.mesh.points[v][0], part.mesh.points[v][1], part.mesh.points[v][2]});
  }
  std::vector<std::int64_t> numbers(part.numbers.begin(),
                                    part.numbers.begin() + static_cast<std::ptrdiff_t>(part.num_owned_points));
  const std::vector<std::array<double, 3>> all = OfAllRanks(mine);
  numbers = OfAllRanks(numbers);
  TetMesh renumbered = whole;
  ASSERT_EQ(all.size(), whole.points.size());
  std::map<std::array<double, 3>, std::int64_t> number_at;
  for (std::size_t i = 0; i < all.size(); ++i) {
    number_at[all[i]] = numbers[i];
    renumbered.points[numbers[i]] = {all[i][0], all[i][1], all[i][2]};
  }
  for (auto& tet : renumbered.tets) {
    for (int& v : tet) v = static_cast<int>(number_at.at({whole.points[v][0], whole.points[v][1], whole.points[v][2]}));
  }
  ExpectPartsOf(renumbered, part);

  DMPlexGetDepthStratum(dm, 0, &begin, &end);
  ASSERT_EQ(plex_points.size(), static_cast<std::size_t>(end - begin));
  PetscSection section = nullptr;
  Vec coordinates = nullptr;
  const PetscScalar* values = nullptr;
  DMGetCoordinateSection(dm, &section);
  DMGetCoordinatesLocal(dm, &coordinates);
  VecGetArrayRead(coordinates, &values);
  for (PetscInt v = begin; v < end; ++v) {
    PetscInt offset = 0;
    PetscSectionGetOffset(section, v, &offset);
    EXPECT_EQ((part.mesh.points[plex_points[v - begin]] - Eigen::Map<const Eigen::Vector3d>(values + offset)).norm(),
              0);
  }
  VecRestoreArrayRead(coordinates, &values);
  // Each tagged face and edge is somewhere, those that all their owners see as often as ranks know them.
  std::set<std::vector<std::int64_t>> tagged;
  const auto add = [&](const auto& simplices) {
    for (const auto& simplex : simplices) {
      std::array<std::int64_t, 4> key = {-1, -1, -1, -1};
      for (std::size_t k = 0; k < simplex.size(); ++k) key[k] = part.numbers[simplex[k]];
      std::sort(key.begin(), key.end());
      tagged.insert({key.begin(), key.end()});
    }
  };
  add(part.mesh.surface_triangles);
  add(part.mesh.feature_edges);
  std::vector<Numbered> keys;
  for (const auto& key : tagged) keys.push_back({key[0], key[1], key[2], key[3]});
  keys = OfAllRanks(keys);
  EXPECT_EQ(std::set<Numbered>(keys.begin(), keys.end()).size(),
            static_cast<std::size_t>(OfAllRanks(std::vector<PetscInt>{num_tagged})[0]));
  EXPECT_EQ(part.mesh.regions.size(), part.mesh.tets.size());
  DMDestroy(&dm);
}

TEST(MeshPart, ReadsWhatPetscHasWritten) {
  const SharedFolder folder;
  const TetMesh whole = MakeBoxMesh({5, 4, 3}, {5, 4, 3});
  DM dm = Dealt(PlexOf(whole));
  PetscViewer viewer = nullptr;
  PetscViewerHDF5Open(PETSC_COMM_WORLD, (folder / "mesh.h5").c_str(), FILE_MODE_WRITE, &viewer);
  PetscViewerPushFormat(viewer, PETSC_VIEWER_HDF5_PETSC);
  ASSERT_EQ(DMView(dm, viewer), 0);
  PetscViewerDestroy(&viewer);
  DMDestroy(&dm);
  const MeshPart part = ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.h5");
  std::vector<std::int64_t> numbers(part.numbers.begin(),
                                    part.numbers.begin() + static_cast<std::ptrdiff_t>(part.num_owned_points));
  numbers = OfAllRanks(numbers);
  std::sort(numbers.begin(), numbers.end());
  ASSERT_EQ(numbers.size(), whole.points.size());
  for (std::size_t v = 0; v < numbers.size(); ++v) EXPECT_EQ(numbers[v], static_cast<std::int64_t>(v));
  double volume = 0;
  for (std::size_t t = 0; t < part.num_owned_tets; ++t) {
    const auto& [a, b, c, d] = part.mesh.tets[t];
    const auto& p = part.mesh.points;
    volume += std::abs((p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a])) / 6;
  }
  double sum = 0;
  for (const double share : OfAllRanks(std::vector<double>{volume})) sum += share;
  EXPECT_NEAR(sum, 60, 1e-10);
  const std::vector<int> has_tags = OfAllRanks(std::vector<int>{static_cast<int>(part.mesh.feature_edges.size()),
                                                                static_cast<int>(part.mesh.surface_triangles.size())});
  EXPECT_GT(*std::max_element(has_tags.begin(), has_tags.end()), 0);
}

TEST(MeshPart, RefusesADmplexOfOtherCells) {
  DM dm = nullptr;
  const PetscInt cells[] = {2, 2, 2};
  DMPlexCreateBoxMesh(PETSC_COMM_WORLD, 3, PETSC_FALSE, cells, nullptr, nullptr, nullptr, PETSC_TRUE, &dm);
  EXPECT_THROW(MeshPartOfPlex(dm), DistributedError);
  DMDestroy(&dm);
}

}  // namespace
}  // namespace octupole
