#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace octupole {

// Our energies and Ceres' cost. Every residual block states its squared norm |r|^2 = weight * term, and our energies
// are sums of those terms:
//
//   E = sum over edges  weight |a - b|^2 |a + b|^2                          (degree 4: weight |a - b|^2)
//     + sum over vertices  w1 (|a|^2 - 1)^2 + w2 d(a)                       (paper, eq. 5.1).
//
// Ceres minimises half the squared norm, so E = 2 * cost: `summary.final_cost` is half our energy, and the gradient
// that ceres::Problem::Evaluate returns is half of E's.

/// The factor sqrt(weight) that a residual block applies for its squared norm to carry `weight`.
/// \throw std::invalid_argument, naming `caller`, when `weight` is negative or not finite.
inline double RootOfWeight(const char* caller, double weight) {
  // Written so that a NaN fails, too.
  if (weight >= 0 && std::isfinite(weight)) return std::sqrt(weight);
  std::ostringstream message;
  message << caller << ": the weight must be finite and not negative, not " << weight;
  throw std::invalid_argument(message.str());
}

}  // namespace octupole
