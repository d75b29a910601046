#pragma once

#include <ceres/autodiff_cost_function.h>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/frames/octahedral_group.h"

namespace octupole {

/// Draws a map to be seamless at a vertex of a face, for callers that penalise what SolveSeamlessMap eliminates:
///
///   r = sqrt(weight) (u_t - g^T u_s - shift),   |r|^2 = weight * squared distance,
///
/// with the match g from s to t, F_s g ~ F_t (combed_frames.h). Parameters: u_s, u_t, and the shift, one for each patch
/// of the cut (3 each). Residuals: 3. Linear.
class TransitionCost {
 public:
  TransitionCost(const OctahedralRotation& match, double weight)
      : inverse_(match.Inverse()), root_(RootOfWeight("TransitionCost", weight)) {}

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(const OctahedralRotation& match, double weight) {
    return new ceres::AutoDiffCostFunction<TransitionCost, 3, 3, 3, 3>(new TransitionCost(match, weight));
  }

  template <typename T>
  bool operator()(const T* from, const T* to, const T* shift, T* residuals) const {
    for (int k = 0; k < 3; ++k) {
      residuals[k] = root_ * (to[k] - T(inverse_.sign[k]) * from[inverse_.axis[k]] - shift[k]);
    }
    return true;
  }

 private:
  OctahedralRotation inverse_;
  double root_;
};

}  // namespace octupole
