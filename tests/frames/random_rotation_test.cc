#include "octupole/frames/random_rotation.h"

#include <gtest/gtest.h>

namespace octupole {
namespace {

TEST(RandomRotation, IsUniform) {
  std::mt19937 generator(1);
  constexpr int kNumSamples = 20000;
  // For Haar-distributed rotations every entry of the matrix has mean 0 and mean square 1/3.
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero(), mean_square = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kNumSamples; ++i) {
    const Eigen::Quaterniond q = RandomRotation(&generator);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    mean += q.toRotationMatrix() / kNumSamples;
    mean_square += q.toRotationMatrix().cwiseAbs2() / kNumSamples;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((mean_square.array() - 1. / 3).abs().maxCoeff(), 0.02);
}

TEST(RandomRotation, RepeatsWithItsSeed) {
  std::mt19937 a(7), b(7), c(8);
  const Eigen::Quaterniond first = RandomRotation(&a);
  EXPECT_EQ(first.coeffs(), RandomRotation(&b).coeffs());
  EXPECT_NE(first.coeffs(), RandomRotation(&c).coeffs());
}

}  // namespace
}  // namespace octupole
