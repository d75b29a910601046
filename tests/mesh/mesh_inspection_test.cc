#include "octupole/mesh/mesh_inspection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TetMesh Box() { return MakeBoxMesh({2, 2, 2}, {1, 1, 1}); }

std::vector<std::string> Warnings(const TetMesh& mesh) { return MeshWarnings(InspectMesh(mesh)); }

/// Appends another mesh and returns the index of its first vertex.
int Append(const TetMesh& other, TetMesh* mesh) {
  const int first = static_cast<int>(mesh->points.size());
  mesh->points.insert(mesh->points.end(), other.points.begin(), other.points.end());
  for (std::array<int, 4> tet : other.tets) {
    for (int& v : tet) {
      v += first;
    }
    mesh->tets.push_back(tet);
  }
  return first;
}

TEST(InspectMesh, CleanMesh) {
  const MeshInspection inspection = InspectMesh(Box());
  EXPECT_EQ(inspection.tets, 48);
  EXPECT_EQ(inspection.components, 1);
  EXPECT_THAT(MeshWarnings(inspection), IsEmpty());
}

TEST(InspectMesh, InvertedTets) {
  TetMesh mesh = Box();
  std::swap(mesh.tets[5][0], mesh.tets[5][1]);
  EXPECT_THAT(Warnings(mesh), ElementsAre("1 tetrahedron is inverted"));
  std::swap(mesh.tets[6][0], mesh.tets[6][1]);
  EXPECT_THAT(Warnings(mesh), ElementsAre("2 tetrahedra are inverted"));
}

TEST(InspectMesh, AllTetsInverted) {
  TetMesh mesh = Box();
  for (std::array<int, 4>& tet : mesh.tets) {
    std::swap(tet[2], tet[3]);
  }
  EXPECT_THAT(Warnings(mesh), ElementsAre("all tetrahedra are negatively oriented"));
}

// Far from the origin coordinates are rounded, and with them what is flat.
TEST(InspectMesh, ZeroVolumeAllowsForTheRoundingOfCoordinates) {
  TetMesh mesh;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0.1, 0.3), Eigen::Vector3d(0.2, 1, 0.7)}) {
    mesh.points.emplace_back(p);
  }
  mesh.points.emplace_back(0.3 * mesh.points[1] + 0.4 * mesh.points[2]);
  for (Eigen::Vector3d& p : mesh.points) p += Eigen::Vector3d(1e6, 2e6, 3e6);
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_GT(std::abs(SixfoldVolumes(mesh)[0]), 1e-11) << "rounding shows";
  EXPECT_EQ(InspectMesh(mesh).zero_volume_tets, 1);
}

TEST(InspectMesh, ZeroVolumeIsRelative) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    for (const double height : {1e-14, 1e-9}) {
      TetMesh mesh{{{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {0.1, 1.2, 0.3}, {0.3, 0.4, 0.3 + height}}, {{0, 1, 2, 3}}, {}};
      for (Eigen::Vector3d& p : mesh.points) {
        p *= scale;
      }
      EXPECT_EQ(InspectMesh(mesh).zero_volume_tets, height < 1e-12 ? 1 : 0);
    }
  }
  TetMesh shifted = MakeBoxMesh({2, 2, 2}, {1e-3, 1e-3, 1e-3});
  for (Eigen::Vector3d& p : shifted.points) {
    p.array() += 1e6;
  }
  EXPECT_THAT(Warnings(shifted), IsEmpty());
  // Squeezed to the last digit of its coordinates, the sign of a volume is rounding error.
  for (Eigen::Vector3d& p : shifted.points) {
    p.z() = 1e6 + 1e-9 * (p.z() - 1e6);
  }
  EXPECT_EQ(InspectMesh(shifted).zero_volume_tets, 48);
}

TEST(InspectMesh, DuplicateTets) {
  TetMesh mesh = Box();
  const std::array<int, 4> tet = mesh.tets[0];
  mesh.tets.push_back({tet[2], tet[0], tet[1], tet[3]});  // an even permutation
  mesh.tets.push_back(tet);
  EXPECT_EQ(InspectMesh(mesh).duplicate_tets, 2);
}

TEST(InspectMesh, IsolatedAndDuplicateVertices) {
  TetMesh mesh = Box();
  // An unused copy is no crack. Minus zero is the same place as zero.
  mesh.points.push_back(mesh.points[1]);
  EXPECT_THAT(Warnings(mesh), ElementsAre("1 vertex belongs to no tetrahedron"));
  mesh.points.push_back(-mesh.points[0]);
  std::replace(mesh.tets[0].begin(), mesh.tets[0].end(), 0, 28);
  const MeshInspection inspection = InspectMesh(mesh);
  EXPECT_EQ(inspection.isolated_vertices, 1);
  EXPECT_EQ(inspection.duplicate_vertices, 1);
}

TEST(InspectMesh, Components) {
  TetMesh mesh = Box();
  TetMesh other = Box();
  for (Eigen::Vector3d& p : other.points) {
    p.x() += 2.0;
  }
  const int first = Append(other, &mesh);
  EXPECT_THAT(Warnings(mesh), ElementsAre("the mesh has 2 separate components"));
  for (std::array<int, 4>& tet : mesh.tets) {
    std::replace(tet.begin(), tet.end(), first, 26);
  }
  EXPECT_EQ(InspectMesh(mesh).components, 1);
}

TEST(InspectMesh, NonManifoldBoundaryEdge) {
  // Two tetrahedra on opposite sides of a common edge: four boundary triangles meet there.
  const TetMesh mesh{
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 2, 3, 1}, {0, 4, 5, 1}}, {}};
  EXPECT_THAT(Warnings(mesh), ElementsAre("1 edge of the boundary is not shared by exactly two of its triangles"));
}

TEST(InspectMesh, OverfullTriangle) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}},
                     {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 2, 1, 5}},
                     {}};
  EXPECT_EQ(InspectMesh(mesh).overfull_triangles, 1);
}

TEST(MeanRatios, IsOneForRegularTets) {
  TetMesh mesh{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {5, 5, 5}}, {{0, 1, 2, 3}, {1, 0, 2, 3}}, {}};
  const double sign = MeanRatios(mesh)[0] < 0 ? -1 : 1;
  EXPECT_NEAR(sign * MeanRatios(mesh)[0], 1, 1e-15);
  EXPECT_NEAR(sign * MeanRatios(mesh)[1], -1, 1e-15);
  // The corner of a cube: V = 1/6 and squared lengths 1, 1, 1, 2, 2, 2.
  mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  EXPECT_NEAR(MeanRatios(mesh)[0], 12 * std::pow(0.5, 2. / 3) / 9, 1e-15);
  for (Eigen::Vector3d& p : mesh.points) p *= 1e-9;
  EXPECT_NEAR(MeanRatios(mesh)[0], 12 * std::pow(0.5, 2. / 3) / 9, 1e-15);
  mesh.points[3].setZero();
  EXPECT_EQ(MeanRatios(mesh)[0], 0);
}

TEST(MeshWarnings, OneLineForEachKind) {
  MeshInspection inspection;
  inspection.tets = 100;
  inspection.inverted_tets = 2;
  inspection.zero_volume_tets = 12;
  inspection.duplicate_tets = 3;
  inspection.isolated_vertices = 4;
  inspection.duplicate_vertices = 5;
  inspection.components = 6;
  inspection.overfull_triangles = 7;
  inspection.non_manifold_boundary_edges = 8;
  EXPECT_THAT(MeshWarnings(inspection),
              ElementsAre("2 tetrahedra are inverted", "12 tetrahedra have zero volume", "3 tetrahedra repeat another",
                          "4 vertices belong to no tetrahedron", "5 vertices coincide with another (cracks?)",
                          "the mesh has 6 separate components", "7 triangles belong to more than two tetrahedra",
                          "8 edges of the boundary are not shared by exactly two of its triangles"));
}

}  // namespace
}  // namespace octupole
