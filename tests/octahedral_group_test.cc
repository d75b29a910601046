#include "octupole/octahedral_group.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <vector>

#include "octupole/frame.h"
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

// The frames around a singular curve of valence 3 or 5 turn by a quarter around it.
TEST(IsSingularTriangle, SeesAQuarterTurnAndNothingElse) {
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d world = RandomFrame(&generator);
    const auto turn = [&](double degrees) {
      return Matrix3d(world * Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    };
    EXPECT_TRUE(IsSingularTriangle(turn(0), turn(30), turn(60)));
    EXPECT_TRUE(IsSingularTriangle(turn(0), turn(-30), turn(-60)));
    EXPECT_FALSE(IsSingularTriangle(turn(0), turn(30), turn(15)));
    EXPECT_FALSE(IsSingularTriangle(turn(0), turn(90), turn(180)));
  }
}

}  // namespace
}  // namespace octupole
