#include "octupole/harmonics/rotation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <typename Degree>
class RotationTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(RotationTest, Degrees);

// The definition, sampled: D(R) h evaluated at x is h evaluated at R^-1 x.
TYPED_TEST(RotationTest, RotatesSampledHarmonics) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d rotation = RandomFrame(&generator);
    const Harmonic<l> h = RandomHarmonic<l>(&generator);
    const Vector3d at = RandomDirection(&generator);
    EXPECT_NEAR((HarmonicRotation<l>(rotation) * h).dot(EvaluateBasis<l>(at)),
                h.dot(EvaluateBasis<l>(rotation.transpose() * at)), 1e-13);
  }
}

TYPED_TEST(RotationTest, IsAnOrthogonalHomomorphism) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d a = RandomFrame(&generator), b = RandomFrame(&generator);
    const HarmonicMatrix<l> da = HarmonicRotation<l>(a), db = HarmonicRotation<l>(b);
    EXPECT_LT((HarmonicRotation<l>(a * b) - da * db).norm(), 1e-13);
    EXPECT_LT((da * da.transpose() - HarmonicMatrix<l>::Identity()).norm(), 1e-13);
  }
}

TYPED_TEST(RotationTest, TurnsTheReferenceByQuarterTurnsIntoItsNegativeInDegree3) {
  constexpr int l = TypeParam::value;
  const int sign = l == 3 ? -1 : 1;
  const Harmonic<l> reference = ReferenceHarmonic<l>();
  for (int k = 0; k < 3; ++k) {
    const Matrix3d quarter = Eigen::AngleAxisd(EIGEN_PI / 2, Vector3d::Unit(k)).toRotationMatrix();
    EXPECT_LT((HarmonicRotation<l>(quarter) * reference - sign * reference).norm(), 1e-14);
    const Matrix3d half = quarter * quarter;
    EXPECT_LT((HarmonicRotation<l>(half) * reference - reference).norm(), 1e-14);
  }
}

TYPED_TEST(RotationTest, HasTheGeneratorsAsDerivatives) {
  constexpr int l = TypeParam::value;
  const double t = 1e-4;
  for (int k = 0; k < 3; ++k) {
    const auto turn = [&](double angle) {
      return HarmonicRotation<l>(Eigen::AngleAxisd(angle, Vector3d::Unit(k)).toRotationMatrix());
    };
    const HarmonicMatrix<l> difference = (turn(t) - turn(-t)) / (2 * t);
    EXPECT_LT((RotationGenerators<l>()[k] - difference).norm(), 1e-6);
  }
}

TYPED_TEST(RotationTest, GeneratorsCommuteAsRotationsDo) {
  constexpr int l = TypeParam::value;
  const auto& g = RotationGenerators<l>();
  HarmonicMatrix<l> casimir = HarmonicMatrix<l>::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto &a = g[k], &b = g[(k + 1) % 3], &c = g[(k + 2) % 3];
    EXPECT_LT((a * b - b * a - c).norm(), 1e-13);
    EXPECT_EQ((a + a.transpose()).norm(), 0);
    casimir += a * a;
  }
  EXPECT_LT((casimir + l * (l + 1) * HarmonicMatrix<l>::Identity()).norm(), 1e-13);
}

TYPED_TEST(RotationTest, TakesAQuaternionOfEitherSign) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond q = RandomRotation(&generator);
    const HarmonicMatrix<l> expected = HarmonicRotation<l>(q.toRotationMatrix());
    EXPECT_LT((HarmonicRotation<l>(q) - expected).norm(), 1e-14);
    EXPECT_LT((HarmonicRotation<l>(Eigen::Quaterniond(-q.coeffs())) - expected).norm(), 1e-14);
  }
}

TYPED_TEST(RotationTest, RefusesQuaternionsThatAreNotUnit) {
  constexpr int l = TypeParam::value;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Quaterniond& bad :
       {Eigen::Quaterniond(0, 0, 0, 0), Eigen::Quaterniond(1, 0, 0, 0.01), Eigen::Quaterniond(nan, 0, 0, 1)}) {
    EXPECT_THROW(HarmonicRotation<l>(bad), std::invalid_argument);
  }
  try {
    HarmonicRotation<l>(Eigen::Quaterniond(2, 0, 0, 1));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StrEq("HarmonicRotation: not a unit quaternion: [2, 0, 0, 1]"));
  }
}

TYPED_TEST(RotationTest, RefusesWhatIsNoRotation) {
  constexpr int l = TypeParam::value;
  const Matrix3d reflection = Vector3d(1, 1, -1).asDiagonal();
  const Matrix3d stretch = Vector3d(1, 1, 1.1).asDiagonal();
  Matrix3d nan = Matrix3d::Identity();
  nan(1, 2) = std::numeric_limits<double>::quiet_NaN();
  for (const Matrix3d& bad : {reflection, stretch, nan, Matrix3d(Matrix3d::Zero())}) {
    EXPECT_THROW(HarmonicRotation<l>(bad), std::invalid_argument);
  }
  try {
    HarmonicRotation<l>(reflection);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StrEq("HarmonicRotation: not a rotation: [1, 0, 0; 0, 1, 0; 0, 0, -1]"));
  }
}

}  // namespace
}  // namespace octupole
