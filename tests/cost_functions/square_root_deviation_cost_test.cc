#include "octupole/cost_functions/square_root_deviation_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class SquareRootDeviationCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SquareRootDeviationCostTest, Degrees);

TYPED_TEST(SquareRootDeviationCostTest, DerivativesAgree) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SquareRootDeviationCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 20; ++i) ExpectJacobiansAreDerivatives(*cost, {RandomHarmonic<l>(&generator)});
}

TYPED_TEST(SquareRootDeviationCostTest, IsFiniteWhereTheRootHasNoDerivative) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SquareRootDeviationCost<l>::Create(kWeight));
  std::mt19937 generator(2);
  ExpectFinite(*cost, {Harmonic<l>::Zero()});
  ExpectFinite(*cost, {ReferenceHarmonic<l>()});
  ExpectFinite(*cost, {1e-100 * RandomHarmonic<l>(&generator)});
  for (int i = 0; i < 20; ++i) ExpectFinite(*cost, {HarmonicFromFrame<l>(RandomFrame(&generator))});
}

// Near the manifold the slope of sqrt(d) is bounded: sqrt(80) in degree 3 (theory.md, section 2).
TYPED_TEST(SquareRootDeviationCostTest, HasABoundedJacobianNearFrames) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SquareRootDeviationCost<l>::Create(1));
  std::mt19937 generator(3);
  for (double distance = 1; distance > 1e-14; distance /= 3) {
    const Harmonic<l> a =
        HarmonicFromFrame<l>(RandomFrame(&generator)) + distance * RandomHarmonic<l>(&generator).normalized();
    EXPECT_LT(Evaluate(*cost, {a}).jacobians[0].norm(), 40);
  }
}

TYPED_TEST(SquareRootDeviationCostTest, IsInvariantAndEqualsTheDeviation) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(SquareRootDeviationCost<l>::Create(kWeight));
  std::mt19937 generator(4);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    const Harmonic<l> rotated = HarmonicRotation<l>(RandomFrame(&generator)) * a;
    const double value = Evaluate(*cost, {a}).residuals.squaredNorm();
    EXPECT_NEAR(value, kWeight * Deviation<l>(rotated), 1e-12 * value);
    EXPECT_NEAR(Evaluate(*cost, {rotated}).residuals.squaredNorm(), value, 1e-12 * value);
  }
}

TYPED_TEST(SquareRootDeviationCostTest, RefusesABadWeight) {
  EXPECT_THROW(SquareRootDeviationCost<TypeParam::value>::Create(-1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
