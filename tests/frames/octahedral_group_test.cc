#include "octupole/frames/octahedral_group.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "octupole/frames/frame.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;

TEST(OctahedralGroup, HasThe24RotationsOfTheCube) {
  const auto& group = OctahedralGroup();
  EXPECT_EQ(group[0], OctahedralRotation());
  std::set<std::vector<double>> distinct;
  for (const auto& g : group) {
    const Matrix3d m = g.matrix();
    EXPECT_EQ(m.determinant(), 1);
    EXPECT_EQ((m.transpose() * m - Matrix3d::Identity()).norm(), 0);
    distinct.emplace(m.data(), m.data() + 9);
  }
  EXPECT_EQ(distinct.size(), 24u);
}

TEST(OctahedralGroup, MultipliesAsItsMatricesDo) {
  for (const auto& g : OctahedralGroup()) {
    for (const auto& h : OctahedralGroup()) EXPECT_EQ((g * h).matrix(), g.matrix() * h.matrix());
  }
}

// The even ones leave the reference octupole alone, the others turn it into its negative.
TEST(OctahedralGroup, HasTheSubgroupA4) {
  int num_even = 0;
  for (const auto& g : OctahedralGroup()) {
    const Octupole rotated = HarmonicFromFrame<3>(g.matrix());
    EXPECT_LT((rotated - (g.IsEven() ? 1 : -1) * ReferenceHarmonic<3>()).norm(), 1e-14);
    num_even += g.IsEven();
    for (const auto& h : OctahedralGroup()) EXPECT_EQ((g * h).IsEven(), g.IsEven() == h.IsEven());
  }
  EXPECT_EQ(num_even, 12);
}

TEST(MatchFrames, FindsTheElementBetweenTwoCopiesOfAFrame) {
  std::mt19937 generator(1);
  for (const auto& g : OctahedralGroup()) {
    const Matrix3d a = RandomFrame(&generator);
    // Any rotation by less than 22.5 degrees leaves g the best match.
    const Matrix3d turn = Eigen::AngleAxisd(0.39, RandomDirection(&generator)).toRotationMatrix();
    EXPECT_EQ(MatchFrames(a, turn * a * g.matrix()), g);
  }
}

// So the octupoles tell whether a match is odd (theory.md, section 6). At 45 degrees about an axis two matches tie.
TEST(MatchFrames, ParityIsTheSignOfTheOctupolesProductBelow45Degrees) {
  std::mt19937 generator(3);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d a = RandomFrame(&generator);
    const auto& g = OctahedralGroup()[i % 24];
    const double angle = EIGEN_PI / 4 * (i % 1000) / 1000;
    const Matrix3d b = Eigen::AngleAxisd(angle, RandomDirection(&generator)).toRotationMatrix() * a * g.matrix();
    EXPECT_EQ(HarmonicFromFrame<3>(a).dot(HarmonicFromFrame<3>(b)) > 0, MatchFrames(a, b).IsEven());
  }
}

// Against the definition: no other element has a larger trace, however far the frames are apart.
TEST(MatchFrames, HasTheLargestTrace) {
  std::mt19937 generator(5);
  for (int i = 0; i < 2000; ++i) {
    const Matrix3d a = RandomFrame(&generator), b = RandomFrame(&generator);
    const auto trace = [&](const OctahedralRotation& g) { return ((a * g.matrix()).transpose() * b).trace(); };
    const OctahedralRotation match = MatchFrames(a, b);
    EXPECT_EQ(match.matrix().determinant(), 1);
    for (const auto& g : OctahedralGroup()) EXPECT_LE(trace(g), trace(match) + 1e-12);
  }
}

TEST(OctahedralRotation, InverseUndoesIt) {
  for (const auto& g : OctahedralGroup()) {
    EXPECT_EQ(g * g.Inverse(), OctahedralRotation());
    EXPECT_EQ(g.Inverse() * g, OctahedralRotation());
  }
}

// Against the angles and axes of the rotations themselves.
TEST(TypeOf, TellsTheConjugacyClasses) {
  std::map<TurnType, int> sizes;
  for (const auto& g : OctahedralGroup()) {
    const TurnType type = TypeOf(g);
    ++sizes[type];
    const Eigen::AngleAxisd turn(g.matrix());
    const double degrees = turn.angle() * 180 / EIGEN_PI, largest = turn.axis().cwiseAbs().maxCoeff();
    const std::map<TurnType, std::pair<double, double>> angle_and_largest = {
        {TurnType::kNone, {0, 1}},
        {TurnType::kQuarter, {90, 1}},
        {TurnType::kHalf, {180, 1}},
        {TurnType::kDiagonalHalf, {180, M_SQRT1_2}},
        {TurnType::kThird, {120, std::sqrt(1. / 3)}}};
    EXPECT_NEAR(degrees, angle_and_largest.at(type).first, 1e-6);
    EXPECT_NEAR(largest, angle_and_largest.at(type).second, 1e-6);
    for (const auto& h : OctahedralGroup()) EXPECT_EQ(TypeOf(h * g * h.Inverse()), type);
  }
  EXPECT_EQ(sizes, (std::map<TurnType, int>{{TurnType::kNone, 1},
                                            {TurnType::kQuarter, 6},
                                            {TurnType::kHalf, 3},
                                            {TurnType::kDiagonalHalf, 6},
                                            {TurnType::kThird, 8}}));
}

// Frames that turn evenly, three times by a third of an element of the group, however their axes are named. For a half
// turn about an axis a third is 60 degrees, for a frame the same as -30.
TEST(HolonomyType, SeesThePrescribedTurnAndNothingElse) {
  std::mt19937 generator(2);
  for (const auto& h : OctahedralGroup()) {
    if (TypeOf(h) == TurnType::kHalf) continue;
    const Eigen::AngleAxisd whole(h.matrix());
    const auto random_name = [&] { return OctahedralGroup()[generator() % 24].matrix(); };
    for (int i = 0; i < 20; ++i) {
      const Matrix3d world = RandomFrame(&generator);
      const auto turned = [&](double share) {
        return Matrix3d(world * Eigen::AngleAxisd(share * whole.angle(), whole.axis()) * random_name());
      };
      const Matrix3d a = turned(0), b = turned(1. / 3), c = turned(2. / 3);
      EXPECT_EQ(HolonomyType(a, b, c), TypeOf(h));
      EXPECT_EQ(HolonomyType(b, a, c), TypeOf(h));
      EXPECT_EQ(HolonomyType(c, b, a), TypeOf(h));
      EXPECT_EQ(HolonomyType(turned(0), turned(.3), turned(.15)), TurnType::kNone);
      const Matrix3d turn = a * Holonomy(a, b, c).matrix().transpose() * a.transpose();
      EXPECT_LT((turn - world * h.matrix() * world.transpose()).norm(), 1e-9);
    }
  }
}

// The shortcut, which decides for the frames less than 40 degrees apart, and the full match, which decides for others,
// against the full match; the frames' angles cover both.
TEST(HolonomyType, AgreesWithTheFullMatch) {
  std::mt19937 generator(4);
  std::map<TurnType, int> sizes;
  for (int i = 0; i < 30000; ++i) {
    const Matrix3d a = RandomFrame(&generator);
    const double angle = 1.1 * (i % 1000) / 1000;
    const auto near_a = [&] {
      return Matrix3d(Eigen::AngleAxisd(angle, RandomDirection(&generator)) * a * OctahedralGroup()[i % 24].matrix());
    };
    const Matrix3d b = near_a(), c = near_a();
    const TurnType type = TypeOf(Holonomy(a, b, c));
    ASSERT_EQ(HolonomyType(a, b, c), type) << i;
    ++sizes[type];
  }
  EXPECT_GT(sizes[TurnType::kQuarter], 1000);
  EXPECT_GT(sizes[TurnType::kThird], 100);
}

// What the shortcut rests on: the largest sum of fourth powers of turns by 40 degrees or more, and by 22.5.
TEST(HolonomyType, RestsOnABoundOfTheSumOfFourthPowers) {
  std::mt19937 generator(6);
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d q = RandomFrame(&generator);
    const double angle = Eigen::AngleAxisd(MatchFrames(Matrix3d::Identity(), q).matrix().transpose() * q).angle();
    const double sine = std::sin(std::min(2 * angle, std::acos(0.)));
    EXPECT_LT(SumOfFourthPowers(q), 3 - sine * sine + 1e-12);
  }
}

// No frame is farther than 62.8 degrees from another, and about an axis none farther than 45 degrees, so that three
// matches do not reach a half turn about an axis; the others they do.
TEST(HolonomyType, IsNeverAHalfTurnAboutAnAxis) {
  std::mt19937 generator(7);
  std::map<TurnType, int> sizes;
  for (int i = 0; i < 100000; ++i) {
    ++sizes[HolonomyType(RandomFrame(&generator), RandomFrame(&generator), RandomFrame(&generator))];
  }
  EXPECT_EQ(sizes[TurnType::kHalf], 0);
  EXPECT_GT(sizes[TurnType::kQuarter], 10000);
  EXPECT_GT(sizes[TurnType::kThird], 1000);
}

// The product of the holonomies of a tetrahedron's faces is the identity, each based at the first vertex. So one face
// is never singular alone, and the number of odd ones is even.
TEST(Holonomy, OfThreeFacesDeterminesThatOfTheFourth) {
  std::mt19937 generator(8);
  for (int i = 0; i < 2000; ++i) {
    std::array<Matrix3d, 4> f;
    for (Matrix3d& frame : f) frame = RandomFrame(&generator);
    const auto fourth = Holonomy(f[0], f[1], f[2]) * Holonomy(f[0], f[2], f[3]) * Holonomy(f[0], f[1], f[3]).Inverse();
    const auto match = MatchFrames(f[0], f[1]);
    EXPECT_EQ(fourth, match * Holonomy(f[1], f[2], f[3]) * match.Inverse());
  }
}

}  // namespace
}  // namespace octupole
