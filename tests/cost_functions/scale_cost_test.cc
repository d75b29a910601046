#include "octupole/cost_functions/scale_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class ScaleCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(ScaleCostTest, Degrees);

TYPED_TEST(ScaleCostTest, HasDerivativesClosedFormAndInvariance) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(ScaleCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const double length = 0.2 * i;
    const Harmonic<l> a = length * RandomHarmonic<l>(&generator).normalized();
    ExpectJacobiansAreDerivatives(*cost, {a});
    const double energy = kWeight * std::pow(length * length - 1, 2);
    EXPECT_NEAR(Evaluate(*cost, {a}).residuals.squaredNorm(), energy, 1e-12 * (1 + energy));
    const Harmonic<l> rotated = HarmonicRotation<l>(RandomFrame(&generator)) * a;
    EXPECT_NEAR(Evaluate(*cost, {rotated}).residuals.squaredNorm(), energy, 1e-12 * (1 + energy));
  }
}

TYPED_TEST(ScaleCostTest, IsFiniteAtZero) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(ScaleCost<l>::Create(kWeight));
  ExpectFinite(*cost, {Harmonic<l>::Zero()});
}

TYPED_TEST(ScaleCostTest, RefusesABadWeight) {
  EXPECT_THROW(ScaleCost<TypeParam::value>::Create(-1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
