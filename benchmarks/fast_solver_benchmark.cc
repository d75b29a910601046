// The fast solver and its parts. Run it as
//
//   benchmarks/fast_solver_benchmark --benchmark_out=fast_solver.csv --benchmark_out_format=csv [MESH ...]
//
//  - sweep: one FieldEnergy::Evaluate with gradient, beside copying the memory that it must touch (the unknowns, their
//    gradient, and four bytes for each end of an edge): compare the times of sweep and copy with equal threads.
//  - growth: SolveFast on balls of 10 thousand to a million vertices; `us_per_vertex` is CPU time.
//  - MESH/...: every solver on each mesh given, with the energies of the harmonics and of the frames (energy4).
#include <benchmark/benchmark.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ball_mesh.h"
#include "octupole/alignment/aligned_frame.h"
#include "octupole/alignment/boundary_alignment.h"
#include "octupole/energies/field_energy.h"
#include "octupole/field/field_quality.h"
#include "octupole/minimization/lbfgs.h"
#include "octupole/minimization/workers.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/solvers/fast_solver.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {
namespace {

FieldGraph GraphOf(const TetMesh& mesh) { return MakeFieldGraph(mesh, AlignToBoundary(mesh).alignments); }

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// The same counters for all, 0 where they mean nothing: the CSV wants that.
struct Counters {
  double vertices = 0;
  double iterations = 0;
  double us_per_vertex = 0;
  double energy = 0;
  double energy4 = 0;

  void Set(benchmark::State* state) const {
    state->counters["vertices"] = vertices;
    state->counters["iterations"] = iterations;
    state->counters["us_per_vertex"] = us_per_vertex;
    state->counters["energy"] = energy;
    state->counters["energy4"] = energy4;
  }
};

template <int kDegree>
void Sweep(benchmark::State& state) {
  const FieldGraph graph = GraphOf(MakeBallMesh(static_cast<int>(state.range(0))));
  Workers workers(static_cast<int>(state.range(1)));
  const FieldEnergy<kDegree> energy(graph, {}, &workers);
  const std::vector<double> x = energy.ParametersOf(RandomField<kDegree>(graph, 0));
  std::vector<double> gradient(x.size());
  double cost = 0;
  for (auto _ : state) {
    energy.Evaluate(x.data(), &cost, gradient.data());
    benchmark::DoNotOptimize(cost);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(graph.num_vertices()));
  Counters{static_cast<double>(graph.num_vertices())}.Set(&state);
}

template <int kDegree>
void Copy(benchmark::State& state) {
  const FieldGraph graph = GraphOf(MakeBallMesh(static_cast<int>(state.range(0))));
  Workers workers(static_cast<int>(state.range(1)));
  const std::size_t num_unknowns = FieldEnergy<kDegree>(graph, {}, &workers).NumParameters();
  const std::size_t size = 2 * num_unknowns * sizeof(double) + 2 * graph.edges.size() * sizeof(int);
  const std::vector<char> from(size, 1);
  std::vector<char> to(size, 0);
  for (auto _ : state) {
    workers.ForEachRange(size, 1 << 20, [&](std::size_t begin, std::size_t end) {
      std::memcpy(to.data() + begin, from.data() + begin, end - begin);
    });
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
  Counters{static_cast<double>(graph.num_vertices())}.Set(&state);
}

void Growth(benchmark::State& state) {
  const FieldGraph graph = GraphOf(MakeBallMesh(static_cast<int>(state.range(0))));
  MinimizerOptions options;
  options.num_threads = static_cast<int>(state.range(1));
  for (auto _ : state) {
    const double start = CpuSeconds();
    const FieldSolution<3> field = SolveFast<3>(graph, {}, options);
    const double num_vertices = static_cast<double>(graph.num_vertices());
    Counters{num_vertices, static_cast<double>(field.iterations.size()), 1e6 * (CpuSeconds() - start) / num_vertices,
             field.energy}
        .Set(&state);
  }
}

std::vector<Eigen::Matrix3d> Project(const FieldGraph& graph, const std::vector<Octupole>& field) {
  std::vector<Eigen::Matrix3d> frames;
  for (std::size_t v = 0; v < field.size(); ++v)
    frames.push_back(NearestAlignedFrame<3>(graph.alignments[v], field[v]));
  return frames;
}

void Report(const TetMesh& mesh, double cpu_seconds, double num_iterations, double energy,
            const std::vector<Eigen::Matrix3d>& frames, benchmark::State* state) {
  const double num_vertices = static_cast<double>(mesh.points.size());
  Counters{num_vertices, num_iterations, 1e6 * cpu_seconds / num_vertices, energy, MeasureField(mesh, frames).energy4}
      .Set(state);
}

// SolveField's own roads: fast, or a preset of Ceres on residual blocks.
void Solve(benchmark::State& state, const TetMesh& mesh, std::optional<SolverPreset> preset) {
  FieldOptions<3> options;
  if (preset) options.solver = MakeSolverOptions(*preset);
  Field<3> field;
  const double start = CpuSeconds();
  for (auto _ : state) field = SolveField<3>(mesh, options);
  Report(mesh, CpuSeconds() - start, static_cast<double>(field.iterations.size()), field.energy, field.frames, &state);
}

// The whole energy as one function, from a random start on the mesh itself: our L-BFGS.
void MinimizeWhole(benchmark::State& state, const TetMesh& mesh) {
  const FieldGraph graph = GraphOf(mesh);
  Workers workers(1);
  const FieldEnergy<3> energy(graph, {}, &workers);
  std::vector<double> x;
  LbfgsSummary summary;
  const double start = CpuSeconds();
  for (auto _ : state) {
    x = energy.ParametersOf(RandomField<3>(graph, 0));
    summary = MinimizeLbfgs(energy, {}, &workers, &x);
  }
  const double cpu_seconds = CpuSeconds() - start;
  Report(mesh, cpu_seconds, summary.num_iterations, 2 * summary.final_cost, Project(graph, energy.FieldOf(x)), &state);
}

// The same by Ceres' minimisers.
void MinimizeWholeByCeres(benchmark::State& state, const TetMesh& mesh, ceres::LineSearchDirectionType direction) {
  const FieldGraph graph = GraphOf(mesh);
  Workers workers(1);
  auto* energy = new FieldEnergy<3>(graph, {}, &workers);
  const ceres::GradientProblem problem(energy);
  ceres::GradientProblemSolver::Options options;
  options.logging_type = ceres::SILENT;
  options.line_search_direction_type = direction;
  options.max_num_iterations = 2000;
  options.function_tolerance = 1e-7;
  ceres::GradientProblemSolver::Summary summary;
  std::vector<double> x;
  const double start = CpuSeconds();
  for (auto _ : state) {
    x = energy->ParametersOf(RandomField<3>(graph, 0));
    ceres::Solve(options, problem, x.data(), &summary);
  }
  const double cpu_seconds = CpuSeconds() - start;
  Report(mesh, cpu_seconds, static_cast<double>(summary.iterations.size()), 2 * summary.final_cost,
         Project(graph, energy->FieldOf(x)), &state);
}

template <typename... Arguments>
void Register(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

void RegisterMesh(const std::filesystem::path& path) {
  // Beyond this size a run of Levenberg-Marquardt takes minutes.
  constexpr std::size_t kMaxConjugateGradientVertices = 10000;
  const TetMesh mesh = ReadTetMesh(path);
  const std::string name = path.stem().string();
  Register(name + "/fast", Solve, mesh, std::nullopt);
  Register(name + "/whole_energy_lbfgs", MinimizeWhole, mesh);
  Register(name + "/whole_energy_ceres_lbfgs", MinimizeWholeByCeres, mesh, ceres::LBFGS);
  Register(name + "/whole_energy_ceres_ncg", MinimizeWholeByCeres, mesh, ceres::NONLINEAR_CONJUGATE_GRADIENT);
  Register(name + "/blocks_lbfgs", Solve, mesh, SolverPreset::kLbfgs);
  if (mesh.points.size() > kMaxConjugateGradientVertices) return;
  Register(name + "/blocks_cgnr", Solve, mesh, SolverPreset::kConjugateGradients);
}

void RegisterBalls() {
  for (const auto& [name, function] : {std::pair("sweep<3>", Sweep<3>), std::pair("copy<3>", Copy<3>),
                                       std::pair("sweep<4>", Sweep<4>), std::pair("copy<4>", Copy<4>)}) {
    benchmark::RegisterBenchmark(name, function)
        ->ArgNames({"cells", "threads"})
        ->ArgsProduct({{20, 99}, {1, 2}})
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  benchmark::RegisterBenchmark("growth", Growth)
      ->ArgNames({"cells", "threads"})
      ->ArgsProduct({{21, 46, 99}, {1, 2}})
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  octupole::RegisterBalls();
  for (int i = 1; i < argc; ++i) octupole::RegisterMesh(argv[i]);
  benchmark::RunSpecifiedBenchmarks();
}
