#include "octupole/mesh/morton_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace octupole {

std::vector<std::size_t> MortonOrder(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;  // of halves, whose differences are finite
  for (const Eigen::Vector3d& point : points) box.extend(point / 2);
  const double extent = points.empty() ? 0 : box.sizes().maxCoeff();
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (extent == 0) return order;
  constexpr int kBits = 10;
  std::vector<std::pair<std::uint32_t, std::size_t>> codes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d place = (points[i] / 2 - box.min()) / extent;
    const Eigen::Vector3i cell = (((1 << kBits) - 1) * place).cast<int>();
    std::uint32_t code = 0;
    for (int bit = kBits - 1; bit >= 0; --bit) {
      for (int k = 0; k < 3; ++k) code = code << 1 | (cell[k] >> bit & 1);
    }
    codes[i] = {code, i};
  }
  std::sort(codes.begin(), codes.end());
  std::transform(codes.begin(), codes.end(), order.begin(), [](const auto& code) { return code.second; });
  return order;
}

}  // namespace octupole
