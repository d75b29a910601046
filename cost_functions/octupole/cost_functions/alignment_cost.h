#pragma once

#include <ceres/autodiff_cost_function.h>

#include "octupole/alignment/alignment.h"
#include "octupole/cost_functions/cost_weight.h"
#include "octupole/harmonics/rotation.h"

namespace octupole {

/// Draws a harmonic to the subspace offset + span(U) that an alignment allows (soft alignment; theory.md, section 4):
///
///   r = sqrt(weight) (I - U U^T) (a - offset),   |r|^2 = weight * squared distance to the subspace.
///
/// Parameters: a (kDimension). Residuals: kDimension, the vector from the nearest allowed point to a. Linear. For hard
/// alignment use AlignmentManifold.
template <int kDegree>
class AlignmentCost {
 public:
  AlignmentCost(const Alignment& alignment, double weight) {
    const double root = RootOfWeight("AlignmentCost", weight);
    const AlignedSubspace<kDegree> subspace(alignment);
    matrix_ = root * (HarmonicMatrix<kDegree>::Identity() - subspace.basis * subspace.basis.transpose());
    // The offset is orthogonal to the basis.
    offset_ = root * subspace.offset;
  }

  /// \throw std::invalid_argument when `weight` is negative or not finite.
  static ceres::CostFunction* Create(const Alignment& alignment, double weight) {
    return new ceres::AutoDiffCostFunction<AlignmentCost, kDimension<kDegree>, kDimension<kDegree>>(
        new AlignmentCost(alignment, weight));
  }

  template <typename T>
  bool operator()(const T* a, T* residuals) const {
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      residuals[i] = T(-offset_[i]);
      for (int j = 0; j < kDimension<kDegree>; ++j) residuals[i] += matrix_(i, j) * a[j];
    }
    return true;
  }

 private:
  HarmonicMatrix<kDegree> matrix_;
  Harmonic<kDegree> offset_;
};

}  // namespace octupole
