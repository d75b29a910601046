#include "octupole/frames/random_rotation.h"

#include <cmath>

namespace octupole {

Eigen::Quaterniond RandomRotation(std::mt19937* generator) {
  constexpr double kTurn = 2 * M_PI;
  const auto uniform = [&] { return static_cast<double>((*generator)()) / 4294967296.; };
  const double u = uniform(), s = kTurn * uniform(), t = kTurn * uniform();
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return {q * std::cos(t), p * std::sin(s), p * std::cos(s), q * std::sin(t)};
}

}  // namespace octupole
