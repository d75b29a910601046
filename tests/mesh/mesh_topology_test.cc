#include "octupole/mesh/mesh_topology.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "octupole/mesh/box_mesh.h"

namespace octupole {
namespace {

Eigen::Vector3d AreaVector(const TetMesh& mesh, const std::array<int, 3>& triangle) {
  const Eigen::Vector3d& a = mesh.points[triangle[0]];
  return 0.5 * (mesh.points[triangle[1]] - a).cross(mesh.points[triangle[2]] - a);
}

/// A box whose inner vertices are moved, so that no two tetrahedra are alike.
TetMesh ShakenBox() {
  TetMesh mesh = MakeBoxMesh({4, 3, 2}, {4.0, 3.0, 2.0});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-0.1, 0.1);
  for (Eigen::Vector3d& p : mesh.points) {
    p += Eigen::Vector3d(offset(random), offset(random), offset(random));
  }
  return mesh;
}

/// The triangle, starting at its smallest vertex.
std::array<int, 3> Rotated(std::array<int, 3> triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

TEST(MeshTopology, CountsOfABox) {
  const int x = 4, y = 3, z = 2;
  const TetMesh mesh = MakeBoxMesh({x, y, z}, {1, 1, 1});
  const int grid_edges = x * (y + 1) * (z + 1) + (x + 1) * y * (z + 1) + (x + 1) * (y + 1) * z;
  const int face_diagonals = x * y * (z + 1) + x * (y + 1) * z + (x + 1) * y * z;
  const int cell_diagonals = x * y * z;
  const int num_edges = static_cast<int>(MeshEdges(mesh).size());
  const int num_triangles = static_cast<int>(MeshTriangles(mesh).size());
  EXPECT_EQ(num_edges, grid_edges + face_diagonals + cell_diagonals);
  // The Euler characteristic of a ball.
  EXPECT_EQ(static_cast<int>(mesh.points.size()) - num_edges + num_triangles - static_cast<int>(mesh.tets.size()), 1);
  // Every tetrahedron has four triangles; those inside belong to two.
  EXPECT_EQ(2 * num_triangles - static_cast<int>(BoundaryTriangles(mesh).size()),
            4 * static_cast<int>(mesh.tets.size()));
}

TEST(MeshTopology, ListsAreSortedAndUnique) {
  const TetMesh mesh = ShakenBox();
  const auto check = [](const auto& list) {
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    EXPECT_EQ(std::adjacent_find(list.begin(), list.end()), list.end());
    for (const auto& simplex : list) {
      EXPECT_TRUE(std::is_sorted(simplex.begin(), simplex.end()));
    }
  };
  check(MeshEdges(mesh));
  check(MeshTriangles(mesh));
}

TEST(MeshTopology, OneTet) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{3, 1, 0, 2}}, {}};
  EXPECT_EQ(MeshEdges(mesh), (std::vector<std::array<int, 2>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(MeshTriangles(mesh), (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}));
  std::vector<std::array<int, 3>> boundary;
  for (const std::array<int, 3>& triangle : BoundaryTriangles(mesh)) {
    boundary.push_back(Rotated(triangle));
  }
  EXPECT_EQ(boundary, (std::vector<std::array<int, 3>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
}

TEST(MeshTopology, BoundaryIsClosedAndFacesOutward) {
  const TetMesh mesh = ShakenBox();
  const std::vector<double> volumes = SixfoldVolumes(mesh);
  const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0) / 6.0;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  double flux = 0.0;
  for (const std::array<int, 3>& triangle : BoundaryTriangles(mesh)) {
    const Eigen::Vector3d vector = AreaVector(mesh, triangle);
    area += vector;
    flux += vector.dot(mesh.points[triangle[0]]) / 3.0;
  }
  EXPECT_NEAR(area.norm(), 0.0, 1e-12);
  EXPECT_NEAR(flux, volume, 1e-12);
}

TEST(MeshTopology, BoundaryDoesNotDependOnOrientations) {
  TetMesh mesh = ShakenBox();
  const std::vector<std::array<int, 3>> expected = BoundaryTriangles(mesh);
  std::mt19937 random(2);
  for (std::array<int, 4>& tet : mesh.tets) {
    std::shuffle(tet.begin(), tet.end(), random);
  }
  const std::vector<double> volumes = SixfoldVolumes(mesh);
  ASSERT_LT(*std::min_element(volumes.begin(), volumes.end()), 0.0);
  const std::vector<std::array<int, 3>> boundary = BoundaryTriangles(mesh);
  ASSERT_EQ(boundary.size(), expected.size());
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    EXPECT_EQ(Rotated(boundary[i]), Rotated(expected[i]));
  }
}

}  // namespace
}  // namespace octupole
