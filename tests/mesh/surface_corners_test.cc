#include "octupole/mesh/surface_corners.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

TEST(TriangleNormal, IsRightHandedAndZeroForFlatTriangles) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {5, 0, 0}};
  EXPECT_EQ(TriangleNormal(points, {0, 1, 2}), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(TriangleNormal(points, {0, 2, 1}), -Eigen::Vector3d::UnitZ());
  EXPECT_EQ(TriangleNormal(points, {0, 1, 3}), Eigen::Vector3d::Zero());
}

// The angles around a point of a flat surface make a full turn, at a corner of a box three right angles.
TEST(SurfaceCorners, HaveTheAnglesAroundEachPoint) {
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 2, 3});
  const auto corners_of = SurfaceCorners(mesh.points, BoundaryTriangles(mesh));
  const auto sum = [&](int v) {
    double angle = 0;
    for (const SurfaceCorner& corner : corners_of[v]) angle += corner.angle;
    return angle;
  };
  EXPECT_NEAR(sum(0), 1.5 * EIGEN_PI, 1e-14);
  EXPECT_NEAR(sum(1), 2 * EIGEN_PI, 1e-14);
  EXPECT_NEAR(sum(4), 2 * EIGEN_PI, 1e-14);
  EXPECT_TRUE(corners_of[13].empty()) << "the centre of the box is not on its surface";
}

TEST(NormalsAgree, ComparesEveryPair) {
  const auto at = [](double degrees) {
    const double t = degrees * EIGEN_PI / 180;
    return SurfaceCorner{{std::cos(t), std::sin(t), 0}, 1};
  };
  EXPECT_TRUE(NormalsAgree({at(0), at(20), at(39)}, 40));
  EXPECT_FALSE(NormalsAgree({at(0), at(20), at(41)}, 40));
  EXPECT_FALSE(NormalsAgree({at(0), {Eigen::Vector3d::Zero(), 1}}, 40));
}

TEST(VertexNormals, OfABoxPointAlongItsDiagonals) {
  // The angles at a corner of a box add up to a right angle on each face, however the faces are
  // triangulated. At the edges and on the faces they add up alike.
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {2.0, 4.0, 10.0});
  const std::vector<Eigen::Vector3d> normals = VertexNormals(mesh.points, BoundaryTriangles(mesh));
  const Eigen::Vector3d center(1.0, 2.0, 5.0);
  ASSERT_EQ(normals.size(), mesh.points.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Eigen::Vector3d outward = (mesh.points[v] - center).cwiseSign();
    EXPECT_NEAR((normals[v] - outward.normalized()).norm(), 0.0, 1e-14) << "vertex " << v;
  }
}

TEST(VertexNormals, IgnoreFlatTrianglesAtAnyScale) {
  for (const double scale : {1e-60, 1e-9, 1.0, 1e9, 1e60}) {
    // Vertex 3 is the rounded middle of the edge 1-2; vertex 4 is unused.
    const std::vector<Eigen::Vector3d> points = {
        scale * Eigen::Vector3d(0.0, 0.0, 0.0), scale * Eigen::Vector3d(0.1, 0.7, 0.0),
        scale * Eigen::Vector3d(0.7, 0.1, 0.0), scale * Eigen::Vector3d(0.4, 0.4, 1e-17),
        scale * Eigen::Vector3d(0.0, 0.0, 1.0)};
    const std::vector<Eigen::Vector3d> normals = VertexNormals(points, {{0, 1, 2}, {1, 3, 2}, {1, 1, 2}});
    for (const int v : {0, 1, 2}) {
      EXPECT_EQ(normals[v], Eigen::Vector3d(0, 0, -1)) << "vertex " << v << ", scale " << scale;
    }
    EXPECT_EQ(normals[3], Eigen::Vector3d::Zero());
    EXPECT_EQ(normals[4], Eigen::Vector3d::Zero());
  }
}

TEST(VertexNormals, AreZeroWhereTheyCancel) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {0.3, 0.1, 0}, {0, 0.2, 0.7}};
  for (const Eigen::Vector3d& normal : VertexNormals(points, {{0, 1, 2}, {0, 2, 1}})) {
    EXPECT_EQ(normal, Eigen::Vector3d::Zero());
  }
}

}  // namespace
}  // namespace octupole
