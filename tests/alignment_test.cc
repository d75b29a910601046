#include "octupole/alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frame.h"
#include "octupole/quadrics.h"
#include "octupole/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <typename Degree>
class AlignedSubspaceTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AlignedSubspaceTest, Degrees);

TYPED_TEST(AlignedSubspaceTest, HasAnOrthonormalBasisOf7Or2Or1Columns) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const std::vector<std::pair<Alignment, int>> cases = {{Alignment(), kDimension<l>},
                                                          {Alignment::Axis(3 * RandomDirection(&generator)), 2},
                                                          {Alignment::Frame(RandomFrame(&generator)), 1}};
    for (const auto& [alignment, columns] : cases) {
      const AlignedSubspace<l> subspace(alignment);
      ASSERT_EQ(subspace.basis.cols(), columns);
      EXPECT_LT((subspace.basis.transpose() * subspace.basis - Eigen::MatrixXd::Identity(columns, columns)).norm(),
                1e-13);
      EXPECT_LT((subspace.basis.transpose() * subspace.offset).norm(), 1e-13);
    }
  }
}

// Every frame with the axis lies in the subspace, on a circle of the stated radius (theory.md, section 4).
TYPED_TEST(AlignedSubspaceTest, HoldsTheFramesWithTheAxis) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    for (int k = 0; k < 3; ++k) {
      const AlignedSubspace<l> subspace(Alignment::Axis(-frame.col(k)));
      const Harmonic<l> h = HarmonicFromFrame<l>(frame);
      EXPECT_LT((subspace.Project(h) - h).norm(), 1e-13);
      EXPECT_NEAR((h - subspace.offset).squaredNorm(), l == 3 ? 1 : 5. / 12, 1e-13);
    }
  }
}

TYPED_TEST(AlignedSubspaceTest, HoldsNothingElseOnItsCircle) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  const Vector3d axis = RandomDirection(&generator);
  const AlignedSubspace<l> subspace(Alignment::Axis(axis));
  const double radius = l == 3 ? 1 : std::sqrt(5. / 12);
  for (int i = 0; i < 50; ++i) {
    const double t = 0.1 * i;
    const Harmonic<l> h =
        subspace.offset + radius * (std::cos(t) * subspace.basis.col(0) + std::sin(t) * subspace.basis.col(1));
    EXPECT_LT(Deviation<l>(h), 1e-25);
    EXPECT_NEAR((NearestFrame<l>(h).transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

TYPED_TEST(AlignedSubspaceTest, WorksForEveryDirection) {
  constexpr int l = TypeParam::value;
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0, 1e-9, -1), Vector3d(1e-300, 0, 0),
                               Vector3d(1e300, 1e300, 0), Vector3d(-1, 0, 0)}) {
    const Alignment alignment = Alignment::Axis(axis);
    EXPECT_NEAR(alignment.frame().col(2).dot(axis.stableNormalized()), 1, 1e-15);
    EXPECT_LT((AlignedSubspace<l>(alignment).Project(HarmonicFromFrame<l>(alignment.frame())) -
               HarmonicFromFrame<l>(alignment.frame()))
                  .norm(),
              1e-13);
  }
}

TEST(Alignment, RefusesWhatIsNoDirectionOrFrame) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Alignment::Axis(Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(Alignment::Axis({0, nan, 1}), std::invalid_argument);
  EXPECT_THROW(Alignment::Frame(2 * Matrix3d::Identity()), std::invalid_argument);
  EXPECT_THROW(Alignment::Frame(-Matrix3d::Identity()), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
