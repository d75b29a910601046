#include "octupole/solvers/internal/harmonic_rows.h"

#include <cmath>

#include "octupole/harmonics/rotation.h"

namespace octupole::internal {

template <int kDegree>
SparseGenerators<kDegree>::SparseGenerators() {
  // Rounding leaves entries near 1e-16 where zeros belong.
  constexpr double kZero = 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    const HarmonicMatrix<kDegree>& generator = RotationGenerators<kDegree>()[axis];
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      int num_entries = 0;
      for (int j = 0; j < kDimension<kDegree>; ++j) {
        if (std::abs(generator(i, j)) < kZero) continue;
        rows_[axis][i].columns.at(num_entries) = j;
        rows_[axis][i].entries.at(num_entries) = generator(i, j);
        ++num_entries;
      }
    }
  }
}

template <int kDegree>
const SparseGenerators<kDegree>& SparseGenerators<kDegree>::Instance() {
  static const SparseGenerators generators;
  return generators;
}

template class SparseGenerators<3>;
template class SparseGenerators<4>;

}  // namespace octupole::internal
