#include "octupole/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/octahedral_group.h"
#include "octupole/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <typename Degree>
class FrameTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(FrameTest, Degrees);

double AngleBetween(const Matrix3d& a, const Matrix3d& b) {
  return Eigen::AngleAxisd((a * MatchFrames(a, b).matrix()).transpose() * b).angle();
}

TYPED_TEST(FrameTest, HarmonicIsThatOfTheAxes) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const Vector3d at = RandomDirection(&generator);
    // The reference in the coordinates of the frame.
    const double expected = ReferenceHarmonic<l>().dot(EvaluateBasis<l>(frame.transpose() * at));
    EXPECT_NEAR(HarmonicFromFrame<l>(frame).dot(EvaluateBasis<l>(at)), expected, 1e-13);
  }
}

TYPED_TEST(FrameTest, HarmonicForgetsOrderAndSignsOfAxes) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  const Matrix3d frame = RandomFrame(&generator);
  const Harmonic<l> h = HarmonicFromFrame<l>(frame);
  int num_same = 0;
  for (const auto& g : OctahedralGroup()) {
    const Harmonic<l> other = HarmonicFromFrame<l>(frame * g.matrix());
    EXPECT_NEAR(std::abs(h.dot(other)), 1, 1e-13);
    num_same += h.dot(other) > 0;
  }
  EXPECT_EQ(num_same, l == 3 ? 12 : 24);
}

TYPED_TEST(FrameTest, NearestFrameInvertsHarmonicFromFrame) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const double scale = std::pow(10, i % 20 - 10);
    const Matrix3d nearest = NearestFrame<l>(scale * HarmonicFromFrame<l>(frame));
    EXPECT_LT(AngleBetween(frame, nearest), 1e-12);
    EXPECT_LT((nearest.transpose() * nearest - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(nearest.determinant(), 1, 1e-14);
  }
}

TYPED_TEST(FrameTest, NearestFrameTurnsWithItsHarmonic) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(4);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d rotation = RandomFrame(&generator);
    // Near enough to the manifold for the nearest frame to be unique.
    const Harmonic<l> h = HarmonicFromFrame<l>(RandomFrame(&generator)) + 0.1 * RandomHarmonic<l>(&generator);
    EXPECT_LT(AngleBetween(rotation * NearestFrame<l>(h), NearestFrame<l>(HarmonicRotation<l>(rotation) * h)), 1e-7);
  }
}

// Against a brute force that shares nothing with it: the best of many random frames, polished by random search.
TYPED_TEST(FrameTest, NearestFrameIsGlobal) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(5);
  Eigen::Matrix<double, kDimension<l>, Eigen::Dynamic> samples(kDimension<l>, 20000);
  for (Eigen::Index i = 0; i < samples.cols(); ++i) samples.col(i) = HarmonicFromFrame<l>(RandomFrame(&generator));
  for (int i = 0; i < 2000; ++i) {
    const Harmonic<l> h = RandomHarmonic<l>(&generator).normalized();
    const double found = h.dot(HarmonicFromFrame<l>(NearestFrame<l>(h)));
    EXPECT_GE(found, (h.transpose() * samples).maxCoeff()) << h.transpose();
  }
}

TYPED_TEST(FrameTest, NearestFrameOfDegenerateHarmonicsIsAFrame) {
  constexpr int l = TypeParam::value;
  for (int i = 0; i < kDimension<l>; ++i) {
    for (const double sign : {-1., 1.}) {
      const Matrix3d frame = NearestFrame<l>(sign * Harmonic<l>::Unit(i));
      EXPECT_LT((frame.transpose() * frame - Matrix3d::Identity()).norm(), 1e-14);
    }
  }
}

TYPED_TEST(FrameTest, NearestFrameRefusesZeroAndNonFinite) {
  constexpr int l = TypeParam::value;
  EXPECT_THROW(NearestFrame<l>(Harmonic<l>::Zero()), std::invalid_argument);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Harmonic<l> h = Harmonic<l>::Ones();
    h[2] = bad;
    EXPECT_THROW(NearestFrame<l>(h), std::invalid_argument);
  }
}

// theory.md, section 3: closed forms in Q = A^T B.
TEST(FrameDifference, EqualsItsHarmonicsTerms) {
  std::mt19937 generator(6);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d frame_a = RandomFrame(&generator), frame_b = RandomFrame(&generator);
    const Octupole a = HarmonicFromFrame<3>(frame_a), b = HarmonicFromFrame<3>(frame_b);
    EXPECT_NEAR(a.dot(b), Permanent(frame_a.transpose() * frame_b), 1e-13);
    EXPECT_NEAR(FrameDifference<3>(frame_a, frame_b), (a - b).squaredNorm() * (a + b).squaredNorm(), 1e-13);
    const Hexadecapole g = HarmonicFromFrame<4>(frame_a), h = HarmonicFromFrame<4>(frame_b);
    EXPECT_NEAR(g.dot(h), (SumOfFourthPowers(frame_a.transpose() * frame_b) - 9. / 5) / (6. / 5), 1e-13);
    EXPECT_NEAR(FrameDifference<4>(frame_a, frame_b), (g - h).squaredNorm(), 1e-13);
  }
}

TEST(FrameDifference, IsIsotropicForSmallAnglesInTheRatio2Point4) {
  std::mt19937 generator(7);
  const double angle = 1e-3;
  for (int i = 0; i < 20; ++i) {
    const Matrix3d a = RandomFrame(&generator);
    const Matrix3d b = a * Eigen::AngleAxisd(angle, RandomDirection(&generator)).toRotationMatrix();
    EXPECT_NEAR(FrameDifference<3>(a, b) / (angle * angle), 16, 1e-3);
    EXPECT_NEAR(FrameDifference<4>(a, b) / (angle * angle), 20. / 3, 1e-3);
  }
}

}  // namespace
}  // namespace octupole
