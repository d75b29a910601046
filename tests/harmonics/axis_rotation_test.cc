#include "octupole/harmonics/axis_rotation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace octupole {
namespace {

using Eigen::Vector3d;

template <typename Degree>
class AxisRotationTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AxisRotationTest, Degrees);

template <int kDegree>
HarmonicMatrix<kDegree> About(const Vector3d& axis, double angle) {
  return HarmonicRotation<kDegree>(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
}

TYPED_TEST(AxisRotationTest, IsRightHandedExceptForThePapersY) {
  constexpr int l = TypeParam::value;
  for (const double angle : {-2., -0.1, 0., 0.7, 3., 10.}) {
    EXPECT_LT((HarmonicRotationX<l>(angle) - About<l>(Vector3d::UnitX(), angle)).norm(), 1e-14);
    EXPECT_LT((HarmonicRotationY<l>(angle) - About<l>(Vector3d::UnitY(), angle)).norm(), 1e-14);
    EXPECT_LT((HarmonicRotationZ<l>(angle) - About<l>(Vector3d::UnitZ(), angle)).norm(), 1e-14);
    EXPECT_LT((PaperRotationY<l>(angle) - About<l>(Vector3d::UnitY(), -angle)).norm(), 1e-14);
  }
  EXPECT_LT((HarmonicQuarterTurnX<l>() - About<l>(Vector3d::UnitX(), EIGEN_PI / 2)).norm(), 1e-14);
}

TYPED_TEST(AxisRotationTest, RefusesAnglesThatAreNotFinite) {
  constexpr int l = TypeParam::value;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(HarmonicRotationX<l>(nan), std::invalid_argument);
  EXPECT_THROW(HarmonicRotationY<l>(nan), std::invalid_argument);
  EXPECT_THROW(HarmonicRotationZ<l>(std::numeric_limits<double>::infinity()), std::invalid_argument);
  try {
    PaperRotationY<l>(-std::numeric_limits<double>::infinity());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StrEq("PaperRotationY: not an angle: -inf"));
  }
}

// Paper, A.1, as printed.
TEST(PaperMatrices, AreThosePrinted) {
  const double s6 = std::sqrt(6.), s10 = std::sqrt(10.), s15 = std::sqrt(15.);
  HarmonicMatrix<3> quarter;
  quarter << 0, 0, 0, s10, 0, -s6, 0,  //
      0, -4, 0, 0, 0, 0, 0,            //
      0, 0, 0, s6, 0, s10, 0,          //
      -s10, 0, -s6, 0, 0, 0, 0,        //
      0, 0, 0, 0, -1, 0, -s15,         //
      s6, 0, -s10, 0, 0, 0, 0,         //
      0, 0, 0, 0, -s15, 0, 1;
  quarter /= 4;
  EXPECT_LT((HarmonicQuarterTurnX<3>() - quarter).norm(), 1e-15);
  const double t = 0.7;
  const double c1 = std::cos(t), s1 = std::sin(t), c2 = std::cos(2 * t), s2 = std::sin(2 * t), c3 = std::cos(3 * t),
               s3 = std::sin(3 * t);
  HarmonicMatrix<3> about_z;
  about_z << c3, 0, 0, 0, 0, 0, s3,  //
      0, c2, 0, 0, 0, s2, 0,         //
      0, 0, c1, 0, s1, 0, 0,         //
      0, 0, 0, 1, 0, 0, 0,           //
      0, 0, -s1, 0, c1, 0, 0,        //
      0, -s2, 0, 0, 0, c2, 0,        //
      -s3, 0, 0, 0, 0, 0, c3;
  EXPECT_LT((HarmonicRotationZ<3>(t) - about_z).norm(), 1e-15);
  // The products that define R_y and R_x.
  const HarmonicMatrix<3> about_y = quarter * about_z * quarter.transpose();
  EXPECT_LT((PaperRotationY<3>(t) - about_y).norm(), 1e-14);
  const HarmonicMatrix<3> quarter_y = PaperRotationY<3>(EIGEN_PI / 2);
  EXPECT_LT((HarmonicRotationX<3>(t) - quarter_y.transpose() * about_z * quarter_y).norm(), 1e-14);
  EXPECT_LT((HarmonicRotationX<3>(EIGEN_PI / 2) - quarter).norm(), 1e-14);
}

}  // namespace
}  // namespace octupole
