#include "octupole/mesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "test_files.h"

namespace octupole {
namespace {

TetMesh OneTet() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}}; }

std::string CheckMessage(const TetMesh& mesh) {
  return MessageOf<std::invalid_argument>([&] { CheckTetMesh(mesh); });
}

TEST(CheckTetMesh, AcceptsInvertedAndFlatTets) {
  TetMesh mesh = OneTet();
  CheckTetMesh(mesh);
  mesh.tets[0] = {1, 0, 2, 3};
  mesh.regions = {-7};
  CheckTetMesh(mesh);
  mesh.points[3].setZero();
  CheckTetMesh(mesh);
}

TEST(CheckTetMesh, NamesWhatIsWrong) {
  EXPECT_EQ(CheckMessage({}), "CheckTetMesh: the mesh has no tetrahedra");

  TetMesh mesh = OneTet();
  mesh.regions = {1, 2};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: 2 regions for 1 tetrahedra");

  mesh = OneTet();
  mesh.points[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: point 2 has the coordinate inf");

  mesh = OneTet();
  mesh.tets.push_back({3, 2, 1, 4});
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: tetrahedron 1 has the vertex index 4, out of range 0..3");
  mesh.tets[1] = {-1, 2, 1, 0};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: tetrahedron 1 has the vertex index -1, out of range 0..3");
  mesh.tets[1] = {3, 2, 1, 2};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: tetrahedron 1 has vertex 2 twice");

  mesh = OneTet();
  mesh.feature_edges = {{0, 1}, {2, 4}};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: feature edge 1 has the vertex index 4, out of range 0..3");
  mesh.feature_edges[1] = {2, 2};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: feature edge 1 has vertex 2 twice");
  mesh.feature_edges.clear();
  mesh.feature_points = {0, -1};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: feature point 1 has the vertex index -1, out of range 0..3");

  mesh = OneTet();
  mesh.surface_triangles = {{0, 1, 2}};
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: 0 surface tags for 1 surface triangles");
  mesh.surface_tags = {1};
  EXPECT_EQ(CheckMessage(mesh), "");
  mesh.surface_triangles[0][2] = 4;
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: surface triangle 0 has the vertex index 4, out of range 0..3");

  mesh = OneTet();
  mesh.points.emplace_back(0.5, 0, 0);
  mesh.mid_edge_nodes = {{4, 0, 1}};
  EXPECT_EQ(CheckMessage(mesh), "");
  mesh.mid_edge_nodes.push_back({4, 5, 1});
  EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: mid-edge node 1 has the vertex index 5, out of range 0..4");
  for (const std::array<int, 3>& bad : {std::array{2, 0, 1}, std::array{0, 1, 4}}) {
    mesh.mid_edge_nodes[1] = bad;
    EXPECT_EQ(CheckMessage(mesh), "CheckTetMesh: mid-edge node 1: vertex " + std::to_string(bad[0]) + " between " +
                                      std::to_string(bad[1]) + " and " + std::to_string(bad[2]) +
                                      " is in a tetrahedron, or one of them in none");
  }
}

}  // namespace
}  // namespace octupole
