#include "octupole/alignment/aligned_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class AlignedFrameTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AlignedFrameTest, Degrees);

// Among many angles about the axis none gives a nearer harmonic, up to its sign in degree 3.
TYPED_TEST(AlignedFrameTest, IsTheNearestAboutAnAxis) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Alignment alignment = Alignment::Axis(RandomDirection(&generator));
    const Harmonic<l> h = RandomHarmonic<l>(&generator);
    const Eigen::Matrix3d frame = NearestAlignedFrame<l>(alignment, h);
    EXPECT_NO_THROW(CheckRotation("test", frame));
    EXPECT_LT((frame.col(2) - alignment.frame().col(2)).norm(), 1e-12);
    const double value = h.dot(HarmonicFromFrame<l>(frame));
    for (int i = 0; i < 360; ++i) {
      const Eigen::Matrix3d other =
          alignment.frame() * Eigen::AngleAxisd(i * EIGEN_PI / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      EXPECT_LE(h.dot(HarmonicFromFrame<l>(other)), value + 1e-12);
    }
  }
}

TYPED_TEST(AlignedFrameTest, GivesTheFrameOfAFreeHarmonicAndKeepsAPrescribedOne) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  const Eigen::Matrix3d frame = RandomFrame(&generator);
  const Harmonic<l> h = HarmonicFromFrame<l>(frame);
  EXPECT_LT(FrameDifference<l>(NearestAlignedFrame<l>(Alignment(), h), frame), 1e-12);
  const Eigen::Matrix3d prescribed = RandomFrame(&generator);
  EXPECT_LT((NearestAlignedFrame<l>(Alignment::Frame(prescribed), h) - prescribed).norm(), 1e-12);
}

TYPED_TEST(AlignedFrameTest, TakesZeroAndRefusesWhatIsNotFinite) {
  constexpr int l = TypeParam::value;
  for (const Alignment& alignment : {Alignment(), Alignment::Axis({1, 2, 3})}) {
    EXPECT_EQ(NearestAlignedFrame<l>(alignment, Harmonic<l>::Zero()), alignment.frame());
    Harmonic<l> h = Harmonic<l>::Zero();
    h[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(NearestAlignedFrame<l>(alignment, h), std::invalid_argument);
  }
}

// A small turn away from the aligned frame is undone but for the angle about the axis.
TEST(AlignFrames, MovesWhatIsAlignedAndNothingElse) {
  std::mt19937 generator(5);
  const Eigen::Matrix3d frame = RandomFrame(&generator);
  const Eigen::Matrix3d tilted = Eigen::AngleAxisd(0.1, frame.col(0)).toRotationMatrix() * frame;
  const std::vector<Eigen::Matrix3d> aligned =
      AlignFrames({Alignment(), Alignment::Axis(frame.col(2)), Alignment::Frame(frame)}, {tilted, tilted, tilted});
  ASSERT_EQ(aligned.size(), 3u);
  EXPECT_EQ(aligned[0], tilted);
  EXPECT_LT(FrameDifference<4>(aligned[1], frame), 1e-12);
  EXPECT_LT(FrameDifference<4>(aligned[2], frame), 1e-12);
  EXPECT_THROW(AlignFrames({Alignment()}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
