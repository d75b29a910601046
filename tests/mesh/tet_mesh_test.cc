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
}

}  // namespace
}  // namespace octupole
