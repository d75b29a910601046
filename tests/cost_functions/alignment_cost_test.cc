#include "octupole/cost_functions/alignment_cost.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/frames/frame.h"
#include "random_inputs.h"

namespace octupole {
namespace {

template <typename Degree>
class AlignmentCostTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AlignmentCostTest, Degrees);

TYPED_TEST(AlignmentCostTest, DerivativesAgreeAndAreFiniteAtZero) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (const Alignment& alignment :
       {Alignment(), Alignment::Axis(RandomDirection(&generator)), Alignment::Frame(RandomFrame(&generator))}) {
    const std::unique_ptr<ceres::CostFunction> cost(AlignmentCost<l>::Create(alignment, kWeight));
    ExpectJacobiansAreDerivatives(*cost, {RandomHarmonic<l>(&generator)});
    ExpectFinite(*cost, {Harmonic<l>::Zero()});
  }
}

// Frames that have the axis cost nothing; others cost what the harmonic of the axis-turned frame says: the squared
// distance to the subspace, here by minimising over a fine set of its points.
TYPED_TEST(AlignmentCostTest, IsZeroExactlyOnAlignedFrames) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d frame = RandomFrame(&generator);
    for (int k = 0; k < 3; ++k) {
      const std::unique_ptr<ceres::CostFunction> cost(AlignmentCost<l>::Create(Alignment::Axis(frame.col(k)), kWeight));
      EXPECT_LT(Evaluate(*cost, {HarmonicFromFrame<l>(frame)}).residuals.norm(), 1e-13);
    }
    const std::unique_ptr<ceres::CostFunction> prescribed(AlignmentCost<l>::Create(Alignment::Frame(frame), kWeight));
    EXPECT_LT(Evaluate(*prescribed, {HarmonicFromFrame<l>(frame)}).residuals.norm(), 1e-13);
    const std::unique_ptr<ceres::CostFunction> other(
        AlignmentCost<l>::Create(Alignment::Axis(frame * Eigen::Vector3d(1, 1, 1)), kWeight));
    EXPECT_GT(Evaluate(*other, {HarmonicFromFrame<l>(frame)}).residuals.norm(), 0.5);
  }
}

TYPED_TEST(AlignmentCostTest, IsTheSquaredDistanceToTheSubspace) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  const Alignment alignment = Alignment::Axis(RandomDirection(&generator));
  const std::unique_ptr<ceres::CostFunction> cost(AlignmentCost<l>::Create(alignment, kWeight));
  const AlignedSubspace<l> subspace(alignment);
  for (int i = 0; i < 50; ++i) {
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    const double value = Evaluate(*cost, {a}).residuals.squaredNorm();
    const Harmonic<l> nearest = subspace.Project(a);
    EXPECT_NEAR(value, kWeight * (a - nearest).squaredNorm(), 1e-12 * value);
    // The nearest: moving in the subspace only goes away.
    for (int j = 0; j < 2; ++j) {
      for (const double step : {-0.1, 0.1}) {
        EXPECT_GT((a - nearest - step * subspace.basis.col(j)).squaredNorm(), (a - nearest).squaredNorm());
      }
    }
  }
}

TYPED_TEST(AlignmentCostTest, IsInvariantUnderRotatingEverything) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(4);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d rotation = RandomFrame(&generator);
    const Eigen::Vector3d axis = RandomDirection(&generator);
    const Harmonic<l> a = RandomHarmonic<l>(&generator);
    const std::unique_ptr<ceres::CostFunction> cost(AlignmentCost<l>::Create(Alignment::Axis(axis), kWeight));
    const std::unique_ptr<ceres::CostFunction> rotated(
        AlignmentCost<l>::Create(Alignment::Axis(rotation * axis), kWeight));
    const double value = Evaluate(*cost, {a}).residuals.squaredNorm();
    EXPECT_NEAR(Evaluate(*rotated, {HarmonicRotation<l>(rotation) * a}).residuals.squaredNorm(), value, 1e-12 * value);
  }
}

TYPED_TEST(AlignmentCostTest, RefusesABadWeight) {
  EXPECT_THROW(AlignmentCost<TypeParam::value>::Create(Alignment(), -1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
