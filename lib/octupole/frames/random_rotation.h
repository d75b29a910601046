#pragma once

#include <Eigen/Geometry>
#include <random>

namespace octupole {

/// A uniformly distributed rotation (Shoemake, Uniform random rotations, Graphics Gems III, 1992). The same sequence
/// for the same seed on every platform: the standard's distributions would not promise that.
Eigen::Quaterniond RandomRotation(std::mt19937* generator);

}  // namespace octupole
