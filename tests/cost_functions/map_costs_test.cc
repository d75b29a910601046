// The residual blocks of seamless maps: do derivatives agree, are they finite where it is degenerate, is the squared
// norm the closed form, is it invariant?

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <random>
#include <stdexcept>

#include "cost_checks.h"
#include "octupole/cost_functions/analytic_injectivity_cost.h"
#include "octupole/cost_functions/analytic_map_gradient_cost.h"
#include "octupole/cost_functions/constant_parameter_cost.h"
#include "octupole/cost_functions/injectivity_cost.h"
#include "octupole/cost_functions/map_gradient_cost.h"
#include "octupole/cost_functions/transition_cost.h"
#include "octupole/frames/octahedral_group.h"
#include "random_inputs.h"

namespace octupole {
namespace {

constexpr double kSize = 0.7;

using Corners = std::array<Eigen::Vector3d, 4>;

const Corners kTet = {Eigen::Vector3d(0.1, 0, 0), Eigen::Vector3d(1.2, 0.1, 0), Eigen::Vector3d(0, 0.9, 0.2),
                      Eigen::Vector3d(0.3, 0.2, 1.1)};

Eigen::Vector3d RandomVector(std::mt19937* generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return {uniform(*generator), uniform(*generator), uniform(*generator)};
}

std::vector<Eigen::VectorXd> RandomVectors(int count, std::mt19937* generator) {
  std::vector<Eigen::VectorXd> vectors;
  for (int i = 0; i < count; ++i) vectors.emplace_back(RandomVector(generator));
  return vectors;
}

// The corners' parameters of the map x -> jacobian x / size + shift.
std::vector<Eigen::VectorXd> Image(const Eigen::Matrix3d& jacobian, const Eigen::Vector3d& shift) {
  std::vector<Eigen::VectorXd> parameters;
  for (const Eigen::Vector3d& p : kTet) parameters.emplace_back(jacobian * p / kSize + shift);
  return parameters;
}

TEST(MapGradientCost, HasTheDerivativesAndTheClosedForm) {
  std::mt19937 generator(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d frame = RandomFrame(&generator), jacobian = Eigen::Matrix3d::Random();
    const std::unique_ptr<ceres::CostFunction> cost(MapGradientCost::Create(kTet, frame, kSize, kWeight));
    ExpectJacobiansAreDerivatives(*cost, RandomVectors(4, &generator));
    const double energy = kWeight * (jacobian - frame.transpose()).squaredNorm();
    const Eigen::Vector3d shift = RandomVector(&generator);
    EXPECT_NEAR(Evaluate(*cost, Image(jacobian, shift)).residuals.squaredNorm(), energy, 1e-12);
    EXPECT_NEAR(Evaluate(*cost, Image(frame.transpose(), shift)).residuals.norm(), 0, 1e-12);
    // Axes named anew, and parameters with them.
    for (const OctahedralRotation& g : OctahedralGroup()) {
      const std::unique_ptr<ceres::CostFunction> renamed(
          MapGradientCost::Create(kTet, frame * g.matrix(), kSize, kWeight));
      EXPECT_NEAR(Evaluate(*renamed, Image(g.matrix().transpose() * jacobian, shift)).residuals.squaredNorm(), energy,
                  1e-12);
    }
  }
}

TEST(MapGradientCost, IsFiniteWhereTheMapIsFlatAndRefusesFlatTets) {
  const std::unique_ptr<ceres::CostFunction> cost(
      MapGradientCost::Create(kTet, Eigen::Matrix3d::Identity(), kSize, kWeight));
  ExpectFinite(*cost, Image(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()));
  Corners flat = kTet;
  flat[3] = flat[2];
  EXPECT_THROW(MapGradientCost::Create(flat, Eigen::Matrix3d::Identity(), kSize, 1), std::invalid_argument);
  EXPECT_THROW(MapGradientCost::Create(kTet, Eigen::Matrix3d::Identity(), 0, 1), std::invalid_argument);
  EXPECT_THROW(MapGradientCost::Create(kTet, Eigen::Matrix3d::Identity(), kSize, -1), std::invalid_argument);
}

TEST(AnalyticMapGradientCost, AgreesWithAutodiffAndNumericDerivatives) {
  std::mt19937 generator(6);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d frame = RandomFrame(&generator), jacobian = Eigen::Matrix3d::Random();
    const std::unique_ptr<ceres::CostFunction> analytic(AnalyticMapGradientCost::Create(kTet, frame, kSize, kWeight));
    const std::unique_ptr<ceres::CostFunction> autodiff(MapGradientCost::Create(kTet, frame, kSize, kWeight));
    const auto parameters = RandomVectors(4, &generator);
    ExpectSame(*analytic, *autodiff, parameters);
    ExpectJacobiansAreDerivatives(*analytic, parameters);
    const double energy = kWeight * (jacobian - frame.transpose()).squaredNorm();
    for (const OctahedralRotation& g : OctahedralGroup()) {
      const std::unique_ptr<ceres::CostFunction> renamed(
          AnalyticMapGradientCost::Create(kTet, frame * g.matrix(), kSize, kWeight));
      const auto image = Image(g.matrix().transpose() * jacobian, RandomVector(&generator));
      EXPECT_NEAR(Evaluate(*renamed, image).residuals.squaredNorm(), energy, 1e-12);
    }
  }
}

TEST(AnalyticMapGradientCost, IsFiniteWhereTheMapIsFlatAndRefusesBadInput) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticMapGradientCost::Create(kTet, identity, kSize, kWeight));
  ExpectFinite(*cost, Image(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()));
  EXPECT_THROW(AnalyticMapGradientCost::Create(kTet, identity, 0, 1), std::invalid_argument);
  EXPECT_THROW(AnalyticMapGradientCost::Create(kTet, identity, kSize, -1), std::invalid_argument);
}

TEST(TransitionCost, VanishesOnSeamsAndHasTheDerivatives) {
  std::mt19937 generator(2);
  for (const OctahedralRotation& g : OctahedralGroup()) {
    const std::unique_ptr<ceres::CostFunction> cost(TransitionCost::Create(g, kWeight));
    const Eigen::Vector3d from = RandomVector(&generator), shift = RandomVector(&generator),
                          off = RandomVector(&generator);
    const Eigen::Vector3d to = g.matrix().transpose() * from + shift;
    ExpectJacobiansAreDerivatives(*cost, {from, to, shift});
    ExpectFinite(*cost, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    EXPECT_NEAR(Evaluate(*cost, {from, to, shift}).residuals.norm(), 0, 1e-15);
    EXPECT_NEAR(Evaluate(*cost, {from, to + off, shift}).residuals.squaredNorm(), kWeight * off.squaredNorm(), 1e-12);
    // The same face from its other side.
    const std::unique_ptr<ceres::CostFunction> back(TransitionCost::Create(g.Inverse(), kWeight));
    EXPECT_NEAR(Evaluate(*back, {to + off, from, -g.matrix() * shift}).residuals.squaredNorm(),
                kWeight * off.squaredNorm(), 1e-12);
  }
  EXPECT_THROW(TransitionCost::Create({}, -1), std::invalid_argument);
}

TEST(ConstantParameterCost, VanishesOnPlanesAndHasTheDerivatives) {
  std::mt19937 generator(3);
  for (int axis = 0; axis < 3; ++axis) {
    const std::unique_ptr<ceres::CostFunction> cost(ConstantParameterCost::Create(axis, kWeight));
    auto corners = RandomVectors(3, &generator);
    ExpectJacobiansAreDerivatives(*cost, corners);
    ExpectFinite(*cost, {corners[0], corners[0], corners[0]});
    const double x = corners[0][axis] - corners[2][axis], y = corners[1][axis] - corners[2][axis];
    EXPECT_NEAR(Evaluate(*cost, corners).residuals.squaredNorm(), kWeight * (x * x + y * y), 1e-12);
    for (Eigen::VectorXd& corner : corners) corner[axis] = 0.3;
    EXPECT_EQ(Evaluate(*cost, corners).residuals.norm(), 0);
  }
  EXPECT_THROW(ConstantParameterCost::Create(3, 1), std::invalid_argument);
  EXPECT_THROW(ConstantParameterCost::Create(0, -1), std::invalid_argument);
}

TEST(InjectivityCost, HasTheDerivativesAndTheClosedForm) {
  std::mt19937 generator(4);
  for (const double epsilon : {1., 0.1}) {
    const std::unique_ptr<ceres::CostFunction> cost(InjectivityCost::Create(kTet, kSize, epsilon, kWeight));
    for (int i = 0; i < 20; ++i) {
      const Eigen::Matrix3d jacobian =
          RandomFrame(&generator) * (Eigen::Matrix3d::Identity() * (i % 2 ? 1 : -1) + 0.3 * Eigen::Matrix3d::Random());
      const double det = jacobian.determinant(), chi = (det + std::sqrt(epsilon * epsilon + det * det)) / 2;
      const double energy = kWeight * (jacobian.squaredNorm() / std::pow(chi, 2. / 3) + (det * det + 1) / chi);
      const auto parameters = Image(jacobian, RandomVector(&generator));
      EXPECT_NEAR(Evaluate(*cost, parameters).residuals.squaredNorm(), energy, 1e-9 * energy);
      EXPECT_NEAR(kWeight * EvaluateFoldoverEnergy(jacobian.squaredNorm(), det, epsilon).energy, energy, 1e-9 * energy);
      if (epsilon == 1) ExpectJacobiansAreDerivatives(*cost, parameters, 1e-6);
      // Turned before or after, it is the same.
      const Eigen::Matrix3d turned = RandomFrame(&generator) * jacobian;
      EXPECT_NEAR(Evaluate(*cost, Image(turned, RandomVector(&generator))).residuals.squaredNorm(), energy,
                  1e-9 * energy);
    }
  }
}

TEST(InjectivityCost, IsFiniteOnFlatAndFlippedTetsAndLeastAtRotations) {
  const std::unique_ptr<ceres::CostFunction> cost(InjectivityCost::Create(kTet, kSize, 1e-6, kWeight));
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  ExpectFinite(*cost, Image(Eigen::Matrix3d::Zero(), zero));
  ExpectFinite(*cost, Image(-Eigen::Matrix3d::Identity(), zero));
  std::mt19937 generator(5);
  EXPECT_NEAR(Evaluate(*cost, Image(RandomFrame(&generator), zero)).residuals.squaredNorm(), 5 * kWeight, 1e-6);
  EXPECT_GT(Evaluate(*cost, Image(1.1 * RandomFrame(&generator), zero)).residuals.squaredNorm(), 5 * kWeight);
  EXPECT_THROW(InjectivityCost::Create(kTet, kSize, 0, 1), std::invalid_argument);
}

TEST(AnalyticInjectivityCost, AgreesWithAutodiffAndNumericDerivatives) {
  std::mt19937 generator(7);
  for (const double epsilon : {1., 0.1}) {
    const std::unique_ptr<ceres::CostFunction> analytic(AnalyticInjectivityCost::Create(kTet, kSize, epsilon, kWeight));
    const std::unique_ptr<ceres::CostFunction> autodiff(InjectivityCost::Create(kTet, kSize, epsilon, kWeight));
    for (int i = 0; i < 20; ++i) {
      const Eigen::Matrix3d jacobian =
          RandomFrame(&generator) * (Eigen::Matrix3d::Identity() * (i % 2 ? 1 : -1) + 0.3 * Eigen::Matrix3d::Random());
      const auto parameters = Image(jacobian, RandomVector(&generator));
      ExpectSame(*analytic, *autodiff, parameters);
      if (epsilon == 1) ExpectJacobiansAreDerivatives(*analytic, parameters, 1e-6);
      const double energy = Evaluate(*analytic, parameters).residuals.squaredNorm();
      EXPECT_NEAR(kWeight * EvaluateFoldoverEnergy(jacobian.squaredNorm(), jacobian.determinant(), epsilon).energy,
                  energy, 1e-9 * energy);
      const auto turned = Image(RandomFrame(&generator) * jacobian, RandomVector(&generator));
      EXPECT_NEAR(Evaluate(*analytic, turned).residuals.squaredNorm(), energy, 1e-9 * energy);
    }
  }
}

TEST(AnalyticInjectivityCost, IsFiniteOnFlatAndFlippedTetsAndRefusesBadInput) {
  const std::unique_ptr<ceres::CostFunction> cost(AnalyticInjectivityCost::Create(kTet, kSize, 1e-6, kWeight));
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  ExpectFinite(*cost, Image(Eigen::Matrix3d::Zero(), zero));
  ExpectFinite(*cost, Image(-Eigen::Matrix3d::Identity(), zero));
  EXPECT_THROW(AnalyticInjectivityCost::Create(kTet, kSize, 0, 1), std::invalid_argument);
  EXPECT_THROW(AnalyticInjectivityCost::Create(kTet, kSize, 1, -1), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
