#include "octupole/alignment/boundary_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double Radians(double degrees) { return degrees * EIGEN_PI / 180; }

// A 4 x 4 x 4 grid, its cross-section a parallelogram with this angle at the edge x = y = 0.
TetMesh ShearedBox(double angle_deg) {
  TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  for (Vector3d& p : mesh.points)
    p = {p.x() + std::cos(Radians(angle_deg)) * p.y(), std::sin(Radians(angle_deg)) * p.y(), p.z()};
  return mesh;
}

int GridIndex(int i, int j, int k) { return i + 5 * (j + 5 * k); }

// A cone over a ring of `sides` points; its apex is the first point.
TetMesh Cone(double half_aperture_deg, int sides) {
  TetMesh mesh;
  mesh.points = {{0, 0, 1}, {0, 0, 0}};
  const double radius = std::tan(Radians(half_aperture_deg));
  for (int i = 0; i < sides; ++i) {
    const double phi = 2 * EIGEN_PI * i / sides;
    mesh.points.emplace_back(radius * std::cos(phi), radius * std::sin(phi), 0);
    mesh.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % sides});
  }
  return mesh;
}

// The largest angle between a prescribed axis of the frame and the nearest of `axes`.
double WorstAngle(const Matrix3d& frame, const Matrix3d& axes) {
  const Eigen::Vector3d best = (frame.transpose() * axes).cwiseAbs().colwise().maxCoeff();
  return std::acos(std::min(1., best.minCoeff()));
}

TEST(AlignToBoundary, GivesABoxItsNormalsAndFrames) {
  const TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const BoundaryAlignment boundary = AlignToBoundary(mesh);
  EXPECT_EQ(boundary.num_normals, 6u * 9u);
  EXPECT_EQ(boundary.num_frames, 8u + 12u * 3u);
  EXPECT_EQ(boundary.num_tangents, 0u);
  EXPECT_EQ(boundary.num_free, 0u);
  for (int v = 0; v < 125; ++v) {
    const int on_faces = (v % 5 % 4 == 0) + (v / 5 % 5 % 4 == 0) + (v / 25 % 4 == 0);
    const Alignment& alignment = boundary.alignments[v];
    if (on_faces == 0) {
      EXPECT_EQ(alignment.kind(), AlignmentKind::kFree);
    } else if (on_faces == 1) {
      ASSERT_EQ(alignment.kind(), AlignmentKind::kAxis);
      const int axis = v % 5 % 4 == 0 ? 0 : v / 5 % 5 % 4 == 0 ? 1 : 2;
      EXPECT_NEAR(std::abs(alignment.frame()(axis, 2)), 1, 1e-15);
    } else {
      ASSERT_EQ(alignment.kind(), AlignmentKind::kFrame);
      EXPECT_LT(WorstAngle(alignment.frame(), Matrix3d::Identity()), 1e-7);
    }
  }
}

TEST(AlignToBoundary, DoesNotDependOnTheTetsOrientation) {
  TetMesh mesh = ShearedBox(100);
  const BoundaryAlignment before = AlignToBoundary(mesh);
  for (std::size_t t = 0; t < mesh.tets.size(); t += 2) std::swap(mesh.tets[t][1], mesh.tets[t][2]);
  const BoundaryAlignment after = AlignToBoundary(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    ASSERT_EQ(before.alignments[v].kind(), after.alignments[v].kind());
    EXPECT_LT((before.alignments[v].frame() - after.alignments[v].frame()).norm(), 1e-7);
  }
}

// The edge of a wedge of 60, 70, 90, 110 or 120 degrees: its tangent is an axis, and the misfit is split evenly.
TEST(AlignToBoundary, SplitsTheMisfitOfTransversalEdgesEvenly) {
  for (const double angle : {60., 70., 90., 110., 120.}) {
    const BoundaryAlignment boundary = AlignToBoundary(ShearedBox(angle));
    const Alignment& edge = boundary.alignments[GridIndex(0, 0, 2)];
    ASSERT_EQ(edge.kind(), AlignmentKind::kFrame) << angle;
    EXPECT_LT(WorstAngle(edge.frame(), Vector3d::UnitZ() * Eigen::RowVector3d::Ones()), 1e-7) << angle;
    const Vector3d first_normal = Vector3d::UnitY();
    const Vector3d second_normal(-std::sin(Radians(angle)), std::cos(Radians(angle)), 0);
    for (const Vector3d& normal : {first_normal, second_normal}) {
      EXPECT_NEAR(std::acos(std::min(1., (edge.frame().transpose() * normal).cwiseAbs().maxCoeff())),
                  std::abs(Radians(angle - 90)) / 2, 1e-6)
          << angle;
    }
  }
}

TEST(AlignToBoundary, GivesAcuteWedgesTheirTangentAndBluntOnesTheirNormal) {
  for (const double angle : {15., 30., 40.}) {
    const BoundaryAlignment boundary = AlignToBoundary(ShearedBox(angle));
    const Alignment& acute = boundary.alignments[GridIndex(0, 0, 2)];
    ASSERT_EQ(acute.kind(), AlignmentKind::kAxis) << angle;
    EXPECT_NEAR(std::abs(acute.frame()(2, 2)), 1, 1e-7) << angle;
  }
  const BoundaryAlignment boundary = AlignToBoundary(ShearedBox(30));
  const Alignment& blunt = boundary.alignments[GridIndex(4, 0, 2)];
  ASSERT_EQ(blunt.kind(), AlignmentKind::kAxis);
  EXPECT_NEAR(std::abs(blunt.frame().col(2).dot(Vector3d(std::sin(Radians(15)), -std::cos(Radians(15)), 0))), 1, 1e-12);
}

TEST(AlignToBoundary, TakesTheFeatureAngleFromTheCaller) {
  // Two edges of normals 30 degrees apart and two of 150, with three inner vertices each.
  const TetMesh mesh = ShearedBox(150);
  EXPECT_EQ(AlignToBoundary(mesh, {40}).num_tangents, 6u);
  const BoundaryAlignment strict = AlignToBoundary(mesh, {20});
  EXPECT_EQ(strict.alignments[GridIndex(0, 0, 2)].kind(), AlignmentKind::kAxis);
  EXPECT_NEAR(std::abs(strict.alignments[GridIndex(0, 0, 2)].frame()(2, 2)), 1, 1e-7);
  EXPECT_EQ(strict.num_tangents, 12u);
}

TEST(AlignToBoundary, LeavesTipsFreeAndBluntApexesSmooth) {
  for (const double half_aperture : {10., 15., 25.}) {
    const BoundaryAlignment sharp = AlignToBoundary(Cone(half_aperture, 24));
    EXPECT_EQ(sharp.alignments[0].kind(), AlignmentKind::kFree) << half_aperture;
    EXPECT_EQ(sharp.num_free, 1u) << half_aperture;
  }
  // Its normals are up to 44 degrees apart, but no edge is sharp.
  const BoundaryAlignment blunt = AlignToBoundary(Cone(68, 24));
  ASSERT_EQ(blunt.alignments[0].kind(), AlignmentKind::kAxis);
  EXPECT_NEAR(std::abs(blunt.alignments[0].frame()(2, 2)), 1, 1e-12);
}

// A line across the top of a box, at 30 degrees: the frame there has the normal and the line as axes. Without marks the
// field would follow the box's edges.
TEST(AlignToBoundary, FollowsMarkedEdgesOnSmoothFaces) {
  TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const int from = GridIndex(1, 2, 4), over = GridIndex(2, 2, 4), to = GridIndex(3, 2, 4);
  const Vector3d line(std::cos(Radians(30)), std::sin(Radians(30)), 0);
  mesh.points[from] = mesh.points[over] - 0.2 * line;
  mesh.points[to] = mesh.points[over] + 0.2 * line;
  mesh.feature_edges = {{from, over}, {over, to}};
  Matrix3d axes;
  axes << line, Vector3d::UnitZ().cross(line), Vector3d::UnitZ();
  const BoundaryAlignment boundary = AlignToBoundary(mesh);
  EXPECT_TRUE(boundary.has_marked_features);
  EXPECT_EQ(boundary.feature_edges.size(), 2u);
  for (const int v : {from, over, to}) {
    ASSERT_EQ(boundary.alignments[v].kind(), AlignmentKind::kFrame);
    EXPECT_LT(WorstAngle(boundary.alignments[v].frame(), axes), 1e-7);
  }
  // The box's own edges keep their frames, though they are not marked.
  EXPECT_EQ(boundary.num_frames, 8u + 12u * 3u + 3u);
  EXPECT_EQ(boundary.num_normals, 6u * 9u - 3u);

  mesh.feature_edges.clear();
  const BoundaryAlignment by_angle = AlignToBoundary(mesh);
  EXPECT_FALSE(by_angle.has_marked_features);
  EXPECT_EQ(by_angle.feature_edges.size(), 12u * 4u);
  EXPECT_EQ(by_angle.alignments[over].kind(), AlignmentKind::kAxis);
}

// Two curves that cross at 45 degrees leave no direction that would suit both; at 90 degrees they are two axes.
TEST(AlignToBoundary, TakesCrossingsOfMarkedEdgesAsTheyAre) {
  TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const int middle = GridIndex(2, 2, 4);
  mesh.feature_edges = {{GridIndex(1, 2, 4), middle}, {middle, GridIndex(3, 2, 4)}, {middle, GridIndex(2, 3, 4)}};
  EXPECT_EQ(AlignToBoundary(mesh).alignments[middle].kind(), AlignmentKind::kFrame);
  mesh.feature_edges = {{GridIndex(1, 2, 4), middle}, {middle, GridIndex(3, 3, 4)}};
  EXPECT_EQ(AlignToBoundary(mesh).alignments[middle].kind(), AlignmentKind::kAxis);
}

TEST(AlignToBoundary, FollowsMarkedEdgesInside) {
  TetMesh mesh = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const int a = GridIndex(1, 2, 2), b = GridIndex(2, 2, 2), c = GridIndex(3, 2, 2), d = GridIndex(2, 3, 2);
  mesh.feature_edges = {{a, b}, {b, c}};
  BoundaryAlignment boundary = AlignToBoundary(mesh);
  EXPECT_EQ(boundary.num_tangents, 3u);
  for (const int v : {a, b, c}) {
    ASSERT_EQ(boundary.alignments[v].kind(), AlignmentKind::kAxis);
    EXPECT_NEAR(std::abs(boundary.alignments[v].frame()(0, 2)), 1, 1e-12);
  }
  mesh.feature_edges.push_back({b, d});
  boundary = AlignToBoundary(mesh);
  ASSERT_EQ(boundary.alignments[b].kind(), AlignmentKind::kFrame);
  EXPECT_LT(WorstAngle(boundary.alignments[b].frame(), Matrix3d::Identity()), 1e-7);
}

// Marks take the place of the angle: an edge of 30 degrees between the normals is none by angle.
TEST(AlignToBoundary, PrefersMarksToTheAngle) {
  TetMesh mesh = ShearedBox(150);
  const int edge = GridIndex(0, 0, 2);
  EXPECT_EQ(AlignToBoundary(mesh).alignments[edge].kind(), AlignmentKind::kAxis);
  mesh.feature_edges = {{GridIndex(0, 0, 1), edge}, {edge, GridIndex(0, 0, 3)}};
  const Alignment marked = AlignToBoundary(mesh).alignments[edge];
  ASSERT_EQ(marked.kind(), AlignmentKind::kFrame);
  EXPECT_LT(WorstAngle(marked.frame(), Vector3d::UnitZ() * Eigen::RowVector3d::Ones()), 1e-7);
  // A point has no direction.
  mesh.feature_edges.clear();
  mesh.feature_points = {edge};
  const BoundaryAlignment with_point = AlignToBoundary(mesh);
  EXPECT_FALSE(with_point.has_marked_features);
  EXPECT_EQ(with_point.alignments[edge].kind(), AlignmentKind::kAxis);
}

TEST(AlignToBoundary, TurnsWithTheMesh) {
  std::mt19937 generator(1);
  for (const double angle : {30., 60., 90., 130.}) {
    const TetMesh mesh = ShearedBox(angle);
    TetMesh turned = mesh;
    const Matrix3d rotation = RandomFrame(&generator);
    for (Vector3d& p : turned.points) p = rotation * p;
    const BoundaryAlignment here = AlignToBoundary(mesh), there = AlignToBoundary(turned);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      ASSERT_EQ(here.alignments[v].kind(), there.alignments[v].kind()) << angle << " " << v;
      if (here.alignments[v].kind() == AlignmentKind::kFrame) {
        EXPECT_LT(FrameDifference<3>(rotation * here.alignments[v].frame(), there.alignments[v].frame()), 1e-10);
      } else if (here.alignments[v].kind() == AlignmentKind::kAxis) {
        EXPECT_NEAR(std::abs((rotation * here.alignments[v].frame().col(2)).dot(there.alignments[v].frame().col(2))), 1,
                    1e-12);
      }
    }
  }
}

TEST(AlignToBoundary, RefusesAFeatureAngleOutOfRange) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  for (const double bad : {0., -1., 180., std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(AlignToBoundary(mesh, {bad}), std::invalid_argument);
  }
}

// A point in the middle of a ridge along z, whose sides have normals 70 degrees apart and so many triangles each.
TriangleMesh Ridge(int first_side, int second_side) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const auto& [size, slope] : {std::pair(first_side, -35.), std::pair(second_side, 215.)}) {
    const Vector3d down(std::cos(Radians(slope)), std::sin(Radians(slope)), 0);
    int last = 1;
    for (int i = 1; i <= size; ++i) {
      const double angle = EIGEN_PI * i / size;
      const int next = i == size ? 2 : static_cast<int>(mesh.points.size());
      if (i < size) mesh.points.emplace_back(std::cos(angle) * Vector3d::UnitZ() + std::sin(angle) * down);
      if (slope < 0) {
        mesh.triangles.push_back({0, last, next});
      } else {
        mesh.triangles.push_back({0, next, last});
      }
      last = next;
    }
  }
  return mesh;
}

// Normals count by the angles of their corners, not by their number.
TEST(AlignToSurface, DoesNotDependOnHowTheSidesOfAnEdgeAreCut) {
  const Alignment even = AlignToSurface(Ridge(2, 2), 40, OpenBoundary::kFree).alignments[0];
  ASSERT_EQ(even.kind(), AlignmentKind::kFrame);
  for (const auto& [first_side, second_side] : {std::pair(2, 7), std::pair(7, 2), std::pair(3, 5)}) {
    const Alignment uneven = AlignToSurface(Ridge(first_side, second_side), 40, OpenBoundary::kFree).alignments[0];
    ASSERT_EQ(uneven.kind(), AlignmentKind::kFrame);
    EXPECT_LT(WorstAngle(uneven.frame(), even.frame()), 1e-6) << first_side << " " << second_side;
  }
}

// Three points on a line in the middle of a plane: a triangle of zero area has no normal that could differ.
TEST(AlignToSurface, SeesNoFeatureAtATriangleOfZeroArea) {
  const TriangleMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                             {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}, {2, 0, 4}}};
  const BoundaryAlignment alignment = AlignToSurface(mesh, 40, OpenBoundary::kFree);
  EXPECT_EQ(alignment.feature_edges.size(), 0u);
  EXPECT_EQ(alignment.num_normals, 5u);
}

}  // namespace
}  // namespace octupole
