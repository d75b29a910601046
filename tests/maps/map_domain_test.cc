#include "octupole/maps/map_domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/maps/map_obstacles.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/tet_neighbours.h"
#include "part_of_mesh.h"
#include "random_inputs.h"
#include "rib_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

using testing::HasSubstr;
using Frames = std::vector<Eigen::Matrix3d>;

Frames ConstantFrames(const TetMesh& mesh) { return Frames(mesh.points.size(), Eigen::Matrix3d::Identity()); }

// Frames turned about the z axis by `turns` of the angle around the middle of a box.
Frames TurningFrames(const TetMesh& mesh, const Eigen::Vector3d& middle, double turns) {
  Frames frames;
  for (const Eigen::Vector3d& p : mesh.points) {
    const double angle = turns * std::atan2(p.y() - middle.y(), p.x() - middle.x());
    frames.push_back(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  }
  return frames;
}

Frames RandomFrames(const TetMesh& mesh, unsigned seed) {
  std::mt19937 generator(seed);
  Frames frames;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) frames.push_back(RandomFrame(&generator));
  return frames;
}

double VolumeOf(const TetMesh& mesh) {
  double sum = 0;
  for (const double v : SixfoldVolumes(mesh)) sum += v / 6;
  return sum;
}

TEST(MapDomain, OfAConstantFieldOnABoxNeedsNoCut) {
  const TetMesh mesh = MakeBoxMesh({4, 3, 2}, {4, 3, 2});
  const MapDomain domain = MakeMapDomain(mesh, ConstantFrames(mesh));
  EXPECT_TRUE(domain.singular_edges.empty());
  EXPECT_TRUE(domain.cut.faces.empty());
  EXPECT_TRUE(domain.collapsed.empty());
  ASSERT_EQ(domain.sheets.sheets.size(), 6u);
  double area = 0;
  for (const auto& sheet : domain.sheets.sheets) area += sheet.area;
  EXPECT_NEAR(area, 2 * (12 + 8 + 6), 1e-12);
  // A parameter of each vertex, but for one of each sheet.
  const int num_points = static_cast<int>(mesh.points.size());
  EXPECT_EQ(domain.unknowns.num_unknowns, 3 * num_points - 2 * (4 * 3 + 5 * 3 + 5 * 4) + 6);
}

// A quarter turn of the field around the middle, with the angle around it or against it.
TEST(MapDomain, TellsValenceThreeFromFive) {
  for (const int sign : {1, -1}) {
    const TetMesh mesh = MakeBoxMesh({6, 6, 3}, {6, 6, 3});
    const MapDomain domain = MakeMapDomain(mesh, TurningFrames(mesh, {3.1, 2.9, 0}, sign * 0.25));
    ASSERT_FALSE(domain.singular_edges.empty());
    double height = 0;
    for (const SingularEdge& edge : domain.singular_edges) {
      EXPECT_EQ(edge.type, TurnType::kQuarter);
      EXPECT_EQ(edge.valence, sign > 0 ? 3 : 5);
      height += std::abs(domain.mesh.points[edge.vertices[0]].z() - domain.mesh.points[edge.vertices[1]].z());
    }
    EXPECT_NEAR(height, 3, 1e-12) << "one curve from bottom to top";
    EXPECT_TRUE(domain.collapsed.empty());
  }
}

// What is glued needs no turn, and around every inner edge that is not singular the matches multiply to the identity.
TEST(MapDomain, GluesWithoutTurnsAndKeepsRegularEdgesRegular) {
  const TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const MapDomain domain = MakeMapDomain(mesh, RandomFrames(mesh, 3));
  std::vector<bool> is_singular(domain.rings.size(), false);
  for (const SingularEdge& edge : domain.singular_edges) is_singular[edge.ring] = true;
  ASSERT_FALSE(domain.singular_edges.empty());
  for (std::size_t r = 0; r < domain.rings.size(); ++r) {
    if (!domain.rings.is_closed[r]) continue;
    EXPECT_EQ(TurnAround(domain.combed, domain.rings, r) != OctahedralRotation(), is_singular[r]);
  }
  std::set<std::pair<int, int>> cut;
  for (const MapCut::Face& face : domain.cut.faces) {
    cut.insert(std::minmax(face.tet, domain.combed.neighbours[face.tet][face.corner]));
  }
  for (int t = 0; t < static_cast<int>(domain.mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = domain.combed.neighbours[t][i];
      if (s < t || cut.count({t, s}) > 0) continue;
      EXPECT_EQ(domain.combed.matches[t][i], 0);
      for (int k = 0; k < 4; ++k) {
        if (k == i) continue;
        const int corner = CornerOf(domain.mesh.tets[s], domain.mesh.tets[t][k]);
        EXPECT_EQ(domain.cut.nodes[t][k], domain.cut.nodes[s][corner]);
      }
    }
  }
}

// The frame and its matches do not depend on how axes are named.
TEST(MapDomain, DoesNotDependOnTheNamesOfAxes) {
  const TetMesh mesh = MakeBoxMesh({5, 5, 2}, {5, 5, 2});
  const Frames frames = TurningFrames(mesh, {2.6, 2.3, 0}, 0.25);
  Frames renamed = frames;
  std::mt19937 generator(5);
  for (Eigen::Matrix3d& frame : renamed) frame *= OctahedralGroup()[generator() % 24].matrix();
  const MapDomain one = MakeMapDomain(mesh, frames), other = MakeMapDomain(mesh, renamed);
  ASSERT_EQ(one.singular_edges.size(), other.singular_edges.size());
  for (std::size_t i = 0; i < one.singular_edges.size(); ++i) {
    EXPECT_EQ(one.singular_edges[i].vertices, other.singular_edges[i].vertices);
    EXPECT_EQ(one.singular_edges[i].valence, other.singular_edges[i].valence);
  }
  EXPECT_EQ(one.unknowns.num_unknowns, other.unknowns.num_unknowns);
}

// Whatever the unknowns are, on however wild a field: all faces of a patch of the cut have one shift, and all sheets
// are flat.
TEST(MapUnknowns, KeepSeamsAndBoundary) {
  for (const unsigned seed : {1, 2}) {
    const TetMesh mesh = MakeBoxMesh({3, 3, 3}, {1, 1, 1});
    const MapDomain domain = MakeMapDomain(mesh, RandomFrames(mesh, seed));
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> y(domain.unknowns.num_unknowns);
    for (double& value : y) value = uniform(generator);
    const std::vector<double> u = domain.unknowns.Parameters(y);
    const auto at = [&](int t, int i) { return Eigen::Map<const Eigen::Vector3d>(&u[3 * domain.cut.nodes[t][i]]); };
    std::vector<Eigen::Vector3d> shift(domain.cut.num_patches, Eigen::Vector3d::Constant(NAN));
    ASSERT_FALSE(domain.cut.faces.empty());
    for (const MapCut::Face& face : domain.cut.faces) {
      const int t = domain.combed.neighbours[face.tet][face.corner];
      const Eigen::Matrix3d g = domain.combed.match(face.tet, face.corner).matrix();
      for (int i = 0; i < 4; ++i) {
        if (i == face.corner) continue;
        const int k = CornerOf(domain.mesh.tets[t], domain.mesh.tets[face.tet][i]);
        const Eigen::Vector3d here = at(t, k) - g.transpose() * at(face.tet, i);
        if (std::isnan(shift[face.patch].x())) shift[face.patch] = here;
        EXPECT_LT((here - shift[face.patch]).norm(), 1e-9);
      }
    }
    for (const BoundarySheets::Face& face : domain.sheets.faces) {
      if (face.is_released) continue;
      const double first = at(face.tet, (face.corner + 1) % 4)[face.axis];
      for (int i = 2; i < 4; ++i) EXPECT_NEAR(at(face.tet, (face.corner + i) % 4)[face.axis], first, 1e-9);
    }
  }
}

// Two regions that meet at x = 2, and a marked line through the middle: on the one x is constant, along the other y and
// z.
TEST(MapUnknowns, HoldInterfacesAndFeatures) {
  TetMesh mesh = MakeBoxMesh({4, 2, 2}, {4, 2, 2});
  const int plain = MakeMapDomain(mesh, ConstantFrames(mesh)).unknowns.num_unknowns;
  for (const auto& tet : mesh.tets) {
    double x = 0;
    for (const int v : tet) x += mesh.points[v].x() / 4;
    mesh.regions.push_back(x < 2 ? 3 : 7);
  }
  std::vector<int> line;
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
    if (mesh.points[v].tail<2>() == Eigen::Vector2d(1, 1)) line.push_back(v);
  }
  ASSERT_EQ(line.size(), 5u);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) mesh.feature_edges.push_back({line[i], line[i + 1]});
  const MapDomain domain = MakeMapDomain(mesh, ConstantFrames(mesh));
  EXPECT_EQ(domain.mesh.tets.size(), mesh.tets.size());
  EXPECT_EQ(domain.sheets.sheets.size(), 7u);
  EXPECT_EQ(domain.unknowns.num_unknowns, plain - 8 - 2 * 4);
  const std::vector<bool>& is_integer = domain.unknowns.is_integer;
  EXPECT_EQ(std::count(is_integer.begin(), is_integer.end(), true), 7 + 2);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> y(domain.unknowns.num_unknowns);
  for (double& value : y) value = uniform(generator);
  const std::vector<double> u = domain.unknowns.Parameters(y);
  std::set<double> on_interface, y_on_line, z_on_line;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      const auto parameter = [&](int direction) {
        int axis;  // whatever it is called
        domain.combed.frames[t].row(direction).cwiseAbs().maxCoeff(&axis);
        return std::abs(u[3 * domain.cut.nodes[t][i] + axis]);
      };
      const Eigen::Vector3d& p = mesh.points[mesh.tets[t][i]];
      if (p.x() == 2) on_interface.insert(parameter(0));
      if (p.tail<2>() == Eigen::Vector2d(1, 1)) {
        y_on_line.insert(parameter(1));
        z_on_line.insert(parameter(2));
      }
    }
  }
  EXPECT_EQ(on_interface.size(), 1u);
  EXPECT_EQ(y_on_line.size(), 1u);
  EXPECT_EQ(z_on_line.size(), 1u);
  BoundaryOptions ignored;
  ignored.regions = RegionUse::kIgnore;
  EXPECT_EQ(MakeMapDomain(mesh, ConstantFrames(mesh), ignored).sheets.sheets.size(), 6u);
}

// A curve comes up from the bottom, turns around and ends on a ledge a cell below, from above: it has valence 3 up to
// there and 5 on the last edge. In a map it would go on upwards, so that the ledge has to give way at its end.
TEST(MapDomain, ReleasesTheEndOfACurveThatEndsBackwards) {
  const TetMesh mesh =
      PartOf(MakeBoxMesh({5, 3, 100}, {5, 3, 100}), [](const Eigen::Vector3d& p) { return p.x() <= 2 || p.z() >= 98; });
  Frames frames;
  for (const Eigen::Vector3d& p : mesh.points) {
    const auto around = [&](double x) { return std::atan2(p.y() - 1.6, p.x() - x); };
    const double angle = p.z() < 98.5 ? (around(1.4) - around(3.4)) / 4 : 0;
    frames.push_back(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  }
  const MapDomain domain = MakeMapDomain(mesh, frames);
  const auto count = [&](int valence) {
    return std::count_if(domain.singular_edges.begin(), domain.singular_edges.end(),
                         [&](const SingularEdge& edge) { return edge.valence == valence; });
  };
  EXPECT_GE(count(3), 100);
  EXPECT_EQ(count(5), 1);
  ASSERT_EQ(domain.released_vertices.size(), 1u);
  EXPECT_EQ(domain.mesh.points[*domain.released_vertices.begin()], Eigen::Vector3d(3, 2, 98));
}

// A triangle of the bottom between two edges of one crease has all corners on the front, too: it would be flat, unless
// the edge across is split.
TEST(MapDomain, SplitsChordsOfCreases) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, -0.1, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0.1, 1}};
  mesh.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}};
  BoundaryOptions no_features;
  no_features.feature_angle_deg = 179;
  const MapDomain domain = MakeMapDomain(mesh, ConstantFrames(mesh), no_features);
  EXPECT_TRUE(domain.collapsed.empty());
  EXPECT_TRUE(domain.released_vertices.empty());
  EXPECT_NEAR(VolumeOf(domain.mesh), VolumeOf(mesh), 1e-12);
  for (const auto& [a, b] : domain.rings.vertices) EXPECT_FALSE(a == 0 && b == 2);
}

TEST(MapDomain, SplitsKeepVolumeOrientationAndParents) {
  const TetMesh mesh = MakeBoxMesh({3, 3, 3}, {1, 1, 1});
  const MapDomain domain = MakeMapDomain(mesh, RandomFrames(mesh, 7));
  ASSERT_GT(domain.mesh.tets.size(), mesh.tets.size());
  EXPECT_NEAR(VolumeOf(domain.mesh), 1, 1e-12);
  const auto volumes = SixfoldVolumes(domain.mesh), old_volumes = SixfoldVolumes(mesh);
  std::vector<double> of_parts(mesh.tets.size(), 0);
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    EXPECT_GT(volumes[t], 0);
    of_parts[domain.parents[t]] += volumes[t];
  }
  for (std::size_t t = 0; t < of_parts.size(); ++t) EXPECT_NEAR(of_parts[t], std::abs(old_volumes[t]), 1e-12);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_EQ(domain.mesh.points[v], mesh.points[v]);
}

// A prism over a triangle with an angle of 30 degrees, whose two long sides are both nearest to the y axis.
TEST(BoundarySheets, LetTheSmallerSideOfAWedgeGo) {
  TetMesh mesh;
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0.9 * c, 0.9 * s, 0}, {0, 0, 1}, {1, 0, 1}, {0.9 * c, 0.9 * s, 1}};
  mesh.tets = {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}};
  const MatchedFrames matched = MatchTets(mesh, Frames(mesh.tets.size(), Eigen::Matrix3d::Identity()));
  const std::vector<std::array<bool, 4>> no_interface(mesh.tets.size());
  const BoundarySheets sheets =
      FindBoundarySheets(mesh, matched, FindEdgeRings(mesh, matched.neighbours), no_interface, {});
  ASSERT_FALSE(sheets.wedges.empty());
  EXPECT_NEAR(sheets.wedges[0].angle_deg, 30, 1e-9);
  EXPECT_TRUE(sheets.flat_corners.empty()) << "as they are of the side that was let go";
  int num_released = 0;
  for (const auto& sheet : sheets.sheets) {
    num_released += sheet.is_released;
    if (sheet.is_released) {
      EXPECT_NEAR(sheet.area, 0.9, 1e-12);
    }
  }
  EXPECT_EQ(num_released, 1);
}

// The two creases of the rib's side at its tip, one with the plate and one with the slope, run along one parameter.
TEST(MapDomain, ReleasesTheTipOfARib) {
  const TetMesh mesh = MakeRibMesh(0.8);
  const MapDomain domain = MakeMapDomain(mesh, ConstantFrames(mesh));
  EXPECT_TRUE(domain.collapsed.empty());
  std::set<int> tip;
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
    const Eigen::Vector3d& p = mesh.points[v];
    if (p.x() >= 2 && p.x() <= 4 && p.y() == 2 && std::abs(p.z() - 0.8) < 1e-12) tip.insert(v);
  }
  ASSERT_EQ(tip.size(), 3u);
  EXPECT_EQ(domain.released_vertices, tip);
  EXPECT_TRUE(domain.sheets.flat_corners.empty()) << "as their faces are no sheet any more";
  const auto obstacles = FindObstacles(domain, {});
  const auto is_release = [](const MapObstacle& obstacle) { return obstacle.kind == ObstacleKind::kReleased; };
  ASSERT_EQ(std::count_if(obstacles.begin(), obstacles.end(), is_release), 1);
  const MapObstacle& release = *std::find_if(obstacles.begin(), obstacles.end(), is_release);
  EXPECT_LT((release.place - Eigen::Vector3d(3, 2, 0.8)).norm(), 1.5);
}

TEST(MapDomain, NamesBadInput) {
  TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { MakeMapDomain(mesh, {}); }), HasSubstr("0 frames for 27 points"));
  std::swap(mesh.tets[5][0], mesh.tets[5][1]);
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { MakeMapDomain(mesh, ConstantFrames(mesh)); }),
              HasSubstr("tetrahedron 5 at"));
}

}  // namespace
}  // namespace octupole
