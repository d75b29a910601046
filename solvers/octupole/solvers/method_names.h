#pragma once

#include <optional>
#include <string>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/field/field_graph.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {

// The names by which the command and other languages call methods, solvers and options.
// \throw std::invalid_argument, each, naming what is expected in place of an unknown name.

/// "penalty", "ray-sokolov", "huang" or "mbo".
FieldMethod FieldMethodOf(const std::string& name);
std::string NameOf(FieldMethod method);

/// "cholesky", "cgnr" or "lbfgs" of Ceres, or nothing for "fast": SolveFast.
std::optional<SolverPreset> SolverPresetOf(const std::string& name);

/// "aligned" or "free".
OpenBoundary OpenBoundaryOf(const std::string& name);

/// "uniform" or "fem".
EdgeWeights EdgeWeightsOf(const std::string& name);

}  // namespace octupole
