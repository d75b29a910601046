#include "octupole/minimization/lbfgs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace octupole {
namespace {

// A function with its gradient, from a lambda.
class Function final : public ceres::FirstOrderFunction {
 public:
  using Evaluation = std::function<double(const double* x, double* gradient)>;

  Function(int num_parameters, Evaluation evaluation)
      : num_parameters_(num_parameters), evaluation_(std::move(evaluation)) {}
  bool Evaluate(const double* x, double* cost, double* gradient) const override {
    *cost = evaluation_(x, gradient);
    return true;
  }
  int NumParameters() const override { return num_parameters_; }

 private:
  int num_parameters_;
  Evaluation evaluation_;
};

// The sum of scale_i (x_i - i)^2, the scales from 1 to 1000.
Function Paraboloid(int size) {
  return {size, [size](const double* x, double* gradient) {
            double cost = 0;
            for (int i = 0; i < size; ++i) {
              const double scale = std::pow(1000., i / (size - 1.));
              cost += scale * (x[i] - i) * (x[i] - i);
              gradient[i] = 2 * scale * (x[i] - i);
            }
            return cost;
          }};
}

// Sizes around those of the blocks that the history is stored in.
TEST(MinimizeLbfgs, FindsTheMinimumOfAParaboloidOfAnySize) {
  Workers workers(2);
  for (const int size : {2, 511, 512, 513, 9000}) {
    std::vector<double> x(size, 0);
    LbfgsOptions options;
    options.function_tolerance = 1e-14;
    const LbfgsSummary summary = MinimizeLbfgs(Paraboloid(size), options, &workers, &x);
    EXPECT_EQ(summary.termination, ceres::CONVERGENCE);
    EXPECT_LT(summary.num_evaluations, 1.3 * summary.num_iterations + 10);
    EXPECT_LT(summary.final_cost, 1e-9 * summary.initial_cost);
    for (int i = 0; i < size; ++i) ASSERT_NEAR(x[i], i, 1e-3 * (1 + i)) << size;
  }
}

TEST(MinimizeLbfgs, FollowsTheValleyOfRosenbrock) {
  const Function rosenbrock(2, [](const double* x, double* gradient) {
    const double a = x[1] - x[0] * x[0], b = 1 - x[0];
    gradient[0] = -400 * a * x[0] - 2 * b;
    gradient[1] = 200 * a;
    return 100 * a * a + b * b;
  });
  Workers workers(1);
  std::vector<double> x = {-1.2, 1};
  LbfgsOptions options;
  options.function_tolerance = 1e-12;
  const LbfgsSummary summary = MinimizeLbfgs(rosenbrock, options, &workers, &x);
  EXPECT_EQ(summary.termination, ceres::CONVERGENCE);
  EXPECT_LT(summary.num_iterations, 200);
  EXPECT_NEAR(x[0], 1, 1e-5);
  EXPECT_NEAR(x[1], 1, 1e-5);
}

TEST(MinimizeLbfgs, EndsAtOnceWhereTheGradientVanishes) {
  Workers workers(1);
  std::vector<double> x = {0, 1, 2};
  const LbfgsSummary summary = MinimizeLbfgs(Paraboloid(3), {}, &workers, &x);
  EXPECT_EQ(summary.termination, ceres::CONVERGENCE);
  EXPECT_EQ(summary.num_iterations, 0);
  EXPECT_EQ(summary.num_evaluations, 1);
}

TEST(MinimizeLbfgs, TakesAFunctionWithoutParameters) {
  Workers workers(1);
  std::vector<double> x;
  const LbfgsSummary summary = MinimizeLbfgs(Function(0, [](const double*, double*) { return 3.; }), {}, &workers, &x);
  EXPECT_EQ(summary.termination, ceres::CONVERGENCE);
  EXPECT_EQ(summary.final_cost, 3);
}

TEST(MinimizeLbfgs, StopsAtTheMaximumOfIterations) {
  Workers workers(1);
  std::vector<double> x(100, 0);
  LbfgsOptions options;
  options.max_iterations = 4;
  const LbfgsSummary summary = MinimizeLbfgs(Paraboloid(100), options, &workers, &x);
  EXPECT_EQ(summary.termination, ceres::NO_CONVERGENCE);
  EXPECT_EQ(summary.num_iterations, 4);
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

TEST(MinimizeLbfgs, ObeysItsCallback) {
  class Stop : public ceres::IterationCallback {
   public:
    explicit Stop(ceres::CallbackReturnType answer) : answer_(answer) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
      EXPECT_GT(summary.cost_change, 0);
      EXPECT_EQ(summary.iteration, ++num_calls_);
      return summary.iteration == 3 ? answer_ : ceres::SOLVER_CONTINUE;
    }

   private:
    ceres::CallbackReturnType answer_;
    int num_calls_ = 0;
  };
  Workers workers(1);
  for (const auto& [answer, termination] : {std::pair(ceres::SOLVER_TERMINATE_SUCCESSFULLY, ceres::USER_SUCCESS),
                                            std::pair(ceres::SOLVER_ABORT, ceres::USER_FAILURE)}) {
    Stop stop(answer);
    LbfgsOptions options;
    options.callback = &stop;
    std::vector<double> x(100, 0);
    const LbfgsSummary summary = MinimizeLbfgs(Paraboloid(100), options, &workers, &x);
    EXPECT_EQ(summary.termination, termination);
    EXPECT_EQ(summary.num_iterations, 3);
  }
}

TEST(MinimizeLbfgs, StepsBackFromWhereTheFunctionIsNotFinite) {
  // x - log x.
  const Function function(1, [](const double* x, double* gradient) {
    gradient[0] = 1 - 1 / x[0];
    return x[0] > 0 ? x[0] - std::log(x[0]) : std::numeric_limits<double>::quiet_NaN();
  });
  Workers workers(1);
  std::vector<double> x = {5};
  LbfgsOptions options;
  options.first_step = 100;
  options.function_tolerance = 1e-14;
  const LbfgsSummary summary = MinimizeLbfgs(function, options, &workers, &x);
  EXPECT_EQ(summary.termination, ceres::CONVERGENCE);
  EXPECT_NEAR(x[0], 1, 1e-5);
  x = {-1};
  EXPECT_EQ(MinimizeLbfgs(function, options, &workers, &x).termination, ceres::FAILURE);
  EXPECT_EQ(x[0], -1);
}

}  // namespace
}  // namespace octupole
