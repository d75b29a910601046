#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/box_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TriangleMesh Box(const Vector3d& low, const Vector3d& high, int cells = 1) {
  TriangleMesh box = BoundarySurface(MakeBoxMesh({cells, cells, cells}, high - low));
  for (Vector3d& p : box.points) p += low;
  return box;
}

TriangleMesh Turned(TriangleMesh surface) {
  for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  return surface;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both = a;
  const int offset = static_cast<int>(a.points.size());
  both.points.insert(both.points.end(), b.points.begin(), b.points.end());
  for (const auto& [i, j, k] : b.triangles) both.triangles.push_back({i + offset, j + offset, k + offset});
  return both;
}

struct Made {
  SurfaceGrid grid;
  std::vector<std::string> warnings;
};

Made MakeGridOfSize(const TriangleMesh& surface, double size, HoleRepair repair = HoleRepair::kNone) {
  GridOptions options;
  options.size = size;
  options.repair = repair;
  Made made;
  made.grid = MakeGrid(surface, options, &made.warnings);
  return made;
}

// Nodes further than a cell inside.
long CountInside(const SurfaceGrid& grid) {
  return std::count_if(grid.distances.begin(), grid.distances.end(), [&](float d) { return d < -grid.size; });
}

TEST(MakeGridInput, SaysNothingOfACleanSurface) {
  EXPECT_THAT(MakeGridOfSize(Box({0, 0, 0}, {1, 1, 1}, 4), 0.1).warnings, IsEmpty());
}

TEST(MakeGridInput, LeavesCavitiesEmpty) {
  const TriangleMesh outer = Box({0, 0, 0}, {3, 3, 3}), inner = Box({1, 1, 1}, {2, 2, 2});
  const Made made = MakeGridOfSize(Joined(outer, Turned(inner)), 0.1);
  EXPECT_THAT(made.warnings, ElementsAre("2 shells, 1 of them a cavity"));
  for (const Vector3d& p : made.grid.points) {
    EXPECT_GT((p - Vector3d(1.5, 1.5, 1.5)).cwiseAbs().maxCoeff(), 0.3);
  }
  const Made filled = MakeGridOfSize(Joined(outer, inner), 0.1);
  EXPECT_THAT(filled.warnings, ElementsAre("2 shells, 1 inside others but oriented alike, so not cavities"));
  EXPECT_GT(filled.grid.points.size(), made.grid.points.size() + 300);
}

TEST(MakeGridInput, FillsSolidsInCavities) {
  const TriangleMesh shells =
      Joined(Joined(Box({0, 0, 0}, {5, 5, 5}), Turned(Box({1, 1, 1}, {4, 4, 4}))), Box({2, 2, 2}, {3, 3, 3}));
  const Made made = MakeGridOfSize(shells, 0.2);
  EXPECT_THAT(made.warnings, ElementsAre("3 shells, 1 of them a cavity"));
  const auto has = [&](const Vector3d& x) {
    return std::any_of(made.grid.points.begin(), made.grid.points.end(),
                       [&](const Vector3d& p) { return (p - x).cwiseAbs().maxCoeff() <= 0.1; });
  };
  EXPECT_TRUE(has({2.5, 2.5, 2.5}));
  EXPECT_FALSE(has({1.5, 1.5, 1.5}));
  EXPECT_TRUE(has({0.5, 0.5, 0.5}));
}

TEST(MakeGridInput, JoinsSolidsThatOverlap) {
  const Made made = MakeGridOfSize(Joined(Box({0, 0, 0}, {2, 1, 1}), Box({1.3, 0.2, 0.2}, {3, 0.8, 0.8})), 0.1);
  EXPECT_THAT(made.warnings, ElementsAre(HasSubstr("the surface intersects itself: "), "2 shells"));
  EXPECT_GT(CountInside(made.grid), 0);
}

TEST(MakeGridInput, TakesTrianglesOfAnyOrientation) {
  TriangleMesh ball = BoundarySurface(MakeBallMesh(12));
  const SurfaceGrid clean = MakeGridOfSize(ball, 0.1).grid;
  for (std::size_t t = 0; t < 5; ++t) std::swap(ball.triangles[7 * t][0], ball.triangles[7 * t][1]);
  const Made made = MakeGridOfSize(ball, 0.1);
  EXPECT_THAT(made.warnings, ElementsAre("5 triangles are oriented against their neighbours"));
  EXPECT_EQ(made.grid.cells, clean.cells);
  EXPECT_EQ(MakeGridOfSize(Turned(ball), 0.1).grid.cells, clean.cells);
}

TEST(MakeGridInput, CountsDuplicateAndFlatTriangles) {
  TriangleMesh box = Box({0, 0, 0}, {1, 1, 1}, 2);
  const auto [a, b, c] = box.triangles[3];
  box.triangles.push_back({b, a, c});
  // A sliver along an edge, which leaves the surface closed.
  const int middle = static_cast<int>(box.points.size());
  box.points.push_back((box.points[a] + box.points[b]) / 2);
  box.triangles.push_back({a, b, middle});
  box.triangles.push_back({b, a, middle});
  const Made made = MakeGridOfSize(box, 0.1);
  EXPECT_THAT(made.warnings,
              testing::IsSupersetOf({testing::Eq("2 triangles of zero area"), testing::Eq("2 triangles lie twice")}));
}

TEST(MakeGridInput, ClosesHolesOnlyWhenAsked) {
  TriangleMesh box = Box({0, 0, 0}, {1, 1, 1}, 4);
  // Without its top, and without a triangle below.
  box.triangles.erase(std::remove_if(box.triangles.begin(), box.triangles.end(),
                                     [&](const auto& t) {
                                       return box.points[t[0]].z() + box.points[t[1]].z() + box.points[t[2]].z() > 2.99;
                                     }),
                      box.triangles.end());
  const auto at_bottom = std::find_if(box.triangles.begin(), box.triangles.end(), [&](const auto& t) {
    return box.points[t[0]].z() + box.points[t[1]].z() + box.points[t[2]].z() < 0.01;
  });
  box.triangles.erase(at_bottom);
  const std::string message = MessageOf<std::invalid_argument>([&] { MakeGridOfSize(box, 0.1); });
  EXPECT_THAT(message,
              HasSubstr("the surface is open: 2 holes, the largest with a perimeter of 4 about (0.5, 0.5, 1)"));
  const Made made = MakeGridOfSize(box, 0.1, HoleRepair::kClose);
  EXPECT_THAT(made.warnings, ElementsAre(HasSubstr("2 holes")));
  EXPECT_EQ(made.grid.points.size(), 12u * 12 * 12);
  // The cap does not align.
  for (std::size_t v = 0; v < made.grid.points.size(); ++v) {
    if ((made.grid.points[v] - Vector3d(0.5, 0.5, 1)).cwiseAbs().maxCoeff() > 0.3) continue;
    EXPECT_EQ(made.grid.graph.alignments[v].kind(), AlignmentKind::kFree);
  }
}

// A hollow with a way out that is too narrow for all but the finest cells.
TEST(MakeGridInput, LeavesBottlesEmpty) {
  TetMesh bottle = MakeBoxMesh({10, 10, 10}, {10, 10, 10});
  const auto is_hollow = [&](const std::array<int, 4>& tet) {
    Vector3d middle = Vector3d::Zero();
    for (const int v : tet) middle += bottle.points[v] / 4;
    const Vector3d from_middle = (middle - Vector3d(5.5, 5.5, 5.5)).cwiseAbs();
    return from_middle.maxCoeff() < 2.5 || (from_middle.head<2>().maxCoeff() < 0.5 && middle.z() > 5);
  };
  bottle.tets.erase(std::remove_if(bottle.tets.begin(), bottle.tets.end(), is_hollow), bottle.tets.end());
  GridOptions options;
  options.size = 0.3;
  for (const int levels : {1, 3}) {
    options.levels = levels;
    const SurfaceGrid grid = MakeGrid(BoundarySurface(bottle), options);
    for (const Vector3d& p : grid.points) EXPECT_GT((p - Vector3d(5.5, 5.5, 5.5)).cwiseAbs().maxCoeff(), 1.9);
  }
}

// An edge between faces at 45 degrees to a plane, close to it: a node between them sees all three. With small
// triangles, hundreds of them.
TEST(MakeGridInput, CountsNodesBetweenSheetsThatDisagree) {
  const double gap = 0.02;
  const double face = 0.4 * std::sqrt(0.5) + gap;
  for (const int cells : {1, 40}) {
    TriangleMesh turned = Box({-0.2, -0.2, 0}, {0.2, 0.2, 0.3}, cells);
    for (Vector3d& p : turned.points) {
      p = Vector3d((p.x() - p.y()) * std::sqrt(0.5), (p.x() + p.y()) * std::sqrt(0.5), p.z());
    }
    const TriangleMesh both = Joined(turned, Box({face, -0.3, 0}, {face + 0.2, 0.3, 0.3}, cells));
    const GridAlignment coarse = MakeGridOfSize(both, 0.05).grid.alignment;
    EXPECT_GE(coarse.num_conflicts, 6u);
    EXPECT_GE(coarse.num_free, coarse.num_conflicts);
    ASSERT_TRUE(coarse.separating_size.has_value());
    EXPECT_GT(*coarse.separating_size, 0.99 * gap / 1.8);
    EXPECT_LT(*coarse.separating_size, 1.6 * gap / 1.8);
    const GridAlignment fine = MakeGridOfSize(both, 0.6 * *coarse.separating_size).grid.alignment;
    EXPECT_EQ(fine.num_conflicts, 0u);
  }
}

// Thousands of triangles within reach of each node, and no two alike: it takes seconds, not hours.
TEST(MakeGridInput, TakesAScribbleOfTriangles) {
  TriangleMesh scribble = BoundarySurface(MakeBallMesh(12));
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 0.5);
  for (Vector3d& p : scribble.points) p += Vector3d(noise(generator), noise(generator), noise(generator));
  const GridAlignment alignment = MakeGridOfSize(scribble, 0.5).grid.alignment;
  EXPECT_GT(alignment.num_conflicts, 0u);
  ASSERT_TRUE(alignment.separating_size.has_value());
  EXPECT_LT(*alignment.separating_size, 0.01);
}

TEST(ForecastGrid, KnowsTheSizeOfGrids) {
  const TriangleMesh ball = BoundarySurface(MakeBallMesh(32));
  for (const int levels : {1, 2, 4}) {
    GridOptions options;
    options.size = 0.03;
    options.levels = levels;
    const GridForecast forecast = ForecastGrid(ball, options);
    const double nodes = static_cast<double>(MakeGrid(ball, options).points.size());
    EXPECT_NEAR(forecast.nodes, nodes, 0.3 * nodes) << levels;
  }
}

TEST(ForecastGrid, StopsGridsThatDoNotFit) {
  GridOptions options;
  options.size = 1e-4;
  options.max_bytes = 8e9;
  const std::string message = MessageOf<std::length_error>([&] { MakeGrid(Box({0, 0, 0}, {1, 1, 1}), options); });
  EXPECT_THAT(message, HasSubstr("MakeGrid: cells of size 0.0001 make some "));
  EXPECT_THAT(message, HasSubstr("GB of memory; there are 8"));
}

}  // namespace
}  // namespace octupole
