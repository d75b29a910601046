#include "octupole/view/field_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::vector<Eigen::Matrix3d> Constant(const std::vector<Vector3d>& points) {
  return std::vector<Eigen::Matrix3d>(points.size(), Eigen::Matrix3d::Identity());
}

TEST(MakeFieldScene, ShowsTheBoundaryOfABox) {
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const Scene scene = MakeFieldScene("box", mesh, Constant(mesh.points), {}, {}, {});
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_TRUE(scene.surfaces[0].is_solid);
  EXPECT_EQ(scene.surfaces[0].triangles.size(), 6u * 4 * 2);
  EXPECT_EQ(scene.surfaces[0].points.size(), 26u);  // without the one inside
  EXPECT_EQ(scene.lines[0].segments.size(), 12u * 2);
  ASSERT_EQ(scene.boxes[0].centers.size(), 27u);
  for (const double value : scene.boxes[0].values) EXPECT_NEAR(value, 0, 1e-12);
  for (const double spacing : scene.boxes[0].spacings) {  // edges, diagonals of faces and of cells
    EXPECT_GE(spacing, 0.5);
    EXPECT_LE(spacing, 0.5 * std::sqrt(3.));
  }
}

TEST(MakeFieldScene, ShowsInterfaces) {
  const TetMesh mesh = MakeBoxMesh({2, 1, 1}, {2, 1, 1});
  std::vector<std::array<int, 3>> interfaces;
  for (const auto& triangle : MeshTriangles(mesh)) {
    if (std::all_of(triangle.begin(), triangle.end(), [&](int v) { return mesh.points[v].x() == 1; })) {
      interfaces.push_back(triangle);
    }
  }
  const Scene scene = MakeFieldScene("box", mesh, Constant(mesh.points), interfaces, {}, {});
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_EQ(scene.surfaces[1].name, "interfaces");
  EXPECT_EQ(scene.surfaces[1].triangles.size(), 2u);
  for (const Vector3d& point : scene.surfaces[1].points) EXPECT_EQ(point.x(), 1);
}

TEST(MakeFieldScene, ColoursByTheMeanDifference) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  auto frames = Constant(mesh.points);
  constexpr double kAngle = 0.01;
  frames[0] = Eigen::AngleAxisd(kAngle, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Scene scene = MakeFieldScene("box", mesh, frames, {}, {}, {});
  // All edges at vertex 0 differ by the angle: 16 times its square (theory.md, section 3).
  EXPECT_NEAR(scene.boxes[0].values[0], 16 * kAngle * kAngle, 1e-6);
  for (const double value : scene.boxes[0].values) EXPECT_LE(value, scene.boxes[0].values[0]);
}

TEST(MakeFieldScene, SaysWhatCurvesAre) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  SingularCurves curves;
  curves.curves.push_back(
      {TurnType::kQuarter, 5, {{0, 0, 0}, {1, 0, 0}}, 1, 1, {CurveEnd::kBoundary, CurveEnd::kNode}});
  curves.curves.push_back({TurnType::kThird, 0, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 2, 0, {}});
  curves.nodes.push_back({{1, 0, 0}, 4});
  const Scene scene = MakeFieldScene("box", mesh, Constant(mesh.points), {}, curves, {{{0, 0, 0}, -1}, {{0, 0, 1}, 2}});
  ASSERT_EQ(scene.curves.size(), 2u);
  EXPECT_EQ(scene.curves[0].label, "valence 5\nquarter turn, index -1/4\nlength 1\nends: boundary, node");
  EXPECT_EQ(scene.kinds[scene.curves[0].kind].name, "valence 5, index -1/4");
  EXPECT_EQ(scene.curves[1].label, "no valence\nthird of a turn\nlength 2, closed");
  ASSERT_EQ(scene.markers.size(), 3u);
  EXPECT_EQ(scene.markers[0].label, "node of 4 curve ends");
  EXPECT_EQ(scene.markers[1].label, "point on the boundary\nindex -1/4");
  EXPECT_EQ(scene.markers[2].label, "point on the boundary\nindex 1/2");
}

TEST(MakeFieldScene, WantsOneFramePerPoint) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  EXPECT_THROW(MakeFieldScene("box", mesh, {}, {}, {}, {}), std::invalid_argument);
}

TEST(MakeSurfaceScene, ShowsAnOpenSurfaceWithItsBorder) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Scene scene = MakeSurfaceScene("square", mesh, Constant(mesh.points), {});
  EXPECT_FALSE(scene.surfaces[0].is_solid);
  EXPECT_TRUE(scene.boxes[0].are_flat);
  EXPECT_EQ(scene.lines[0].segments.size(), 4u);
}

}  // namespace
}  // namespace octupole
