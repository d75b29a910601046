#include "octupole/cost_functions/deviation_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class DeviationCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(DeviationCostTest, Degrees);

TYPED_TEST(DeviationCostTest, DerivativesAgree) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(DeviationCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 20; ++i) ExpectJacobiansAreDerivatives(*cost, {RandomHarmonic<l>(&generator)});
}

TYPED_TEST(DeviationCostTest, IsFiniteAtZeroAndOnFrames) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(DeviationCost<l>::Create(kWeight));
  std::mt19937 generator(2);
  ExpectFinite(*cost, {Harmonic<l>::Zero()});
  ExpectFinite(*cost, {ReferenceHarmonic<l>()});
  ExpectFinite(*cost, {HarmonicFromFrame<l>(RandomFrame(&generator))});
}

TYPED_TEST(DeviationCostTest, IsInvariant) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(DeviationCost<l>::Create(kWeight));
  std::mt19937 generator(3);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    const Harmonic<l> rotated = HarmonicRotation<l>(RandomFrame(&generator)) * a;
    const double value = Evaluate(*cost, {a}).residuals.squaredNorm();
    EXPECT_NEAR(Evaluate(*cost, {rotated}).residuals.squaredNorm(), value, 1e-12 * value);
  }
}

TYPED_TEST(DeviationCostTest, RefusesABadWeight) {
  EXPECT_THROW(DeviationCost<TypeParam::value>::Create(-1), std::invalid_argument);
}

// theory.md, section 2: the values at the basis, and the curvature 160 that Gauss-Newton sees on frames.
TEST(DeviationCost, HasTheNumbersOfTheoryInDegree3) {
  const std::unique_ptr<ceres::CostFunction> cost(DeviationCost<3>::Create(kWeight));
  const double d[] = {25, 0, 21, 16, 21, 0, 25};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(Evaluate(*cost, {Octupole::Unit(i)}).residuals.squaredNorm(), kWeight * d[i], 1e-12);
  }
  std::mt19937 generator(4);
  const Evaluation evaluation = Evaluate(*cost, {HarmonicFromFrame<3>(RandomFrame(&generator))});
  const HarmonicMatrix<3> gauss_newton = 2 * evaluation.jacobians[0].transpose() * evaluation.jacobians[0];
  const Octupole curvatures = internal::DecomposeSymmetric(gauss_newton).values;
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(curvatures[i], i < 4 ? 0 : 160 * kWeight, 1e-10);
}

}  // namespace
}  // namespace octupole
