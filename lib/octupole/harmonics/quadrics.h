#pragma once

#include <array>

#include "octupole/harmonics/harmonics.h"
#include "octupole/harmonics/rotation.h"

namespace octupole {

/// The five quadratic forms N_1 .. N_5 whose common zeros on the unit sphere are the octahedral harmonics (theory.md,
/// sections 1 and 2; in degree 4 up to the sign of h).
///
/// They are the five real degree-2 harmonics of the vector of generators G, hence rotate among themselves and are
/// mutually orthogonal in the Frobenius product, with equal norms (84 squared in degree 3). In order:
/// N_1 = (3 G_z^2 - G^2)/3 = diag((l(l+1) - 3 m^2)/3), then those of yz and xz, then the pair of xy and x^2 - y^2 that
/// the paper omits (theory.md, errata 1).
template <int kDegree>
const std::array<HarmonicMatrix<kDegree>, 5>& Quadrics();

/// The paper's M_1, M_2, M_3 (eqs. 2.2 to 2.4): three of the five, the last two times sqrt(2) and in another order.
/// Their common zeros on the unit sphere are not all octahedral; an example is sqrt(5/8) Y_{3,1} - sqrt(3/8) Y_{3,3}.
std::array<HarmonicMatrix<3>, 3> PaperQuadrics();

/// The five values h^T N_k h. Their squared norm is the deviation d(h). The scalar may be a ceres::Jet.
template <int kDegree, typename T>
Eigen::Matrix<T, 5, 1> QuadricValues(const Eigen::Matrix<T, kDimension<kDegree>, 1>& h) {
  const auto& quadrics = Quadrics<kDegree>();
  Eigen::Matrix<T, 5, 1> values;
  for (int k = 0; k < 5; ++k) {
    values[k] = T(0);
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      for (int j = 0; j <= i; ++j) {
        // Most entries are zero, and a Jet multiplication is dear.
        const double entry = (i == j ? 1 : 2) * quadrics[k](i, j);
        if (entry != 0) values[k] += entry * (h[i] * h[j]);
      }
    }
  }
  return values;
}

/// d(h) = sum over k of (h^T N_k h)^2: zero exactly on the multiples of octahedral harmonics, homogeneous of degree 4,
/// invariant under rotations (paper, eq. 3.1; theory.md, section 2).
template <int kDegree>
double Deviation(const Harmonic<kDegree>& h) {
  return QuadricValues<kDegree, double>(h).squaredNorm();
}

}  // namespace octupole
