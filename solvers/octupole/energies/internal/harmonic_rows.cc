#include "octupole/energies/internal/harmonic_rows.h"

#include <cmath>
#include <stdexcept>

#include "octupole/harmonics/quadrics.h"

namespace octupole::internal {

template <int kDegree, typename Scalar, int kShift, bool kSwaps>
OrderMatrix<kDegree, Scalar, kShift, kSwaps>::OrderMatrix(const HarmonicMatrix<kDegree>& matrix) {
  // Rounding leaves entries near 1e-16 where zeros belong.
  constexpr double kZero = 1e-12;
  HarmonicMatrix<kDegree> rest = matrix;
  for (int i = 0; i < kDimension<kDegree>; ++i) {
    const std::array<int, 2> columns = ColumnsOf<kDegree>(i, kShift, kSwaps);
    for (int k = 0; k < 2; ++k) {
      if (columns[k] < 0) continue;
      entries_[i][k] = static_cast<Scalar>(matrix(i, columns[k]));
      rest(i, columns[k]) = 0;
    }
  }
  if (rest.cwiseAbs().maxCoeff() > kZero) throw std::logic_error("OrderMatrix: an entry where none is expected");
}

template <int kDegree, typename Scalar>
const SparseMatrices<kDegree, Scalar>& SparseMatrices<kDegree, Scalar>::Instance() {
  const auto make = [] {
    const auto& [x, y, z] = RotationGenerators<kDegree>();
    const auto& quadrics = Quadrics<kDegree>();
    return SparseMatrices{Matrix<1, true>(x),           Matrix<1, false>(y),
                          Matrix<0, true>(z),           Matrix<0, false>(quadrics[0]),
                          Matrix<1, true>(quadrics[1]), Matrix<1, false>(quadrics[2]),
                          Matrix<2, true>(quadrics[3]), Matrix<2, false>(quadrics[4])};
  };
  static const SparseMatrices matrices = make();
  return matrices;
}

template struct SparseMatrices<3, float>;
template struct SparseMatrices<3, double>;
template struct SparseMatrices<4, float>;
template struct SparseMatrices<4, double>;

}  // namespace octupole::internal
