#include "octupole/octahedral_group.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <vector>

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

TEST(MatchFrames, FindsTheElementBetweenTwoCopiesOfAFrame) {
  std::mt19937 generator(1);
  for (const auto& g : OctahedralGroup()) {
    const Matrix3d a = RandomFrame(&generator);
    // Any rotation by less than 22.5 degrees leaves g the best match.
    const Matrix3d turn = Eigen::AngleAxisd(0.39, RandomDirection(&generator)).toRotationMatrix();
    EXPECT_EQ(MatchFrames(a, turn * a * g.matrix()), g);
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
