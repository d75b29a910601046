#include "octupole/view/map_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

// A box with itself, three quarters of a unit further, as parameters.
CornerParameters Shifted(const TetMesh& mesh) {
  CornerParameters parameters(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) parameters[t][i] = mesh.points[mesh.tets[t][i]] + Vector3d::Constant(0.75);
  }
  return parameters;
}

MapDomain BoxDomain() {
  const TetMesh mesh = MakeBoxMesh({2, 1, 1}, {3, 1, 1});
  return MakeMapDomain(mesh, std::vector<Eigen::Matrix3d>(mesh.points.size(), Eigen::Matrix3d::Identity()));
}

bool IsQuarter(double x) { return std::abs(x - std::floor(x) - 0.25) < 1e-12; }

// Planes at 1/4, 5/4, 9/4 across the length of 3, and at 1/4 across the others.
TEST(MakeMapScene, ShowsTheGridOfABox) {
  const MapDomain domain = BoxDomain();
  const Scene scene = MakeMapScene("box", domain, Shifted(domain.mesh), {});
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_TRUE(scene.surfaces[0].is_solid);
  const SceneSurface& grid = scene.surfaces[1];
  EXPECT_TRUE(grid.is_only_on_cut);
  double area = 0;
  for (const auto& [a, b, c] : grid.triangles) {
    const Vector3d n = (grid.points[b] - grid.points[a]).cross(grid.points[c] - grid.points[a]) / 2;
    area += n.norm();
  }
  EXPECT_NEAR(area, 3 * 1 + 2 * 3, 1e-12);
  for (const Vector3d& p : grid.points) EXPECT_TRUE(IsQuarter(p.x()) || IsQuarter(p.y()) || IsQuarter(p.z()));
  ASSERT_EQ(scene.lines.size(), 2u);
  EXPECT_TRUE(scene.lines[0].is_cut);
  double length = 0;
  for (const auto& [a, b] : scene.lines[0].segments)
    length += (scene.lines[0].points[a] - scene.lines[0].points[b]).norm();
  EXPECT_NEAR(length, 3 * 4 + 2 * (3 + 1 + 3 + 1), 1e-12);
  EXPECT_TRUE(scene.curves.empty());
  EXPECT_TRUE(scene.markers.empty());
}

TEST(MakeMapScene, MarksWhatStandsInTheWay) {
  const MapDomain domain = BoxDomain();
  const auto obstacles = FindObstacles(domain, {0});
  ASSERT_FALSE(obstacles.empty());
  const Scene scene = MakeMapScene("box", domain, Shifted(domain.mesh), obstacles);
  ASSERT_EQ(scene.markers.size(), obstacles.size());
  EXPECT_EQ(scene.markers.back().label, obstacles.back().Describe());
}

// A quarter turn of the frames around the middle: one curve of valence 3 from bottom to top.
TEST(MakeMapScene, JoinsSingularEdgesToCurves) {
  const TetMesh mesh = MakeBoxMesh({6, 6, 3}, {6, 6, 3});
  std::vector<Eigen::Matrix3d> frames;
  for (const Vector3d& p : mesh.points) {
    frames.push_back(Eigen::AngleAxisd(std::atan2(p.y() - 2.9, p.x() - 3.1) / 4, Vector3d::UnitZ()).toRotationMatrix());
  }
  const MapDomain domain = MakeMapDomain(mesh, frames);
  const Scene scene = MakeMapScene("box", domain, CornerParameters(domain.mesh.tets.size(), {Vector3d(0, 0, 0)}), {});
  ASSERT_EQ(scene.curves.size(), 1u);
  EXPECT_EQ(scene.curves[0].points.size(), domain.singular_edges.size() + 1);
  EXPECT_NEAR(std::abs(scene.curves[0].points.front().z() - scene.curves[0].points.back().z()), 3, 1e-12);
  EXPECT_EQ(scene.kinds[scene.curves[0].kind].name, "valence 3");
}

TEST(MakeMapScene, WantsParametersForEveryTet) {
  EXPECT_THROW(MakeMapScene("box", BoxDomain(), {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
