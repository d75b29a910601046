#include "octupole/frames/fundamental_zone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr SymmetryGroup kGroups[] = {SymmetryGroup::kTetrahedral, SymmetryGroup::kOctahedral};

Matrix3d Turn(double degrees, const Vector3d& axis) {
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180, axis.normalized()).toRotationMatrix();
}

// Whether two rotations do the same to the reference, of degree 3 for A4 and of degree 4 for S4.
bool AreSame(const Matrix3d& a, const Matrix3d& b, SymmetryGroup group) {
  if (group == SymmetryGroup::kTetrahedral) return (HarmonicFromFrame<3>(a) - HarmonicFromFrame<3>(b)).norm() < 1e-12;
  return (HarmonicFromFrame<4>(a) - HarmonicFromFrame<4>(b)).norm() < 1e-12;
}

// The zones as the paper describes them, not as their faces.
bool IsInPolyhedron(const Vector3d& r, SymmetryGroup group, double tolerance) {
  const bool in_octahedron = r.lpNorm<1>() <= 1 + tolerance;
  const bool in_cube = r.lpNorm<Eigen::Infinity>() <= std::sqrt(2.) - 1 + tolerance;
  return in_octahedron && (group == SymmetryGroup::kTetrahedral || in_cube);
}

TEST(Rodrigues, IsTheAxisTimesTheTangentOfHalfTheAngle) {
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = RandomDirection(&generator);
    const double angle = 3.1 * i / 100;
    const Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Vector3d r = RodriguesFromRotation(rotation);
    EXPECT_LT((r - std::tan(angle / 2) * axis).norm(), 1e-13 * (1 + r.squaredNorm()));
    EXPECT_LT((RotationFromRodrigues(r) - rotation).norm(), 1e-13);
  }
  EXPECT_LT((RotationFromRodrigues({0, 1e300, 0}) - Turn(180, Vector3d::UnitY())).norm(), 1e-15);
}

TEST(ReduceToZone, KeepsTheClassAndLandsInTheZone) {
  std::mt19937 generator(2);
  for (const SymmetryGroup group : kGroups) {
    for (int i = 0; i < 1000; ++i) {
      const Matrix3d rotation = RandomFrame(&generator);
      const Matrix3d reduced = ReduceToZone(rotation, group);
      EXPECT_TRUE(AreSame(reduced, rotation, group));
      const Vector3d r = RodriguesFromRotation(reduced);
      EXPECT_TRUE(IsInPolyhedron(r, group, 1e-12)) << r.transpose();
    }
  }
}

TEST(ReduceToZone, GivesTheSameForAllOfAClass) {
  std::mt19937 generator(3);
  for (const SymmetryGroup group : kGroups) {
    for (int i = 0; i < 50; ++i) {
      const Matrix3d rotation = RandomFrame(&generator);
      const Matrix3d reduced = ReduceToZone(rotation, group);
      for (const auto& g : OctahedralGroup()) {
        const bool is_same = group == SymmetryGroup::kOctahedral || g.IsEven();
        EXPECT_EQ((ReduceToZone(rotation * g.matrix(), group) - reduced).norm() < 1e-13, is_same);
      }
    }
  }
}

TEST(ZoneFaces, BoundTheOctahedronAndTheTruncatedCube) {
  EXPECT_EQ(ZoneFaces(SymmetryGroup::kTetrahedral).size(), 8u);
  EXPECT_EQ(ZoneFaces(SymmetryGroup::kOctahedral).size(), 14u);
  std::mt19937 generator(4);
  for (const SymmetryGroup group : kGroups) {
    int num_inside = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d r = 1.2 * std::cbrt(generator() / 4294967296.) * RandomDirection(&generator);
      EXPECT_EQ(IsInZone(r, group, 0), IsInPolyhedron(r, group, 0)) << r.transpose();
      num_inside += IsInZone(r, group, 0);
    }
    EXPECT_GT(num_inside, 50);
  }
  EXPECT_TRUE(IsInZone({1.01, 0, 0}, SymmetryGroup::kTetrahedral, 0.1));
  EXPECT_FALSE(IsInZone({std::numeric_limits<double>::quiet_NaN(), 0, 0}, SymmetryGroup::kTetrahedral, 0.1));
}

// A random point of a face, inside the zone.
Vector3d PointOnFace(const ZoneFace& face, SymmetryGroup group, std::mt19937* generator) {
  const Vector3d center = face.distance * face.normal;
  while (true) {
    Vector3d offset = RandomDirection(generator);
    offset -= offset.dot(face.normal) * face.normal;
    if (IsInPolyhedron(center + offset, group, 0)) return center + offset;
    if (IsInPolyhedron(center + 0.2 * offset, group, 0)) return center + 0.2 * offset;
  }
}

TEST(GluedPoint, IsTheSameClassOnTheOppositeFace) {
  std::mt19937 generator(5);
  for (const SymmetryGroup group : kGroups) {
    for (const ZoneFace& face : ZoneFaces(group)) {
      for (int i = 0; i < 20; ++i) {
        const Vector3d r = PointOnFace(face, group, &generator);
        const Vector3d glued = GluedPoint(r, face);
        EXPECT_TRUE(AreSame(RotationFromRodrigues(r), RotationFromRodrigues(glued), group));
        EXPECT_NEAR(face.normal.dot(glued), -face.distance, 1e-14);
        EXPECT_TRUE(IsInPolyhedron(glued, group, 1e-14));
        // 45 degrees on the octagons, 60 on the triangles (paper, A.2).
        const bool is_octagon = face.normal.cwiseAbs().maxCoeff() > 0.9;
        const Vector3d turned = Turn(is_octagon ? 45 : 60, face.normal) * r - 2 * face.distance * face.normal;
        EXPECT_LT((glued - turned).norm(), 1e-14);
      }
    }
  }
}

// Paper, A.2: all of them are one point, the opposite of the reference.
TEST(FundamentalZone, OctahedronsVerticesAreTheNegativeReference) {
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1., 1.}) {
      const Vector3d vertex = sign * Vector3d::Unit(k);
      EXPECT_TRUE(IsInZone(vertex, SymmetryGroup::kTetrahedral, 1e-15));
      EXPECT_LT((HarmonicFromFrame<3>(RotationFromRodrigues(vertex)) + ReferenceHarmonic<3>()).norm(), 1e-14);
    }
  }
}

// Figure 5: the 24 vertices of the truncated cube are 6 frames, 4 vertices each.
TEST(FundamentalZone, TruncatedCubesVerticesAreSixFrames) {
  const double b = std::sqrt(2.) - 1, c = 1 - 2 * b;
  std::vector<Vector3d> vertices;
  for (int k = 0; k < 3; ++k) {
    for (int signs = 0; signs < 8; ++signs) {
      Vector3d vertex = Vector3d::Constant(b);
      vertex[k] = c;
      for (int i = 0; i < 3; ++i) vertex[i] *= signs >> i & 1 ? -1 : 1;
      EXPECT_TRUE(IsInZone(vertex, SymmetryGroup::kOctahedral, 1e-15));
      vertices.push_back(vertex);
    }
  }
  for (const Vector3d& vertex : vertices) {
    const auto is_glued = [&](const Vector3d& other) {
      return AreSame(RotationFromRodrigues(vertex), RotationFromRodrigues(other), SymmetryGroup::kOctahedral);
    };
    EXPECT_EQ(std::count_if(vertices.begin(), vertices.end(), is_glued), 4);
  }
}

TEST(AngleBetween, IsThatOfTheTurnBetweenTwoFrames) {
  std::mt19937 generator(6);
  for (const SymmetryGroup group : kGroups) {
    for (int i = 0; i < 200; ++i) {
      const Matrix3d a = RandomFrame(&generator);
      const OctahedralRotation& g = OctahedralGroup()[i % 24];
      if (group == SymmetryGroup::kTetrahedral && !g.IsEven()) continue;
      const double degrees = 44. * i / 200;
      const Matrix3d b = Turn(degrees, RandomDirection(&generator)) * a * g.matrix();
      EXPECT_NEAR(AngleBetween(a, b, group), degrees * EIGEN_PI / 180, 1e-13);
      EXPECT_NEAR(AngleBetween(b, a, group), degrees * EIGEN_PI / 180, 1e-13);
    }
  }
}

// The vertices of the zones are farthest from the identity.
TEST(AngleBetween, HasTheLargestValuesAtTheVertices) {
  const double b = std::sqrt(2.) - 1;
  const double farthest_frame = 2 * std::atan(Vector3d(b, b, 1 - 2 * b).norm());
  EXPECT_NEAR(farthest_frame * 180 / EIGEN_PI, 62.7994, 1e-4);
  std::mt19937 generator(7);
  for (int i = 0; i < 5000; ++i) {
    const Matrix3d a = RandomFrame(&generator), b = RandomFrame(&generator);
    EXPECT_LE(AngleBetween(a, b, SymmetryGroup::kOctahedral), farthest_frame + 1e-12);
    EXPECT_LE(AngleBetween(a, b, SymmetryGroup::kTetrahedral), EIGEN_PI / 2 + 1e-12);
  }
  const Matrix3d a = RotationFromRodrigues({b, b, 1 - 2 * b});
  EXPECT_NEAR(AngleBetween(Matrix3d::Identity(), a, SymmetryGroup::kOctahedral), farthest_frame, 1e-14);
  EXPECT_NEAR(AngleBetween(Matrix3d::Identity(), Turn(90, Vector3d::UnitX()), SymmetryGroup::kTetrahedral),
              EIGEN_PI / 2, 1e-14);
  EXPECT_NEAR(AngleBetween(Matrix3d::Identity(), Turn(90, Vector3d::UnitX()), SymmetryGroup::kOctahedral), 0, 1e-14);
}

TEST(FundamentalZone, RefusesBadInput) {
  const Matrix3d reflection = -Matrix3d::Identity();
  const SymmetryGroup group = SymmetryGroup::kOctahedral;
  EXPECT_THROW(RodriguesFromRotation(reflection), std::invalid_argument);
  EXPECT_THROW(RodriguesFromRotation(Turn(180, {1, 2, 3})), std::invalid_argument);
  EXPECT_THROW(RotationFromRodrigues({0, std::numeric_limits<double>::infinity(), 0}), std::invalid_argument);
  EXPECT_THROW(ReduceToZone(reflection, group), std::invalid_argument);
  EXPECT_THROW(AngleBetween(Matrix3d::Identity(), reflection, group), std::invalid_argument);
  EXPECT_THROW(AngleBetween(reflection, Matrix3d::Identity(), group), std::invalid_argument);
  EXPECT_THROW(GluedPoint({0.1, 0, 0}, ZoneFaces(group)[0]), std::invalid_argument);
  try {
    RodriguesFromRotation(Turn(180, Vector3d::UnitX()));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("RodriguesFromRotation: a half turn about: ["));
  }
}

}  // namespace
}  // namespace octupole
