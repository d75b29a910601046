#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace octupole {

/// The order of points along Morton's curve through a grid of 1024^3 cells: each near the one before, so that what is
/// found on the way is in the cache, and any piece of the order is compact.
std::vector<std::size_t> MortonOrder(const std::vector<Eigen::Vector3d>& points);

}  // namespace octupole
