#pragma once

#include <memory>

#include "octupole/map_solvers/internal/map_energy.h"

namespace octupole::internal {

/// Solves with the Hessian of an energy again and again: by a sparse Cholesky factor where that is small, by conjugate
/// gradients otherwise (docs/maps.md says where each of them wins).
class HessianSolver {
 public:
  explicit HessianSolver(MapEnergy* energy);
  ~HessianSolver();

  /// With the Hessian of the energy's last evaluation, for x; conjugate gradients begin at 0 and end as
  /// SolveByConjugateGradients says.
  void Solve(const Vector& right, double tolerance, int max_iterations, Vector* x);

 private:
  struct Factor;
  MapEnergy* energy_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace octupole::internal
