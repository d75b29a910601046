#pragma once

#include <array>
#include <cstddef>

#include "octupole/harmonics/harmonics.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/minimization/internal/simd.h"

namespace octupole::internal {

/// The coefficients at one vertex, padded to full vectors. In degree 3 the padding holds their squared norm, which
/// every edge of the sweep needs.
template <int kDegree, typename Scalar>
struct alignas(kDegree == 3 ? 8 * sizeof(Scalar) : 256 / sizeof(Scalar)) HarmonicRow {
  static constexpr int kNumLanes = (kDimension<kDegree> + kLanes<Scalar> - 1) / kLanes<Scalar>;

  void Set(const Harmonic<kDegree>& h) {
    for (int i = 0; i < kDimension<kDegree>; ++i) values[i] = static_cast<Scalar>(h[i]);
    if (kDegree == 3) values[kDimension<kDegree>] = static_cast<Scalar>(h.squaredNorm());
  }

  Scalar values[kLanes<Scalar> * kNumLanes] = {};
};

/// The columns of the entries, at most two, in row `row` of a matrix that takes order m to orders of magnitude
/// |m| +- shift, from cosines (m >= 0) to sines (m < 0) and back if it swaps; -1 for none.
template <int kDegree>
constexpr std::array<int, 2> ColumnsOf(int row, int shift, bool swaps) {
  const int m = row - kDegree;
  const int magnitude = m < 0 ? -m : m;
  const bool is_sine = (m < 0) != swaps;
  std::array<int, 2> columns = {-1, -1};
  const int far = magnitude + shift;
  const int near = magnitude < shift ? shift - magnitude : magnitude - shift;
  if (far <= kDegree && !(is_sine && far == 0)) columns[0] = kDegree + (is_sine ? -far : far);
  if (near != far && !(is_sine && near == 0)) columns[1] = kDegree + (is_sine ? -near : near);
  return columns;
}

/// A sparse matrix on harmonics of that pattern, known when compiled: generators of rotations and quadrics are such.
template <int kDegree, typename Scalar, int kShift, bool kSwaps>
class OrderMatrix {
 public:
  /// \throw std::logic_error when `matrix` has another pattern.
  explicit OrderMatrix(const HarmonicMatrix<kDegree>& matrix);

  /// result = the matrix times h, for many harmonics at once, one per lane.
  OCTUPOLE_INLINE void Apply(const Lanes<Scalar>* h, Lanes<Scalar>* result) const {
#pragma GCC unroll 9
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      const std::array<int, 2> columns = ColumnsOf<kDegree>(i, kShift, kSwaps);
      result[i] = Lanes<Scalar>{};
      if (columns[0] >= 0) result[i] += entries_[i][0] * h[columns[0]];
      if (columns[1] >= 0) result[i] += entries_[i][1] * h[columns[1]];
    }
  }

 private:
  std::array<std::array<Scalar, 2>, kDimension<kDegree>> entries_ = {};
};

/// The generators of rotations (rotation.h) and the quadrics (quadrics.h).
template <int kDegree, typename Scalar>
struct SparseMatrices {
  static const SparseMatrices& Instance();

  template <int kShift, bool kSwaps>
  using Matrix = OrderMatrix<kDegree, Scalar, kShift, kSwaps>;

  Matrix<1, true> generator_x;
  Matrix<1, false> generator_y;
  Matrix<0, true> generator_z;
  Matrix<0, false> quadric_1;
  Matrix<1, true> quadric_2;
  Matrix<1, false> quadric_3;
  Matrix<2, true> quadric_4;
  Matrix<2, false> quadric_5;
};

}  // namespace octupole::internal
