#pragma once

#include <functional>
#include <vector>

#include "octupole/minimization/lbfgs.h"
#include "octupole/minimization/workers.h"

namespace octupole::internal {

/// Sets the cost at x and its gradient; false where it cannot be evaluated.
template <typename Scalar>
using SmoothFunction = std::function<bool(const Scalar* x, double* cost, Scalar* gradient)>;

/// The public MinimizeLbfgs (lbfgs.h) in floats or doubles.
template <typename Scalar>
LbfgsSummary MinimizeLbfgs(const SmoothFunction<Scalar>& function, const LbfgsOptions& options, Workers* workers,
                           std::vector<Scalar>* x);

}  // namespace octupole::internal
