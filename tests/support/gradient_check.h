#pragma once

#include <ceres/first_order_function.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace octupole {

/// That the gradient at x is that of central differences of this step, each entry to `tolerance` times one more than
/// its size.
inline void ExpectNumericGradient(const ceres::FirstOrderFunction& function, std::vector<double> x, double step,
                                  double tolerance) {
  double cost = 0;
  std::vector<double> gradient(x.size());
  ASSERT_TRUE(function.Evaluate(x.data(), &cost, gradient.data()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double value = x[i];
    double above = 0, below = 0;
    x[i] = value + step;
    function.Evaluate(x.data(), &above, nullptr);
    x[i] = value - step;
    function.Evaluate(x.data(), &below, nullptr);
    x[i] = value;
    ASSERT_NEAR(gradient[i], (above - below) / (2 * step), tolerance * (1 + std::abs(gradient[i]))) << i;
  }
}

}  // namespace octupole
