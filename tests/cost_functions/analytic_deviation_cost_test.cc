#include "octupole/cost_functions/analytic_deviation_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/cost_functions/deviation_cost.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/quadrics.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class AnalyticDeviationCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AnalyticDeviationCostTest, Degrees);

TYPED_TEST(AnalyticDeviationCostTest, AgreesWithAutodiffAndNumericDerivatives) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> analytic(AnalyticDeviationCost<l>::Create(kWeight));
  const std::unique_ptr<ceres::CostFunction> autodiff(DeviationCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 20; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    ExpectSame(*analytic, *autodiff, {a});
    ExpectJacobiansAreDerivatives(*analytic, {a});
  }
}

TYPED_TEST(AnalyticDeviationCostTest, IsFiniteAtZeroAndVanishesOnFrames) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticDeviationCost<l>::Create(kWeight));
  std::mt19937 generator(2);
  ExpectFinite(*cost, {Harmonic<l>::Zero()});
  for (int i = 0; i < 20; ++i) {
    const Harmonic<l> h = HarmonicFromFrame<l>(RandomFrame(&generator));
    ExpectFinite(*cost, {h});
    EXPECT_LT(Evaluate(*cost, {h}).residuals.norm(), 1e-13);
  }
}

TYPED_TEST(AnalyticDeviationCostTest, IsInvariant) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticDeviationCost<l>::Create(kWeight));
  std::mt19937 generator(3);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    const Harmonic<l> rotated = HarmonicRotation<l>(RandomFrame(&generator)) * a;
    const double value = Evaluate(*cost, {a}).residuals.squaredNorm();
    EXPECT_NEAR(Evaluate(*cost, {rotated}).residuals.squaredNorm(), value, 1e-12 * value);
  }
}

TYPED_TEST(AnalyticDeviationCostTest, RefusesABadWeight) {
  EXPECT_THROW(AnalyticDeviationCost<TypeParam::value>::Create(-1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
