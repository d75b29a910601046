#include "octupole/mesh/morton_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace octupole {
namespace {

TEST(MortonOrder, WalksThroughOneOctantAfterTheOther) {
  // The corners of 4^3 cells, in the order of a grid.
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) points.emplace_back(i, 5 + j, 7 + k);
    }
  }
  const std::vector<std::size_t> order = MortonOrder(points);
  std::vector<std::size_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
  const auto octant = [&](std::size_t i) {
    const Eigen::Vector3d& p = points[order[i]];
    return Eigen::Vector3i(p[0] >= 2, p[1] >= 7, p[2] >= 9);
  };
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(octant(i), octant(i / 8 * 8)) << i;
}

TEST(MortonOrder, TakesAnyPoints) {
  EXPECT_TRUE(MortonOrder({}).empty());
  EXPECT_EQ(MortonOrder({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), (std::vector<std::size_t>{0, 1, 2}));
}

}  // namespace
}  // namespace octupole
