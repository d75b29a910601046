#include "octupole/mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/surface_corners.h"
#include "test_files.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Triangles = std::vector<std::array<int, 3>>;

// A square of two triangles.
TriangleMesh Square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 3, 0}}}; }

// The tets of a grid of unit cubes, those for which `is_in` says so.
template <typename IsIn>
TetMesh PartOfBox(std::array<int, 3> cells, const IsIn& is_in) {
  TetMesh mesh = MakeBoxMesh(cells, Eigen::Vector3d(cells[0], cells[1], cells[2]));
  std::vector<std::array<int, 4>> tets;
  for (const auto& tet : mesh.tets) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const int v : tet) center += mesh.points[v] / 4;
    if (is_in(center)) tets.push_back(tet);
  }
  mesh.tets = tets;
  return mesh;
}

// How many triangles have each edge, in each direction.
std::map<std::pair<int, int>, int> Sides(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
  return sides;
}

TEST(CheckTriangleMesh, NamesWhatIsWrong) {
  const auto message_of = [](const TriangleMesh& mesh) {
    return MessageOf<std::invalid_argument>([&] { CheckTriangleMesh(mesh); });
  };
  EXPECT_EQ(message_of(Square()), "");
  EXPECT_EQ(message_of({}), "CheckTriangleMesh: the mesh has no triangles");
  TriangleMesh mesh = Square();
  mesh.points[1].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(mesh), "CheckTriangleMesh: point 1 has the coordinate nan");
  mesh = Square();
  mesh.triangles[1][2] = 4;
  EXPECT_EQ(message_of(mesh), "CheckTriangleMesh: triangle 1 has the vertex index 4, out of range 0..3");
  mesh.triangles[1][2] = 3;
  EXPECT_EQ(message_of(mesh), "CheckTriangleMesh: triangle 1 has vertex 3 twice");
  mesh = Square();
  mesh.feature_edges = {{0, 0}};
  EXPECT_EQ(message_of(mesh), "CheckTriangleMesh: feature edge 0 has vertex 0 twice");
}

TEST(TriangleMesh, HasEdgesAndOpenEdges) {
  EXPECT_THAT(MeshEdges(Square()),
              ElementsAre(std::array{0, 1}, std::array{0, 2}, std::array{0, 3}, std::array{1, 2}, std::array{2, 3}));
  EXPECT_THAT(OpenEdges(Square()), ElementsAre(std::array{0, 1}, std::array{3, 0}, std::array{1, 2}, std::array{2, 3}));
  EXPECT_THAT(OpenEdges(BoundarySurface(MakeBoxMesh({1, 2, 1}, {1, 1, 1}))), IsEmpty());
}

TEST(BoundarySurface, HasThePointsAndFeaturesOfTheTetMesh) {
  TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  mesh.feature_edges = {{1, 0}, {0, 13}};
  mesh.feature_points = {13, 26};
  const TriangleMesh surface = BoundarySurface(mesh);
  EXPECT_EQ(surface.points, mesh.points);
  EXPECT_EQ(surface.triangles, BoundaryTriangles(mesh));
  EXPECT_EQ(surface.feature_edges, mesh.feature_edges);
  EXPECT_EQ(surface.feature_points, mesh.feature_points);
}

// The concave corner of a quadrilateral has to be the apex; seen from above, all triangles turn to the left.
TEST(FanOfPolygon, CutsQuadrilateralsWithoutOverlaps) {
  for (const Eigen::Vector3d& last : {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.2, 0.3, 0)}) {
    const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0.1}, {0, 1.5, 0}, last};
    for (int first = 0; first < 4; ++first) {
      const auto fan = FanOfPolygon(points, {first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4});
      ASSERT_EQ(fan.size(), 2u);
      for (const auto& triangle : fan) EXPECT_GT(TriangleNormal(points, triangle).z(), 0.9);
    }
  }
  EXPECT_THAT(FanOfPolygon({}, {5, 3, 4}), ElementsAre(std::array{5, 3, 4}));
  EXPECT_THROW(FanOfPolygon({}, {0, 1}), std::invalid_argument);
}

TEST(CutToManifold, LeavesAManifoldInOnePiece) {
  const TriangleMesh box = BoundarySurface(MakeBoxMesh({2, 2, 2}, {1, 1, 1}));
  const ManifoldSurface surface = CutToManifold(box);
  EXPECT_EQ(surface.points.size(), 26u) << "all but the centre";
  ASSERT_EQ(surface.triangles.size(), box.triangles.size());
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(surface.points[surface.triangles[t][i]], box.triangles[t][i]);
  }
}

// Two cubes that touch at a vertex, at an edge; two that touch at an edge and stand on one floor, so that the edge's
// ends are split in different ways and the edge stays open; a Y of triangles.
TEST(CutToManifold, CutsWhereMoreThanOneFanMeets) {
  struct Case {
    TriangleMesh mesh;
    std::size_t more_vertices;
    bool is_closed;
  };
  const auto boundary_of = [](auto cells, auto is_in) {
    TriangleMesh surface = BoundarySurface(PartOfBox(cells, is_in));
    CheckTriangleMesh(surface);
    return surface;
  };
  const std::vector<Case> cases = {
      {boundary_of(std::array{2, 2, 2},
                   [](const Eigen::Vector3d& p) { return (p.array() < 1).all() || (p.array() > 1).all(); }),
       1, true},
      {boundary_of(std::array{2, 2, 1}, [](const Eigen::Vector3d& p) { return (p.x() < 1) == (p.y() < 1); }), 2, true},
      // The edge from (1, 1, 1) to (1, 1, 2), above a floor.
      {boundary_of(std::array{2, 2, 2},
                   [](const Eigen::Vector3d& p) { return p.z() < 1 || (p.x() < 1) == (p.y() < 1); }),
       2, false},
      {{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}, 4, false},
  };
  for (const Case& c : cases) {
    std::set<int> used;
    for (const auto& t : c.mesh.triangles) used.insert(t.begin(), t.end());
    const ManifoldSurface surface = CutToManifold(c.mesh);
    EXPECT_EQ(surface.points.size(), used.size() + c.more_vertices);
    std::size_t num_sides = 0;
    for (const auto& [side, count] : Sides(surface.triangles)) {
      EXPECT_EQ(count, 1);
      num_sides += Sides(surface.triangles).count({side.second, side.first});
    }
    EXPECT_EQ(num_sides == 3 * surface.triangles.size(), c.is_closed);
  }
}

}  // namespace
}  // namespace octupole
