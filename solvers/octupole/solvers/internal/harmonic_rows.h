#pragma once

#include <array>
#include <cstddef>

#include "octupole/harmonics/harmonics.h"
#include "octupole/solvers/internal/simd.h"

namespace octupole::internal {

/// The coefficients at one vertex, padded to full vectors of four. In degree 3 the padding holds their squared norm,
/// which every edge of the sweep needs.
template <int kDegree>
struct alignas(kDegree == 3 ? 64 : 32) HarmonicRow {
  static constexpr int kNumLanes = (kDimension<kDegree> + 3) / 4;

  void Set(const Harmonic<kDegree>& h) {
    for (int i = 0; i < kDimension<kDegree>; ++i) values[i] = h[i];
    if (kDegree == 3) values[kDimension<kDegree>] = h.squaredNorm();
  }

  double values[4 * kNumLanes] = {};
};

/// The generators of rotations (rotation.h) as sparse matrices: in the real basis a row has at most two entries.
template <int kDegree>
class SparseGenerators {
 public:
  static const SparseGenerators& Instance();

  /// result = G_axis h for four harmonics at once, one per lane.
  OCTUPOLE_INLINE void Apply(int axis, const Lanes* h, Lanes* result) const {
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      const Row& row = rows_[axis][i];
      result[i] = row.entries[0] * h[row.columns[0]] + row.entries[1] * h[row.columns[1]];
    }
  }

  /// torque_axis = gradient . G_axis h: the derivatives of a function of h by turns about the coordinate axes.
  OCTUPOLE_INLINE void Torque(const double* h, const double* gradient, double* torque) const {
    for (int axis = 0; axis < 3; ++axis) {
      torque[axis] = 0;
      for (int i = 0; i < kDimension<kDegree>; ++i) {
        const Row& row = rows_[axis][i];
        torque[axis] += gradient[i] * (row.entries[0] * h[row.columns[0]] + row.entries[1] * h[row.columns[1]]);
      }
    }
  }

 private:
  SparseGenerators();

  struct Row {
    std::array<int, 2> columns = {0, 0};
    std::array<double, 2> entries = {0, 0};
  };
  std::array<std::array<Row, kDimension<kDegree>>, 3> rows_;
};

}  // namespace octupole::internal
