#pragma once

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "octupole/cost_functions/cost_weight.h"

namespace octupole {

/// The gradients of the four corners' hat functions in a tetrahedron, times `size`, one per row: the Jacobian of a map
/// with the corners' parameters as columns of U is J = U * rows, 1 where lengths are `size` to a unit.
/// \throw std::invalid_argument when the tetrahedron is flat or `size` is not above 0.
inline Eigen::Matrix<double, 4, 3> HatGradients(const std::array<Eigen::Vector3d, 4>& corners, double size) {
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = corners[i + 1] - corners[0];
  const double volume = edges.determinant();
  if (volume == 0 || !std::isfinite(volume) || !(size > 0) || !std::isfinite(size)) {
    std::ostringstream message;
    message << "HatGradients: a tetrahedron of the volume " << volume / 6 << ", a size of " << size;
    throw std::invalid_argument(message.str());
  }
  Eigen::Matrix<double, 4, 3> rows;
  rows.bottomRows<3>() = size * edges.inverse();
  rows.row(0) = -rows.bottomRows<3>().colwise().sum();
  return rows;
}

/// Draws the gradients of a map on a tetrahedron to its frame:
///
///   r = sqrt(weight) (H grad u - F^T),   |r|^2 = weight * |J - F^T|^2.
///
/// Parameters: the four corners' parameters (3 each). Residuals: 9, the rows of J - F^T one after the other: what the
/// gradient of each parameter, times H, is off the axis of its column. Linear. The weight is the tetrahedron's volume
/// in the least squares of SolveSeamlessMap.
class MapGradientCost {
 public:
  MapGradientCost(const std::array<Eigen::Vector3d, 4>& corners, const Eigen::Matrix3d& frame, double size,
                  double weight)
      : gradients_(HatGradients(corners, size)), frame_(frame), root_(RootOfWeight("MapGradientCost", weight)) {}

  /// \throw std::invalid_argument as HatGradients, or when `weight` is negative or not finite.
  static ceres::CostFunction* Create(const std::array<Eigen::Vector3d, 4>& corners, const Eigen::Matrix3d& frame,
                                     double size, double weight) {
    return new ceres::AutoDiffCostFunction<MapGradientCost, 9, 3, 3, 3, 3>(
        new MapGradientCost(corners, frame, size, weight));
  }

  template <typename T>
  bool operator()(const T* a, const T* b, const T* c, const T* d, T* residuals) const {
    const T* const corners[] = {a, b, c, d};
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        T entry = T(-frame_(l, k));
        for (int i = 0; i < 4; ++i) entry += gradients_(i, l) * corners[i][k];
        residuals[3 * k + l] = root_ * entry;
      }
    }
    return true;
  }

 private:
  Eigen::Matrix<double, 4, 3> gradients_;
  Eigen::Matrix3d frame_;
  double root_;
};

}  // namespace octupole
