#pragma once

#include <functional>

#include "octupole/map_solvers/internal/map_energy.h"

namespace octupole::internal {

/// A determinant that is no larger counts as flat: so small a part of what it should be.
inline constexpr double kLeastDeterminant = 1e-6;

struct UntangleOptions {
  int max_iterations;
  /// After every iteration, with the energy before and after it and the gradient before; false ends.
  std::function<bool(double before, double after, const Vector& gradient)> goes_on;
};

/// Newton's method on the foldover-free energy of a part of a map, from x, until no tetrahedron is turned over, the
/// iterations are spent or no step helps. Adds the number of iterations to *num_iterations.
void Untangle(const UntangleOptions& options, MapEnergy* energy, Vector* x, int* num_iterations);

}  // namespace octupole::internal
