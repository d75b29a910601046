#include "octupole/cost_functions/smoothness_cost.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class SmoothnessCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SmoothnessCostTest, Degrees);

TYPED_TEST(SmoothnessCostTest, DerivativesAgree) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator), b = RandomHarmonic<l>(&generator);
    // Away from the switch of form at a . b = 0.
    if (std::abs(a.dot(b)) < 0.1) continue;
    ExpectJacobiansAreDerivatives(*cost, {a, b});
  }
}

TYPED_TEST(SmoothnessCostTest, IsFiniteAtDegeneratePoints) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<l>::Create(kWeight));
  const Harmonic<l> a = ReferenceHarmonic<l>(), zero = Harmonic<l>::Zero();
  ExpectFinite(*cost, {a, a});
  ExpectFinite(*cost, {a, -a});
  ExpectFinite(*cost, {a, zero});
  ExpectFinite(*cost, {zero, a});
  ExpectFinite(*cost, {zero, zero});
  ExpectFinite(*cost, {1e-200 * a, zero});
  ExpectFinite(*cost, {Harmonic<l>::Unit(0), Harmonic<l>::Unit(1)});
}

TYPED_TEST(SmoothnessCostTest, IsInvariantUnderRotatingEverything) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator), b = RandomHarmonic<l>(&generator);
    const HarmonicMatrix<l> d = HarmonicRotation<l>(RandomFrame(&generator));
    const double value = Evaluate(*cost, {a, b}).residuals.squaredNorm();
    EXPECT_NEAR(Evaluate(*cost, {d * a, d * b}).residuals.squaredNorm(), value, 1e-12 * value);
  }
}

// On frames the squared norm has a closed form (theory.md, section 3).
TYPED_TEST(SmoothnessCostTest, EqualsTheClosedFormOnFrames) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(3);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d a = RandomFrame(&generator), b = RandomFrame(&generator);
    const Evaluation evaluation = Evaluate(*cost, {HarmonicFromFrame<l>(a), HarmonicFromFrame<l>(b)});
    EXPECT_NEAR(evaluation.residuals.squaredNorm(), kWeight * FrameDifference<l>(a, b), 1e-12);
  }
}

TYPED_TEST(SmoothnessCostTest, RefusesABadWeight) {
  constexpr int l = TypeParam::value;
  EXPECT_THROW(SmoothnessCost<l>::Create(-1), std::invalid_argument);
  EXPECT_THROW(SmoothnessCost<l>::Create(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

// theory.md, section 3: the energy and its gradient in a.
TEST(SmoothnessCost, HasTheEnergyAndGradientOfTheory) {
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<3>::Create(kWeight));
  std::mt19937 generator(4);
  for (int i = 0; i < 50; ++i) {
    const Octupole a = RandomHarmonic<3>(&generator), b = RandomHarmonic<3>(&generator);
    const double n = a.squaredNorm() + b.squaredNorm(), s = a.dot(b);
    const Evaluation evaluation = Evaluate(*cost, {a, b});
    const double energy = kWeight * (n * n - 4 * s * s);
    EXPECT_NEAR(evaluation.residuals.squaredNorm(), energy, 1e-12 * energy);
    const Octupole gradient = kWeight * (4 * n * a - 8 * s * b);
    EXPECT_LT((2 * evaluation.jacobians[0].transpose() * evaluation.residuals - gradient).norm(),
              1e-12 * gradient.norm());
  }
}

TEST(SmoothnessCost, ForgivesSigns) {
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<3>::Create(kWeight));
  std::mt19937 generator(5);
  const Octupole a = RandomHarmonic<3>(&generator), b = RandomHarmonic<3>(&generator);
  const double energy = Evaluate(*cost, {a, b}).residuals.squaredNorm();
  EXPECT_NEAR(Evaluate(*cost, {a, -b}).residuals.squaredNorm(), energy, 1e-12 * energy);
  EXPECT_EQ(Evaluate(*cost, {a, a}).residuals.norm(), 0);
  EXPECT_EQ(Evaluate(*cost, {a, -a}).residuals.norm(), 0);
}

// Near the optimum Gauss-Newton sees 2 (a - b) or 2 (a + b).
TEST(SmoothnessCost, HasJacobianTwoAtTheOptimum) {
  const std::unique_ptr<ceres::CostFunction> cost(SmoothnessCost<3>::Create(1));
  const Octupole a = ReferenceHarmonic<3>();
  for (const double sign : {1., -1.}) {
    const Evaluation evaluation = Evaluate(*cost, {a, sign * a});
    EXPECT_LT((evaluation.jacobians[0] - 2 * HarmonicMatrix<3>::Identity()).norm(), 1e-14);
    EXPECT_LT((evaluation.jacobians[1] + sign * 2 * HarmonicMatrix<3>::Identity()).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace octupole
