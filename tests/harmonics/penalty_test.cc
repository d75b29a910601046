#include "octupole/harmonics/penalty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class PenaltyTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(PenaltyTest, Degrees);

constexpr double kScaleWeight = 5, kDeviationWeight = 2.5;

// Along a line p is a polynomial of degree 4 in t: central differences at two steps give its derivatives at 0 exactly.
template <typename Function>
double FirstDerivative(const Function& f) {
  return (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / 12;
}
template <typename Function>
double SecondDerivative(const Function& f) {
  return (16 * (f(1) + f(-1)) - (f(2) + f(-2)) - 30 * f(0)) / 12;
}

TYPED_TEST(PenaltyTest, HasTheStatedGradientAndHessian) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Harmonic<l> h = RandomHarmonic<l>(&generator), direction = RandomHarmonic<l>(&generator).normalized();
    const auto d = [&](double t) { return Deviation<l>(h + t * direction); };
    const auto p = [&](double t) { return Penalty<l>(h + t * direction, kScaleWeight, kDeviationWeight); };
    const double tolerance = 1e-11 * (1 + std::pow(h.norm() + 2, 4));
    EXPECT_NEAR(direction.dot(DeviationGradient<l>(h)), FirstDerivative(d), tolerance);
    EXPECT_NEAR(direction.dot(DeviationHessian<l>(h) * direction), SecondDerivative(d), tolerance);
    EXPECT_NEAR(direction.dot(PenaltyGradient<l>(h, kScaleWeight, kDeviationWeight)), FirstDerivative(p), tolerance);
    const HarmonicMatrix<l> hessian = PenaltyHessian<l>(h, kScaleWeight, kDeviationWeight);
    EXPECT_NEAR(direction.dot(hessian * direction), SecondDerivative(p), tolerance);
    EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-11);
  }
}

TYPED_TEST(PenaltyTest, VanishesWithItsGradientOnFrames) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 20; ++i) {
    const Harmonic<l> h = HarmonicFromFrame<l>(RandomFrame(&generator));
    EXPECT_LT(Penalty<l>(h, kScaleWeight, kDeviationWeight), 1e-25);
    EXPECT_LT(PenaltyGradient<l>(h, kScaleWeight, kDeviationWeight).norm(), 1e-12);
    EXPECT_NEAR(Penalty<l>(2 * h, kScaleWeight, kDeviationWeight), kScaleWeight * 9, 1e-12);
  }
}

template <int kDegree>
Eigen::VectorXd CurvaturesOfFrames(double scale_weight, double deviation_weight) {
  std::mt19937 generator(3);
  const Harmonic<kDegree> h = HarmonicFromFrame<kDegree>(RandomFrame(&generator));
  return internal::DecomposeSymmetric(PenaltyHessian<kDegree>(h, scale_weight, deviation_weight)).values;
}

void ExpectEqual(const Eigen::VectorXd& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), static_cast<Eigen::Index>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-11) << i;
}

TEST(DeviationHessian, IsIsotropicAcrossTheManifoldInDegree3) {
  ExpectEqual(CurvaturesOfFrames<3>(0, 1), {0, 0, 0, 0, 160, 160, 160});
}

// Two of the five stiff directions are four times as stiff as the other three: no weights make p isotropic.
TEST(DeviationHessian, IsNotIsotropicAcrossTheManifoldInDegree4) {
  const double a = 1120. / 9, b = 4480. / 9;
  ExpectEqual(CurvaturesOfFrames<4>(0, 1), {0, 0, 0, 0, a, a, a, b, b});
}

// theory.md, section 2: then sqrt(p) is 2 sqrt(w1) times the distance, nearby.
TEST(Penalty, IsIsotropicWhenTheDeviationWeighsATwentiethOfTheScale) {
  ExpectEqual(CurvaturesOfFrames<3>(5, 0.25), {0, 0, 0, 40, 40, 40, 40});
  std::mt19937 generator(4);
  for (int i = 0; i < 20; ++i) {
    const Octupole a = HarmonicFromFrame<3>(RandomFrame(&generator)) + 1e-6 * RandomHarmonic<3>(&generator);
    EXPECT_NEAR(std::sqrt(Penalty<3>(a, 5, 0.25)) / (2 * std::sqrt(5.) * DistanceToFrames<3>(a)), 1, 1e-5);
  }
}

}  // namespace
}  // namespace octupole
