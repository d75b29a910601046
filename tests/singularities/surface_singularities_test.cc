#include "octupole/singularities/surface_singularities.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/surface_corners.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Triangles = std::vector<std::array<int, 3>>;

struct Surface {
  std::vector<Vector3d> points;
  Triangles triangles;
};

Surface BoundaryOf(const TetMesh& mesh) { return {mesh.points, BoundaryTriangles(mesh)}; }

// A grid of `columns` x `rows` squares on [-1, 1]^2; columns and rows may close up, which makes a torus.
Surface MakeGrid(int columns, int rows, bool is_torus) {
  Surface grid;
  const int width = is_torus ? columns : columns + 1, height = is_torus ? rows : rows + 1;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double s = 2 * EIGEN_PI * i / columns, t = 2 * EIGEN_PI * j / rows, r = 2 + std::cos(t);
      grid.points.push_back(is_torus ? Vector3d(r * std::cos(s), r * std::sin(s), std::sin(t))
                                     : Vector3d(2. * i / columns - 1, 2. * j / rows - 1, 0));
    }
  }
  const auto at = [&](int i, int j) { return i % width + width * (j % height); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      grid.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      grid.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return grid;
}

std::vector<Matrix3d> RandomFrames(std::size_t size) {
  std::mt19937 generator(1);
  std::vector<Matrix3d> frames(size);
  for (Matrix3d& frame : frames) frame = RandomFrame(&generator);
  return frames;
}

// Around the origin of the plane the cross turns by `quarters` quarter turns.
std::vector<Matrix3d> FramesAroundTheOrigin(const std::vector<Vector3d>& points, int quarters) {
  std::vector<Matrix3d> frames;
  for (const Vector3d& p : points) {
    frames.emplace_back(Eigen::AngleAxisd(quarters * std::atan2(p.y() - .03, p.x() - .01) / 4, Vector3d::UnitZ()));
  }
  return frames;
}

TEST(QuarterIndices, AreThoseOfAFieldWithAKnownSingularPoint) {
  const Surface plane = MakeGrid(12, 12, false);
  for (const int quarters : {-1, 0, 1}) {
    const auto frames = FramesAroundTheOrigin(plane.points, quarters);
    const auto indices = QuarterIndices(plane.points, plane.triangles, frames);
    for (std::size_t t = 0; t < indices.size(); ++t) {
      // The triangle that holds (.01, .03), above the diagonal of the square at the centre.
      const Vector3d centre = (plane.points[plane.triangles[t][0]] + plane.points[plane.triangles[t][1]] +
                               plane.points[plane.triangles[t][2]]) /
                              3;
      const bool has_point = (centre - Vector3d(1. / 18, 2. / 18, 0)).norm() < 1e-9;
      EXPECT_EQ(indices[t], has_point ? quarters : 0) << t;
    }
  }
  // A singular point of index 1/2 is one triangle's, or two of 1/4 each where frames turn by more than 45 degrees.
  const auto indices = QuarterIndices(plane.points, plane.triangles, FramesAroundTheOrigin(plane.points, 2));
  EXPECT_EQ(std::accumulate(indices.begin(), indices.end(), 0), 2);
}

// Whatever the names and signs of axes, the orientation of triangles, the mirror image or the place in space.
TEST(QuarterIndices, AreIndependentOfNamesAndOrientations) {
  std::mt19937 generator(2);
  const Surface surface = BoundaryOf(MakeBallMesh(4));
  const auto frames = RandomFrames(surface.points.size());
  const auto indices = QuarterIndices(surface.points, surface.triangles, frames);
  EXPECT_GT(std::count(indices.begin(), indices.end(), 0), 0);
  EXPECT_LT(std::count(indices.begin(), indices.end(), 0), static_cast<int>(indices.size()));

  auto renamed = frames;
  for (Matrix3d& frame : renamed) frame *= OctahedralGroup()[generator() % 24].matrix();
  EXPECT_EQ(QuarterIndices(surface.points, surface.triangles, renamed), indices);

  const Matrix3d turn = RandomFrame(&generator);
  Surface moved = surface;
  auto turned = frames;
  for (Vector3d& p : moved.points) p = 7 * (turn * p) + Vector3d(1, 2, 3);
  for (Matrix3d& frame : turned) frame = turn * frame;
  EXPECT_EQ(QuarterIndices(moved.points, moved.triangles, turned), indices);

  Surface mirrored = surface;
  auto mirrored_frames = frames;
  for (Vector3d& p : mirrored.points) p.z() = -p.z();
  for (Matrix3d& frame : mirrored_frames) {
    frame.row(2) *= -1;
    frame.col(0) *= -1;
  }
  EXPECT_EQ(QuarterIndices(mirrored.points, mirrored.triangles, mirrored_frames), indices);

  auto flipped = surface.triangles;
  for (std::size_t t = 0; t < flipped.size(); t += 3) std::swap(flipped[t][0], flipped[t][2]);
  EXPECT_EQ(QuarterIndices(surface.points, flipped, frames), indices);
}

// The frame field of a cylinder in cylindrical coordinates has no singular point off its axis, on the edges of the cap
// included; nor has the constant field on a box, but for the eight corners.
TEST(QuarterIndices, SeeNoSingularPointWhereFramesFollowASharpEdge) {
  const Surface box = BoundaryOf(MakeBoxMesh({4, 5, 6}, {1, 2, 1.5}));
  std::mt19937 generator(3);
  for (int i = 0; i < 10; ++i) {
    const Matrix3d turn = RandomFrame(&generator);
    auto points = box.points;
    for (Vector3d& p : points) p = turn * p;
    const auto indices = QuarterIndices(points, box.triangles, std::vector<Matrix3d>(points.size(), turn));
    EXPECT_EQ(std::count(indices.begin(), indices.end(), 1), 8);
    EXPECT_EQ(std::count(indices.begin(), indices.end(), 0), static_cast<int>(indices.size()) - 8);
    for (std::size_t t = 0; t < indices.size(); ++t) {
      if (indices[t] == 0) continue;
      const auto is_corner = [&](int v) {
        const Vector3d& p = box.points[v];
        return (p.x() == 0 || p.x() == 1) && (p.y() == 0 || p.y() == 2) && (p.z() == 0 || p.z() == 1.5);
      };
      EXPECT_TRUE(std::any_of(box.triangles[t].begin(), box.triangles[t].end(), is_corner));
    }
  }

  TetMesh bar = MakeBoxMesh({16, 4, 4}, {2 * EIGEN_PI, 1, 1});
  std::vector<Matrix3d> frames;
  // Bent about z to three quarters of a ring.
  for (Vector3d& p : bar.points) {
    const Eigen::AngleAxisd bend(.75 * p.x(), Vector3d::UnitZ());
    p = bend * Vector3d(0, -2 - p.y(), p.z());
    frames.emplace_back(bend);
  }
  const Surface bent = BoundaryOf(bar);
  const auto indices = QuarterIndices(bent.points, bent.triangles, frames);
  EXPECT_EQ(std::count(indices.begin(), indices.end(), 1), 8);
  EXPECT_EQ(std::count(indices.begin(), indices.end(), 0), static_cast<int>(indices.size()) - 8);
}

TEST(FindSurfaceSingularities, IndicesSumToTheEulerCharacteristicWhateverTheFrames) {
  for (const auto& [surface, euler] :
       {std::pair(BoundaryOf(MakeBallMesh(5)), 2), std::pair(BoundaryOf(MakeBoxMesh({3, 2, 4}, {1, 1, 1})), 2),
        std::pair(MakeGrid(12, 7, true), 0)}) {
    const auto result =
        FindSurfaceSingularities(surface.points, surface.triangles, RandomFrames(surface.points.size()));
    ASSERT_EQ(result.components.size(), 1u);
    EXPECT_EQ(result.components[0].euler_characteristic, euler);
    EXPECT_EQ(result.components[0].quarter_index_sum, 4 * euler);
    EXPECT_EQ(result.components[0].triangles, surface.triangles.size());
    EXPECT_TRUE(result.components[0].is_closed);
    EXPECT_FALSE(result.components[0].is_normal);
  }
}

// Frames with the normal and the circles of latitude as axes have their singular points at the poles, index 1 each:
// four quarters nearby.
TEST(FindSurfaceSingularities, KnowsTheFieldOfCirclesOfLatitude) {
  const Surface sphere = BoundaryOf(MakeBallMesh(12));
  std::vector<Matrix3d> frames;
  const Eigen::AngleAxisd tilt(.4, Vector3d(1, 2, 0).normalized());
  const Vector3d pole = tilt * Vector3d::UnitZ();
  for (const Vector3d& p : sphere.points) {
    Matrix3d frame = Matrix3d::Identity();
    if (p.norm() > .5) frame << p.normalized(), pole.cross(p).normalized(), p.cross(pole.cross(p)).normalized();
    frames.push_back(frame);
  }
  const auto result = FindSurfaceSingularities(sphere.points, sphere.triangles, frames);
  ASSERT_EQ(result.components.size(), 1u);
  EXPECT_TRUE(result.components[0].is_normal);
  std::array<int, 2> near_pole = {};
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t) {
    if (result.quarter_indices[t] == 0) continue;
    const double height = sphere.points[sphere.triangles[t][0]].dot(pole);
    EXPECT_GT(std::abs(height), .9);
    near_pole[height > 0] += result.quarter_indices[t];
  }
  EXPECT_EQ(near_pole, (std::array<int, 2>{4, 4}));
}

TEST(FindSurfaceSingularities, TellsComponentsAndOpenOnesApart) {
  Surface two = BoundaryOf(MakeBallMesh(3));
  const Surface plane = MakeGrid(5, 4, false);
  const auto first_point = static_cast<int>(two.points.size());
  const std::size_t first_triangle = two.triangles.size();
  two.points.insert(two.points.end(), plane.points.begin(), plane.points.end());
  for (auto [a, b, c] : plane.triangles) {
    two.triangles.push_back({a + first_point, b + first_point, c + first_point});
  }
  const auto result = FindSurfaceSingularities(two.points, two.triangles,
                                               std::vector<Matrix3d>(two.points.size(), Matrix3d::Identity()));
  ASSERT_EQ(result.components.size(), 2u);
  EXPECT_TRUE(result.components[0].is_closed);
  EXPECT_FALSE(result.components[0].is_normal);
  EXPECT_FALSE(result.components[1].is_closed);
  EXPECT_TRUE(result.components[1].is_normal);
  EXPECT_EQ(result.components[1].euler_characteristic, 1);
  EXPECT_EQ(result.components[1].quarter_index_sum, 0);
  for (std::size_t t = 0; t < two.triangles.size(); ++t) EXPECT_EQ(result.component_of[t], t >= first_triangle);
}

// Two tetrahedra with a common vertex, with a common edge, and three triangles at one edge: fans come apart.
TEST(FindSurfaceSingularities, TakesNonManifoldSurfaces) {
  const std::vector<Vector3d> points = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                        {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {5, 5, 5}};
  const auto frames = RandomFrames(points.size());
  const auto tet = [](int a, int b, int c, int d) { return Triangles{{a, c, b}, {a, b, d}, {b, c, d}, {a, d, c}}; };
  const auto joined = [](Triangles first, const Triangles& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  };
  const auto at_vertex = FindSurfaceSingularities(points, joined(tet(0, 1, 2, 3), tet(0, 4, 5, 6)), frames);
  ASSERT_EQ(at_vertex.components.size(), 2u);
  for (const SurfaceComponent& component : at_vertex.components) {
    EXPECT_TRUE(component.is_closed);
    EXPECT_EQ(component.euler_characteristic, 2);
    EXPECT_EQ(component.quarter_index_sum, 8);
  }
  // Each tet's surface is a sphere slit along the common edge.
  const auto at_edge = FindSurfaceSingularities(points, joined(tet(0, 1, 2, 3), tet(0, 1, 5, 6)), frames);
  ASSERT_EQ(at_edge.components.size(), 2u);
  for (const SurfaceComponent& component : at_edge.components) {
    EXPECT_FALSE(component.is_closed);
    EXPECT_EQ(component.euler_characteristic, 1);
  }
  const auto fins = FindSurfaceSingularities(points, {{0, 1, 2}, {0, 1, 3}, {1, 0, 5}}, frames);
  EXPECT_EQ(fins.components.size(), 3u);
}

// Triangles of no area, and points on each other.
TEST(FindSurfaceSingularities, TakesFlatTriangles) {
  Surface surface = BoundaryOf(MakeBoxMesh({2, 2, 2}, {1, 1, 1}));
  surface.points[surface.triangles[0][0]] = surface.points[surface.triangles[0][1]];
  for (auto points : {surface.points, std::vector<Vector3d>(surface.points.size(), Vector3d::Zero())}) {
    const auto result = FindSurfaceSingularities(points, surface.triangles, RandomFrames(points.size()));
    EXPECT_EQ(result.components[0].quarter_index_sum, 8);
  }
}

TEST(FindSurfaceSingularities, RefusesWhatIsNoSurface) {
  const std::vector<Vector3d> points(3, Vector3d::Zero());
  EXPECT_THROW(FindSurfaceSingularities(points, {{0, 1, 2}}, std::vector<Matrix3d>(2)), std::invalid_argument);
  const auto message = [&](const std::array<int, 3>& triangle) {
    return MessageOf<std::invalid_argument>([&] {
      FindSurfaceSingularities(points, {{0, 1, 2}, triangle}, std::vector<Matrix3d>(3));
    });
  };
  EXPECT_EQ(message({0, 1, 3}), "FindSurfaceSingularities: triangle 1 has the vertices 0, 1, 3 of 3 points");
  EXPECT_EQ(message({0, -1, 2}), "FindSurfaceSingularities: triangle 1 has the vertices 0, -1, 2 of 3 points");
  EXPECT_EQ(message({0, 1, 1}), "FindSurfaceSingularities: triangle 1 has the vertices 0, 1, 1 of 3 points");
}

}  // namespace
}  // namespace octupole
