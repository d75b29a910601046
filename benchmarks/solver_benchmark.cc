// Ceres' solvers on one field energy: where one preset overtakes another, for ChooseSolverPreset. A ball with an
// aligned boundary, from one random start; the energies reached stand beside the times.
#include <benchmark/benchmark.h>

#include <string>

#include "ball_mesh.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {
namespace {

void Solve(benchmark::State& state, SolverPreset preset) {
  const TetMesh mesh = MakeBallMesh(static_cast<int>(state.range(0)));
  FieldOptions<3> options;
  options.solver = MakeSolverOptions(preset);
  for (auto _ : state) {
    const Field<3> field = SolveField<3>(mesh, options);
    state.counters["vertices"] = static_cast<double>(mesh.points.size());
    state.counters["iterations"] = field.iterations.back().iteration;
    state.counters["energy"] = field.energy;
    state.counters["converged"] = field.termination == ceres::CONVERGENCE;
  }
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  using octupole::SolverPreset;
  for (const int cells : {5, 6, 8, 10, 12, 16, 22}) {
    for (const auto& [name, preset, max_cells] :
         {std::tuple("cholesky", SolverPreset::kSparseCholesky, 12),
          std::tuple("cgnr", SolverPreset::kConjugateGradients, 16), std::tuple("lbfgs", SolverPreset::kLbfgs, 22)}) {
      // Beyond these sizes a run takes minutes.
      if (cells > max_cells) continue;
      benchmark::RegisterBenchmark(name, octupole::Solve, preset)
          ->Arg(cells)
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
