#include "octupole/cost_functions/analytic_smoothness_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/cost_functions/smoothness_cost.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class AnalyticSmoothnessCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AnalyticSmoothnessCostTest, Degrees);

TYPED_TEST(AnalyticSmoothnessCostTest, AgreesWithAutodiffAndNumericDerivatives) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> analytic(AnalyticSmoothnessCost<l>::Create(kWeight));
  const std::unique_ptr<ceres::CostFunction> autodiff(SmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator), b = RandomHarmonic<l>(&generator);
    ExpectSame(*analytic, *autodiff, {a, b});
    // Differences do not see the switch of form at a . b = 0.
    if (std::abs(a.dot(b)) > 0.1) ExpectJacobiansAreDerivatives(*analytic, {a, b});
  }
}

TYPED_TEST(AnalyticSmoothnessCostTest, AgreesWithAutodiffAtDegeneratePoints) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> analytic(AnalyticSmoothnessCost<l>::Create(kWeight));
  const std::unique_ptr<ceres::CostFunction> autodiff(SmoothnessCost<l>::Create(kWeight));
  const Harmonic<l> a = ReferenceHarmonic<l>(), zero = Harmonic<l>::Zero();
  for (const auto& [p, q] : {std::pair(a, a), std::pair(a, Harmonic<l>(-a)), std::pair(a, zero), std::pair(zero, a),
                             std::pair(zero, zero)}) {
    ExpectFinite(*analytic, {p, q});
    ExpectSame(*analytic, *autodiff, {p, q});
  }
}

TYPED_TEST(AnalyticSmoothnessCostTest, IsInvariantAndHasTheClosedFormOnFrames) {
  constexpr int l = TypeParam::value;
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticSmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d a = RandomFrame(&generator), b = RandomFrame(&generator);
    const HarmonicMatrix<l> d = HarmonicRotation<l>(RandomFrame(&generator));
    const double energy = kWeight * FrameDifference<l>(a, b);
    const Harmonic<l> h = HarmonicFromFrame<l>(a), g = HarmonicFromFrame<l>(b);
    EXPECT_NEAR(Evaluate(*cost, {h, g}).residuals.squaredNorm(), energy, 1e-12);
    EXPECT_NEAR(Evaluate(*cost, {d * h, d * g}).residuals.squaredNorm(), energy, 1e-12);
  }
}

// Ceres passes null for the Jacobians of constant blocks.
TYPED_TEST(AnalyticSmoothnessCostTest, WritesOnlyTheJacobiansAskedFor) {
  constexpr int l = TypeParam::value;
  constexpr int n = kDimension<l>;
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticSmoothnessCost<l>::Create(kWeight));
  std::mt19937 generator(3);
  const Harmonic<l> a = RandomHarmonic<l>(&generator), b = RandomHarmonic<l>(&generator);
  const Evaluation all = Evaluate(*cost, {a, b});
  const double* parameters[] = {a.data(), b.data()};
  for (int block = 0; block < 2; ++block) {
    Harmonic<l> residuals;
    Eigen::Matrix<double, n, n, Eigen::RowMajor> jacobian;
    double* jacobians[] = {nullptr, nullptr};
    jacobians[block] = jacobian.data();
    ASSERT_TRUE(cost->Evaluate(parameters, residuals.data(), jacobians));
    EXPECT_EQ(jacobian, all.jacobians[block]);
  }
}

TYPED_TEST(AnalyticSmoothnessCostTest, RefusesABadWeight) {
  EXPECT_THROW(AnalyticSmoothnessCost<TypeParam::value>::Create(-1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
