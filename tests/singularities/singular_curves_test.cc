#include "octupole/singularities/singular_curves.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Frames = std::vector<Matrix3d>;

SingularCurves Trace(const TetMesh& mesh, const Frames& frames) {
  return TraceSingularCurves(mesh, frames, FindSingularTriangles(mesh, frames));
}

// A box of side 2 about the origin.
TetMesh MakeCentredBox(int cells) {
  TetMesh mesh = MakeBoxMesh({cells, cells, cells}, {2, 2, 2});
  for (Vector3d& p : mesh.points) p -= Vector3d::Ones();
  return mesh;
}

// Around the line through (.03, .02, 0) along z, the frames turn by `angle` about `axis`.
Frames TurnAroundZ(const TetMesh& mesh, double angle, const Vector3d& axis) {
  Frames frames;
  for (const Vector3d& p : mesh.points) {
    const double share = std::atan2(p.y() - .02, p.x() - .03) / (2 * EIGEN_PI);
    frames.emplace_back(AngleAxisd(share * angle, axis.normalized()));
  }
  return frames;
}

Frames RandomFrames(std::size_t size, int seed) {
  std::mt19937 generator(seed);
  Frames frames(size);
  for (Matrix3d& frame : frames) frame = RandomFrame(&generator);
  return frames;
}

void Rename(Frames* frames) {
  std::mt19937 generator(9);
  for (Matrix3d& frame : *frames) frame *= OctahedralGroup()[generator() % 24].matrix();
}

// What does not depend on names, orientations and the order of tets.
using Description = std::multiset<std::tuple<TurnType, int, CurveEnd, CurveEnd, std::size_t>>;

Description Describe(const SingularCurves& traced) {
  Description description;
  for (const SingularCurve& curve : traced.curves) {
    const auto [first, last] = std::minmax(curve.ends[0], curve.ends[1]);
    description.emplace(curve.type, curve.valence, first, last, curve.points.size());
  }
  return description;
}

// Every singular triangle lies on one curve, every one on the boundary is an end, and every face of a node, too.
void ExpectConsistency(const TetMesh& mesh, const Frames& frames) {
  const auto triangles = FindSingularTriangles(mesh, frames);
  const SingularCurves traced = TraceSingularCurves(mesh, frames, triangles);
  std::map<CurveEnd, std::size_t> num_ends;
  std::size_t num_points = 0, num_boundary_triangles = 0, num_node_ends = 0;
  for (const SingularCurve& curve : traced.curves) {
    for (const CurveEnd end : curve.ends) ++num_ends[end];
    num_points += curve.points.size() - curve.is_loop();
  }
  for (const SingularTriangle& triangle : triangles) num_boundary_triangles += triangle.tets.size() == 1;
  for (const SingularNode& node : traced.nodes) num_node_ends += node.num_ends;
  EXPECT_EQ(num_ends[CurveEnd::kBoundary], num_boundary_triangles);
  EXPECT_EQ(num_ends[CurveEnd::kNode], num_node_ends);
  EXPECT_EQ(num_ends[CurveEnd::kOpen], 0u);
  EXPECT_EQ(num_points, triangles.size() + num_node_ends);
}

TEST(TraceSingularCurves, FindsTheLineAroundWhichTheFramesTurn) {
  const TetMesh box = MakeCentredBox(7);
  std::mt19937 generator(1);
  for (int i = 0; i < 12; ++i) {
    const int sign = i % 2 == 0 ? 1 : -1;
    const Matrix3d world = i < 2 ? Matrix3d(Matrix3d::Identity()) : RandomFrame(&generator);
    Frames frames = TurnAroundZ(box, sign * EIGEN_PI / 2, Vector3d::UnitZ());
    TetMesh mesh = box;
    for (Vector3d& p : mesh.points) p = world * p;
    for (Matrix3d& frame : frames) frame = world * frame;
    Rename(&frames);
    const SingularCurves traced = Trace(mesh, frames);
    EXPECT_TRUE(traced.nodes.empty());
    ASSERT_EQ(traced.curves.size(), 1u);
    const SingularCurve& curve = traced.curves[0];
    EXPECT_EQ(curve.type, TurnType::kQuarter);
    EXPECT_EQ(curve.valence, sign > 0 ? 3 : 5);
    EXPECT_NEAR(curve.mean_cosine, sign, .02);
    EXPECT_EQ(curve.ends, (std::array<CurveEnd, 2>{CurveEnd::kBoundary, CurveEnd::kBoundary}));
    // Straight to an eighth of the side of a cell.
    EXPECT_NEAR(curve.length, 2, .03);
    for (const Vector3d& point : curve.points) {
      EXPECT_LT((world.transpose() * point - Vector3d(.03, .02, 0)).head<2>().norm(), 2. / 7 / 8);
    }
    ExpectConsistency(mesh, frames);
  }
}

TEST(TraceSingularCurves, KnowsTheTypeOfATurn) {
  const TetMesh mesh = MakeCentredBox(7);
  const auto only_curve = [&](double angle, const Vector3d& axis) {
    Frames frames = TurnAroundZ(mesh, angle, axis);
    Rename(&frames);
    ExpectConsistency(mesh, frames);
    const SingularCurves traced = Trace(mesh, frames);
    EXPECT_EQ(traced.curves.size(), 1u);
    return traced.curves.at(0);
  };
  const SingularCurve third = only_curve(2 * EIGEN_PI / 3, {1, 1, 1});
  EXPECT_EQ(third.type, TurnType::kThird);
  EXPECT_EQ(third.valence, 0);
  EXPECT_NEAR(third.mean_cosine, std::sqrt(1. / 3), .02);
  // About an axis across the curve: a quarter turn without a valence.
  const SingularCurve across = only_curve(EIGEN_PI / 2, {1, 0, 0});
  EXPECT_EQ(across.type, TurnType::kQuarter);
  EXPECT_EQ(across.valence, 0);
  EXPECT_NEAR(across.mean_cosine, 0, .02);
}

// A curve along z around which frames turn about an axis that leans: it has a valence up to 45 degrees, where the axis
// is as near to its direction as to those across.
TEST(TraceSingularCurves, HasAValenceWhereTheAxisIsNearerToTheCurveThanAcross) {
  const TetMesh mesh = MakeCentredBox(7);
  for (const double degrees : {0, 25, 40, 50, 65, 75}) {
    for (const int sign : {1, -1}) {
      const Matrix3d lean = AngleAxisd(degrees * EIGEN_PI / 180, Vector3d::UnitX()).toRotationMatrix();
      Frames frames = TurnAroundZ(mesh, sign * EIGEN_PI / 2, lean.col(2));
      for (Matrix3d& frame : frames) frame *= lean;
      const SingularCurves traced = Trace(mesh, frames);
      ASSERT_EQ(traced.curves.size(), 1u) << degrees;
      EXPECT_NEAR(traced.curves[0].mean_cosine, sign * std::cos(degrees * EIGEN_PI / 180), .03);
      EXPECT_EQ(traced.curves[0].valence, degrees > 45 ? 0 : sign > 0 ? 3 : 5) << degrees;
    }
  }
}

// No triangle has a half turn about an axis: it comes apart into quarter turns of the same sense.
TEST(TraceSingularCurves, TakesAHalfTurnForTwoQuarterTurns) {
  const TetMesh mesh = MakeCentredBox(7);
  const Frames frames = TurnAroundZ(mesh, EIGEN_PI, Vector3d::UnitZ());
  ExpectConsistency(mesh, frames);
  double length = 0;
  for (const SingularCurve& curve : Trace(mesh, frames).curves) {
    EXPECT_EQ(curve.type, TurnType::kQuarter);
    EXPECT_NE(curve.valence, 5);
    length += curve.length;
  }
  EXPECT_GT(length, 3.5);
}

// The frames turn about z around the circle of radius .6 in the plane z = 0.05.
TEST(TraceSingularCurves, ClosesLoops) {
  const TetMesh mesh = MakeCentredBox(12);
  Frames frames;
  for (const Vector3d& p : mesh.points) {
    frames.emplace_back(AngleAxisd(std::atan2(p.z() - .05, p.head<2>().norm() - .6) / 4, Vector3d::UnitZ()));
  }
  const SingularCurves traced = Trace(mesh, frames);
  ASSERT_EQ(traced.curves.size(), 1u);
  const SingularCurve& loop = traced.curves[0];
  EXPECT_TRUE(loop.is_loop());
  EXPECT_EQ(loop.ends[1], CurveEnd::kNone);
  EXPECT_EQ(loop.points.front(), loop.points.back());
  EXPECT_EQ(loop.valence, 0);
  EXPECT_NEAR(loop.length / (2 * EIGEN_PI * .6), 1, .1);
  ExpectConsistency(mesh, frames);
}

// Noise, and fields of two turns about different axes.
TEST(TraceSingularCurves, IsConsistentOnWildFields) {
  const TetMesh mesh = MakeCentredBox(6);
  for (int seed = 0; seed < 5; ++seed) {
    ExpectConsistency(mesh, RandomFrames(mesh.points.size(), seed));
    Frames smooth = TurnAroundZ(mesh, EIGEN_PI / 2, Vector3d::UnitZ());
    std::mt19937 generator(seed);
    const Vector3d axis = RandomDirection(&generator);
    for (std::size_t v = 0; v < smooth.size(); ++v) {
      const Vector3d& p = mesh.points[v];
      smooth[v] = AngleAxisd(std::atan2(p.z() + .1 * seed, p.y() + .07) / 4, axis) * smooth[v];
    }
    ExpectConsistency(mesh, smooth);
    EXPECT_FALSE(Trace(mesh, RandomFrames(mesh.points.size(), seed)).nodes.empty());
  }
}

TEST(TraceSingularCurves, IsIndependentOfNamesOrientationsAndMirrors) {
  const TetMesh mesh = MakeCentredBox(5);
  std::mt19937 generator(4);
  for (const Frames& frames :
       {RandomFrames(mesh.points.size(), 1), TurnAroundZ(mesh, EIGEN_PI / 2, {0, .3, 1}),
        TurnAroundZ(mesh, -EIGEN_PI / 2, {.5, .3, 1}), TurnAroundZ(mesh, 2 * EIGEN_PI / 3, {1, 1, 1})}) {
    const Description description = Describe(Trace(mesh, frames));
    ASSERT_FALSE(description.empty());

    Frames renamed = frames;
    Rename(&renamed);
    EXPECT_EQ(Describe(Trace(mesh, renamed)), description);

    TetMesh shuffled = mesh;
    for (auto& tet : shuffled.tets) std::shuffle(tet.begin(), tet.end(), generator);
    std::shuffle(shuffled.tets.begin(), shuffled.tets.end(), generator);
    EXPECT_EQ(Describe(Trace(shuffled, frames)), description);

    TetMesh mirrored = mesh;
    for (Vector3d& p : mirrored.points) p.y() = -p.y();
    Frames mirrored_frames = frames;
    for (Matrix3d& frame : mirrored_frames) {
      frame.row(1) *= -1;
      frame.col(2) *= -1;
    }
    EXPECT_EQ(Describe(Trace(mirrored, mirrored_frames)), description);
  }
}

// Tets twice, three at a face, parts that touch in a vertex, folds: curves end somewhere.
TEST(TraceSingularCurves, TakesWhatIsNoManifold) {
  TetMesh mesh = MakeCentredBox(3);
  mesh.tets.insert(mesh.tets.end(), mesh.tets.begin(), mesh.tets.begin() + 20);
  const std::array<int, 4> tet = mesh.tets[30];
  mesh.points.push_back({5, 5, 5});
  mesh.tets.push_back({tet[0], tet[1], tet[2], static_cast<int>(mesh.points.size()) - 1});
  mesh.points[20] = mesh.points[40];
  for (int seed = 0; seed < 20; ++seed) {
    const Frames frames = RandomFrames(mesh.points.size(), seed);
    const auto triangles = FindSingularTriangles(mesh, frames);
    const SingularCurves traced = TraceSingularCurves(mesh, frames, triangles);
    std::size_t num_tets = 0, num_on_curves = 0;
    for (const SingularTriangle& triangle : triangles) num_tets += triangle.tets.size();
    for (const SingularCurve& curve : traced.curves) {
      EXPECT_TRUE(std::isfinite(curve.length) && std::isfinite(curve.mean_cosine));
      num_on_curves += curve.points.size();
    }
    EXPECT_LE(num_on_curves, 3 * num_tets);
    EXPECT_GE(num_on_curves, triangles.size());
  }
}

TEST(TraceSingularCurves, WantsOneFramePerPoint) {
  EXPECT_THROW(TraceSingularCurves(MakeCentredBox(1), Frames(7), {}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
