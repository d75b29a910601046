#pragma once

#include <ceres/manifold.h>

#include "octupole/alignment/alignment.h"

namespace octupole {

/// The affine subspace offset + span(U) of an alignment as a manifold, for hard alignment (theory.md, section 4):
///
///   Plus(x, delta) = x + U delta,   Minus(y, x) = U^T (y - x).
///
/// Ambient size kDimension; tangent size 2 for an axis, 1 for a frame, kDimension for a free vertex. Plus keeps a point
/// of the subspace in it and does not move a point onto it: start from AlignedSubspace::Project. In degree 3 a frame's
/// line also holds zero and the opposite sign; to prescribe the frame itself, set the block constant.
template <int kDegree>
class AlignmentManifold final : public ceres::Manifold {
 public:
  explicit AlignmentManifold(const Alignment& alignment) : basis_(AlignedSubspace<kDegree>(alignment).basis) {}

  int AmbientSize() const override { return kDimension<kDegree>; }
  int TangentSize() const override { return static_cast<int>(basis_.cols()); }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;

 private:
  typename AlignedSubspace<kDegree>::Basis basis_;
};

}  // namespace octupole
