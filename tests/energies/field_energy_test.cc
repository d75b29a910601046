#include "octupole/energies/field_energy.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "any_graph.h"
#include "gradient_check.h"

namespace octupole {
namespace {

template <typename Degree>
class FieldEnergyTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(FieldEnergyTest, Degrees);

TYPED_TEST(FieldEnergyTest, IsTheCostOfTheCeresProblemWithItsGradient) {
  constexpr int l = TypeParam::value;
  for (const bool is_weighted : {false, true}) {
    const FieldGraph graph = AnyGraph({4, 3, 2}, /*num_isolated=*/1, is_weighted);
    const EnergyWeights weights = {3, 0.7};
    Workers workers(1);
    const FieldEnergy<l> energy(graph, weights, &workers);
    const std::vector<double> x = AnyParameters(energy.NumParameters());
    double cost = 0;
    std::vector<double> gradient(x.size(), std::numeric_limits<double>::quiet_NaN());
    ASSERT_TRUE(energy.Evaluate(x.data(), &cost, gradient.data()));

    std::vector<Harmonic<l>> field = energy.FieldOf(x);
    ceres::Problem problem;
    BuildFieldProblem<l>(graph, weights, &field, &problem);
    ceres::Problem::EvaluateOptions options;
    for (Harmonic<l>& h : field) {
      if (!problem.IsParameterBlockConstant(h.data())) options.parameter_blocks.push_back(h.data());
    }
    double expected_cost = 0;
    std::vector<double> expected_gradient;
    ASSERT_TRUE(problem.Evaluate(options, &expected_cost, nullptr, &expected_gradient, nullptr));
    EXPECT_NEAR(cost, expected_cost, 1e-12 * expected_cost);
    ASSERT_EQ(gradient.size(), expected_gradient.size());
    for (std::size_t i = 0; i < gradient.size(); ++i) ASSERT_NEAR(gradient[i], expected_gradient[i], 1e-10) << i;

    double cost_alone = 0;
    ASSERT_TRUE(energy.Evaluate(x.data(), &cost_alone, nullptr));
    EXPECT_EQ(cost_alone, cost);
  }
}

TYPED_TEST(FieldEnergyTest, HasTheNumericGradient) {
  constexpr int l = TypeParam::value;
  Workers workers(1);
  const FieldEnergy<l> energy(AnyGraph({4, 3, 2}, /*num_isolated=*/1, true), {}, &workers);
  ExpectNumericGradient(energy, AnyParameters(energy.NumParameters()), 1e-5, 1e-5);
}

TYPED_TEST(FieldEnergyTest, IsFiniteAtZero) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = AnyGraph({4, 3, 2}, /*num_isolated=*/1, false);
  Workers workers(1);
  const FieldEnergy<l> energy(graph, {}, &workers);
  const std::vector<double> x(energy.NumParameters(), 0);
  double cost = 0;
  std::vector<double> gradient(x.size());
  ASSERT_TRUE(energy.Evaluate(x.data(), &cost, gradient.data()));
  EXPECT_TRUE(std::isfinite(cost));
  EXPECT_TRUE(std::all_of(gradient.begin(), gradient.end(), [](double value) { return std::isfinite(value); }));
}

TYPED_TEST(FieldEnergyTest, TakesAFieldApartAndPutsItTogether) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = AnyGraph({4, 3, 2}, /*num_isolated=*/1, false);
  Workers workers(1);
  const FieldEnergy<l> energy(graph, {}, &workers);
  const std::vector<Harmonic<l>> field = RandomField<l>(graph, 1);
  const std::vector<Harmonic<l>> again = energy.FieldOf(energy.ParametersOf(field));
  ASSERT_EQ(again.size(), field.size());
  for (std::size_t v = 0; v < field.size(); ++v) EXPECT_LT((again[v] - field[v]).norm(), 1e-12) << v;
}

TYPED_TEST(FieldEnergyTest, DoesNotDependOnTheNumberOfThreads) {
  constexpr int l = TypeParam::value;
  const TetMesh mesh = MakeBoxMesh({20, 20, 20}, {1, 1, 1});
  const FieldGraph graph = MakeFieldGraph(mesh, std::vector<Alignment>(mesh.points.size()));
  const auto evaluate = [&](int num_threads) {
    Workers workers(num_threads);
    const FieldEnergy<l> energy(graph, {}, &workers);
    const std::vector<double> x = AnyParameters(energy.NumParameters());
    std::vector<double> result(1 + x.size());
    energy.Evaluate(x.data(), &result[0], &result[1]);
    return result;
  };
  const std::vector<double> expected = evaluate(1);
  EXPECT_EQ(evaluate(2), expected);
  EXPECT_EQ(evaluate(3), expected);
}

TYPED_TEST(FieldEnergyTest, SuitsCeresGradientProblem) {
  constexpr int l = TypeParam::value;
  const FieldGraph graph = AnyGraph({4, 3, 2}, /*num_isolated=*/1, false);
  Workers workers(1);
  auto* energy = new FieldEnergy<l>(graph, {}, &workers);
  std::vector<double> x = energy->ParametersOf(RandomField<l>(graph, 1));
  const ceres::GradientProblem problem(energy);
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 500;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, x.data(), &summary);
  EXPECT_EQ(summary.termination_type, ceres::CONVERGENCE) << summary.message;
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(FieldEnergy, RefusesBadInput) {
  Workers workers(1);
  EXPECT_THROW(FieldEnergy<3>({{{0, 2, 1}}, std::vector<Alignment>(2)}, {}, &workers), std::invalid_argument);
  EXPECT_THROW(FieldEnergy<3>(AnyGraph({4, 3, 2}, /*num_isolated=*/1, false), {-1, 0}, &workers),
               std::invalid_argument);
  EXPECT_THROW(FieldEnergy<3>(AnyGraph({4, 3, 2}, /*num_isolated=*/1, false),
                              {1, std::numeric_limits<double>::quiet_NaN()}, &workers),
               std::invalid_argument);
  const FieldEnergy<3> energy(AnyGraph({4, 3, 2}, /*num_isolated=*/1, false), {}, &workers);
  EXPECT_THROW(energy.ParametersOf({}), std::invalid_argument);
  EXPECT_THROW(energy.FieldOf({}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
