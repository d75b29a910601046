#pragma once

#include <cmath>

namespace octupole {

// The regularised foldover-free energy of a map with the Jacobian J, after Garanzha, Kaporin, Kudryavtseva, Protais,
// Ray and Sokolov, *Foldover-free maps in 50 lines of code* (2021):
//
//   E = |J|^2 / chi^(2/3) + (det^2 + 1) / chi,   chi = (det + sqrt(epsilon^2 + det^2)) / 2.
//
// With epsilon = 0 it is infinite where J turns the tetrahedron over, and least, 5, at rotations. With epsilon > 0 it
// is finite everywhere, and the larger the further over it is turned; epsilon is lowered as the determinants rise.

/// chi for epsilon > 0; positive also far below zero, where the formula would cancel. T may be a Jet.
template <typename T>
T RegularisedDeterminant(const T& det, double epsilon) {
  using std::sqrt;
  const T root = sqrt(det * det + epsilon * epsilon);
  return det > T(0) ? T(0.5) * (det + root) : T(0.5 * epsilon * epsilon) / (root - det);
}

/// The energy and its derivatives by the squared norm s = |J|^2 and the determinant.
struct FoldoverEnergy {
  double energy;
  /// dE/ds, dE/ddet.
  double by_norm;
  double by_det;
  /// d2E/(ds ddet), and d2E/ddet2 raised, if need be, until E is convex in (J, det), as Newton's method likes it.
  double by_norm_det;
  double by_det_det;
};

FoldoverEnergy EvaluateFoldoverEnergy(double squared_norm, double det, double epsilon);

/// The next epsilon, by the rule of that paper, from the least determinant and from the energy before and after the
/// last step, which was taken with `epsilon`.
double NextEpsilon(double epsilon, double least_det, double energy_before, double energy_after);

/// The first one.
double FirstEpsilon(double least_det);

}  // namespace octupole
