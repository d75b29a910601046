#pragma once

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/cost_functions/map_gradient_cost.h"
#include "octupole/maps/foldover_energy.h"

namespace octupole {

/// \throw std::invalid_argument naming the class unless epsilon is above 0 and finite.
inline double PositiveEpsilon(const char* cost, double epsilon) {
  if (epsilon > 0 && std::isfinite(epsilon)) return epsilon;
  std::ostringstream message;
  message << cost << ": epsilon must be above 0 and finite, not " << epsilon;
  throw std::invalid_argument(message.str());
}

/// Keeps a map from turning a tetrahedron over, and turns it back if it does: the regularised foldover-free energy of
/// Garanzha and others (foldover_energy.h) as least squares,
///
///   r = sqrt(weight) (J / chi^(1/3), det J / chi^(1/2), 1 / chi^(1/2)),
///   |r|^2 = weight (|J|^2 / chi^(2/3) + (det^2 + 1) / chi),   chi = (det + sqrt(epsilon^2 + det^2)) / 2.
///
/// Parameters: the four corners' parameters (3 each). Residuals: 11: the nine entries of J = H grad u by rows, then the
/// two of the volume. Finite for every epsilon > 0, turned over or flat; at rotations it is least as epsilon goes to 0,
/// 5 times the weight. Callers lower epsilon from solve to solve, by NextEpsilon.
class InjectivityCost {
 public:
  InjectivityCost(const std::array<Eigen::Vector3d, 4>& corners, double size, double epsilon, double weight)
      : gradients_(HatGradients(corners, size)),
        epsilon_(PositiveEpsilon("InjectivityCost", epsilon)),
        root_(RootOfWeight("InjectivityCost", weight)) {}

  /// \throw std::invalid_argument as HatGradients, or when epsilon is not above 0 or `weight` negative or not finite.
  static ceres::CostFunction* Create(const std::array<Eigen::Vector3d, 4>& corners, double size, double epsilon,
                                     double weight) {
    return new ceres::AutoDiffCostFunction<InjectivityCost, 11, 3, 3, 3, 3>(
        new InjectivityCost(corners, size, epsilon, weight));
  }

  template <typename T>
  bool operator()(const T* a, const T* b, const T* c, const T* d, T* residuals) const {
    using std::cbrt;
    using std::sqrt;
    const T* const corners[] = {a, b, c, d};
    T j[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        j[k][l] = T(0);
        for (int i = 0; i < 4; ++i) j[k][l] += gradients_(i, l) * corners[i][k];
      }
    }
    const T det = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) +
                  j[0][1] * (j[1][2] * j[2][0] - j[1][0] * j[2][2]) + j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
    const T chi = RegularisedDeterminant(det, epsilon_);
    const T by_length = root_ / cbrt(chi), by_volume = root_ / sqrt(chi);
    for (int i = 0; i < 9; ++i) residuals[i] = by_length * j[i / 3][i % 3];
    residuals[9] = by_volume * det;
    residuals[10] = by_volume;
    return true;
  }

 private:
  Eigen::Matrix<double, 4, 3> gradients_;
  double epsilon_;
  double root_;
};

}  // namespace octupole
