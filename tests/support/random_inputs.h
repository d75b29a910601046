#pragma once

#include <Eigen/Core>
#include <random>

#include "octupole/frames/random_rotation.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

// Random inputs from a seeded generator.

inline Eigen::Matrix3d RandomFrame(std::mt19937* generator) { return RandomRotation(generator).toRotationMatrix(); }

template <int kDegree>
Harmonic<kDegree> RandomHarmonic(std::mt19937* generator) {
  std::normal_distribution<double> normal;
  return Harmonic<kDegree>::NullaryExpr([&] { return normal(*generator); });
}

inline Eigen::Vector3d RandomDirection(std::mt19937* generator) { return RandomFrame(generator).col(0); }

}  // namespace octupole
