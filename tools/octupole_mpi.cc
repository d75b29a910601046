// octupole-mpi: the field of a mesh that one machine cannot hold, by all the ranks that mpirun starts.

#include <mpi.h>
#include <petscsys.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "interruption.h"
#include "large_pages.h"
#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/distributed_quality.h"
#include "octupole/distributed/distributed_solver.h"
#include "octupole/distributed/field_output.h"
#include "octupole/distributed/mesh_part.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/solvers/method_names.h"
#include "output_files.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct Arguments {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path checkpoint;
  std::filesystem::path restart;
  double every_seconds = 600;
  int degree = 3;
  std::uint32_t seed = 0;
  int threads = 1;
  std::optional<int> max_iterations;
  std::size_t gather = DistributedOptions<3>().max_gathered_vertices;
  AlignmentArguments alignment;
  bool quiet = false;
};

constexpr double kProgressSeconds = 10;

struct Ranks {
  MPI_Comm comm = MPI_COMM_WORLD;
  int rank = 0;
  int count = 1;
};

Ranks WorldRanks() {
  Ranks ranks;
  MPI_Comm_rank(ranks.comm, &ranks.rank);
  MPI_Comm_size(ranks.comm, &ranks.count);
  return ranks;
}

// Since the construction, or the last time that it was due.
class Alarm {
 public:
  explicit Alarm(double seconds) : seconds_(seconds) {}
  bool IsDue() {
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - start_).count() < seconds_) return false;
    start_ = now;
    return true;
  }

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Ends the work on a signal; on the first rank says how far it is.
class RankProgress final : public ceres::IterationCallback {
 public:
  RankProgress(const InterruptionGuard* guard, bool is_shown) : guard_(guard), is_shown_(is_shown) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (is_shown_ && alarm_.IsDue()) {
      std::fprintf(stderr, "iteration %d  energy %.6g  %.1f s\n", summary.iteration, 2 * summary.cost,
                   summary.cumulative_time_in_seconds);
    }
    return guard_->IsInterrupted() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  void Tell(const StepSummary& step) const {
    if (!is_shown_ || step.num_vertices == 0) return;
    std::fprintf(stderr, "%s: %zu vertices, %d iterations, energy %.6g, %.1f s\n", step.name.c_str(), step.num_vertices,
                 step.num_iterations, step.energy, step.cumulative_time_in_seconds);
  }

 private:
  const InterruptionGuard* guard_;
  bool is_shown_;
  Alarm alarm_{kProgressSeconds};
};

// The least, mean and largest of all ranks' values.
nlohmann::ordered_json Spread(const Ranks& ranks, double value) {
  std::array<double, 2> extremes = {-value, value};
  double sum = value;
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), 2, MPI_DOUBLE, MPI_MAX, ranks.comm);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, ranks.comm);
  return {{"min", -extremes[0]}, {"mean", sum / ranks.count}, {"max", extremes[1]}};
}

double PeakMegabytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void PrintSummary(const nlohmann::ordered_json& report) {
  const auto number = [&](const char* key) { return report[key].get<double>(); };
  std::printf("%s: %d vertices, %d tets, %d edges, on %d ranks\n", report["mesh"].get<std::string>().c_str(),
              report["vertices"].get<int>(), report["tets"].get<int>(), report["edges"].get<int>(),
              report["ranks"].get<int>());
  std::printf("method     penalty, TAO LMVM, degree %d, %lld unknowns: %s after %d iterations\n",
              report["degree"].get<int>(), report["unknowns"].get<long long>(),
              report["termination"].get<std::string>().c_str(), report["iterations"].get<int>());
  std::printf("energy     %.6g; of the frames: degree 3 %.6g, degree 4 %.6g\n", number("energy"), number("energy3"),
              number("energy4"));
  std::printf("field      %d singular triangles, boundary error %.2g degrees (largest %.2g)\n",
              report["singular_triangles"].get<int>(), number("boundary_rms_deg"), number("boundary_max_deg"));
  std::printf("rank       %.0f MB at most; sends %.0f messages and %.0f kB an evaluation at most\n",
              report["peak_megabytes"]["max"].get<double>(), report["halo"]["messages"]["max"].get<double>(),
              report["halo"]["bytes"]["max"].get<double>() / 1000);
  const auto& seconds = report["seconds"];
  std::printf("seconds    read %.2f, solve %.2f, measure %.2f, write %.2f\n", seconds["read"].get<double>(),
              seconds["solve"].get<double>(), seconds["measure"].get<double>(), seconds["write"].get<double>());
  std::printf("written    %s\n", report["output"].get<std::string>().c_str());
}

// Returns the program's exit code.
template <int kDegree>
int RunField(const Ranks& ranks, const Arguments& arguments) {
  const bool is_first = ranks.rank == 0;
  DoTogether(ranks.comm, [&] {
    if (!is_first) return;
    std::vector<std::filesystem::path> inputs = TetMeshFiles(arguments.mesh);
    CheckOutputs(inputs, {{"--output", arguments.output, {".pvtu", ".h5"}},
                          {"--report", arguments.report},
                          {"--checkpoint", arguments.checkpoint, {".h5"}}});
  });
  const InterruptionGuard guard;
  Stopwatch stopwatch;
  std::vector<std::string> warnings;
  MeshPart part = ReadMeshPart(ranks.comm, arguments.mesh, &warnings);
  const double read_seconds = stopwatch.Lap();
  if (is_first && !arguments.quiet) PrintWarnings(arguments.mesh, warnings);

  RankProgress progress(&guard, is_first && !arguments.quiet);
  Alarm checkpoint_alarm(arguments.every_seconds);
  DistributedOptions<kDegree> options;
  if (arguments.alignment.feature_angle) {
    options.feature_angle_deg = *arguments.alignment.feature_angle;
    part.mesh.feature_edges.clear();
    part.mesh.feature_points.clear();
  }
  options.regions = arguments.alignment.regions;
  options.edge_weights = arguments.alignment.weights;
  options.max_gathered_vertices = arguments.gather;
  options.minimizer.seed = arguments.seed;
  options.minimizer.num_threads = arguments.threads;
  if (arguments.max_iterations) options.minimizer.max_iterations = *arguments.max_iterations;
  options.minimizer.callback = &progress;
  options.minimizer.step_callback = [&](const StepSummary& step) { progress.Tell(step); };
  if (!arguments.checkpoint.empty()) {
    options.is_keep_due = [&] { return checkpoint_alarm.IsDue(); };
    options.keep = [&](const DistributedState<kDegree>& state) {
      WriteFieldHdf5<kDegree>(ranks.comm, arguments.checkpoint, part, state);
    };
  }
  DistributedState<kDegree> start;
  if (!arguments.restart.empty()) {
    start = ReadFieldHdf5<kDegree>(ranks.comm, arguments.restart, part);
    options.start = &start;
  }
  const DistributedField<kDegree> field = SolveDistributed<kDegree>(ranks.comm, part, options);
  const double solve_seconds = stopwatch.Lap();
  DoTogether(ranks.comm, [&] {
    if (!field.IsUsable()) {
      throw std::runtime_error(arguments.mesh.string() + ": the solver failed: the energy is not finite");
    }
  });
  const FieldQuality quality = MeasureField(ranks.comm, part, field.frames);
  const MeshSize size = SizeOfMesh(ranks.comm, part);
  const double measure_seconds = stopwatch.Lap();
  if (arguments.output.extension() == ".h5") {
    const auto num_owned = static_cast<std::ptrdiff_t>(part.num_owned_points);
    WriteFieldHdf5<kDegree>(ranks.comm, arguments.output, part,
                            {0,
                             {field.coefficients.begin(), field.coefficients.begin() + num_owned},
                             {field.frames.begin(), field.frames.begin() + num_owned}});
  } else {
    WritePvtu<kDegree>(ranks.comm, arguments.output, part, field);
  }
  const double write_seconds = stopwatch.Lap();

  const nlohmann::ordered_json report = {
      {"mesh", arguments.mesh.string()},
      {"output", arguments.output.string()},
      {"ranks", ranks.count},
      {"threads", arguments.threads},
      {"vertices", size.points},
      {"tets", size.tets},
      {"edges", quality.edges},
      {"warnings", warnings},
      {"weights", arguments.alignment.weights == EdgeWeights::kUniform ? "uniform" : "fem"},
      {"degree", kDegree},
      {"seed", arguments.seed},
      {"unknowns", field.size.unknowns},
      {"termination", ceres::TerminationTypeToString(field.termination)},
      {"iterations", field.iterations.size()},
      {"evaluations", field.num_evaluations},
      {"energy", field.energy},
      {"energy3", quality.energy3},
      {"energy4", quality.energy4},
      {"smooth_boundary_vertices", quality.smooth_boundary_vertices},
      {"boundary_rms_deg", quality.boundary_rms_deg},
      {"boundary_max_deg", quality.boundary_max_deg},
      {"singular_triangles", quality.singular_triangles},
      {"owned_vertices", Spread(ranks, static_cast<double>(part.num_owned_points))},
      {"ghost_vertices", Spread(ranks, static_cast<double>(part.ghosts.size()))},
      // What a rank sends for an evaluation on the finest graph; besides, there is one reduction.
      {"halo",
       {{"messages", Spread(ranks, static_cast<double>(field.traffic.messages))},
        {"vertices", Spread(ranks, static_cast<double>(field.traffic.vertices))},
        {"bytes", Spread(ranks, static_cast<double>(field.traffic.bytes))}}},
      {"peak_megabytes", Spread(ranks, PeakMegabytes())},
      {"seconds",
       {{"read", read_seconds}, {"solve", solve_seconds}, {"measure", measure_seconds}, {"write", write_seconds}}},
  };
  int is_interrupted = guard.IsInterrupted();
  MPI_Allreduce(MPI_IN_PLACE, &is_interrupted, 1, MPI_INT, MPI_MAX, ranks.comm);
  DoTogether(ranks.comm, [&] {
    if (!is_first) return;
    WriteReport(arguments.report, report);
    if (is_interrupted != 0) {
      std::fprintf(stderr, "octupole-mpi: interrupted; the field reached so far is in %s\n",
                   arguments.output.string().c_str());
    }
    if (!arguments.quiet) PrintSummary(report);
  });
  constexpr int kInterruptedExitCode = 130;
  return is_interrupted != 0 ? kInterruptedExitCode : 0;
}

void AddFieldCommand(CLI::App* app, Arguments* arguments) {
  CLI::App* command = app->add_subcommand("field", "Compute a frame field on a tet mesh, on all ranks");
  command->add_option("mesh", arguments->mesh, "What 'octupole field' reads; or .h5, a DMPlex of PETSc")
      ->required()
      ->option_text("MESH");
  command
      ->add_option("-o,--output", arguments->output,
                   "The field, for ParaView, with one .vtu per rank; or .h5; by default MESH_field.pvtu, here")
      ->option_text("F.pvtu");
  command->add_option("--report", arguments->report, "All figures as JSON")->option_text("F.json");
  CLI::Option* checkpoint =
      command->add_option("--checkpoint", arguments->checkpoint, "What to go on from, kept at times")
          ->option_text("F.h5");
  command->add_option("--every", arguments->every_seconds, "Seconds from one checkpoint to the next")
      ->check(AboveZero())
      ->needs(checkpoint)
      ->option_text("SECONDS [600]");
  command->add_option("--restart", arguments->restart, "Go on from this checkpoint, on any number of ranks")
      ->check(CLI::ExistingFile)
      ->option_text("F.h5");
  command->add_option("--degree", arguments->degree, "Of the harmonics: 3 (octupoles) or 4")
      ->check(CLI::IsMember({3, 4}))
      ->option_text("N [3]");
  command->add_option("--seed", arguments->seed, "Of the random start")->option_text("N [0]");
  command->add_option("--threads", arguments->threads, "Of each rank")
      ->check(CLI::Range(1, 1024))
      ->option_text("N [1]");
  command->add_option("--max-iterations", arguments->max_iterations, "Stop there, converged or not")
      ->check(AtLeastZero())
      ->option_text("N");
  command
      ->add_option("--gather", arguments->gather,
                   "Vertices of the coarse graph that the first rank solves by itself, at most")
      ->option_text("N [20000]");
  AddAlignmentArguments(command, &arguments->alignment);
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
}

// The first of PETSc's options, which have one dash, not two, and more than one letter.
int FirstPetscArgument(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.size() > 2 && argument[0] == '-' && std::isalpha(static_cast<unsigned char>(argument[1])) != 0) {
      return i;
    }
  }
  return argc;
}

int Run(const Ranks& ranks, int argc, char** argv) {
  CLI::App app(
      "Frame fields on tetrahedral meshes by many ranks, as in: mpirun -n 4 octupole-mpi field part.msh\n"
      "Options of PETSc, such as -tao_monitor or -log_view, come last.",
      "octupole-mpi");
  Arguments arguments;
  app.require_subcommand(1);
  AddFieldCommand(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    constexpr int kUsageError = 2;
    const bool is_help = error.get_exit_code() == 0;
    if (ranks.rank == 0) app.exit(error);
    return is_help ? 0 : kUsageError;
  }
  if (arguments.output.empty()) arguments.output = arguments.mesh.stem().string() + "_field.pvtu";
  return arguments.degree == 3 ? RunField<3>(ranks, arguments) : RunField<4>(ranks, arguments);
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  octupole::UseLargePages(argc, argv);
  // The rest of the line is PETSc's.
  const int num_ours = octupole::FirstPetscArgument(argc, argv);
  std::vector<char*> petsc_arguments = {argv[0]};
  petsc_arguments.insert(petsc_arguments.end(), argv + num_ours, argv + argc);
  petsc_arguments.push_back(nullptr);
  int petsc_argc = static_cast<int>(petsc_arguments.size()) - 1;
  char** petsc_argv = petsc_arguments.data();
  if (PetscInitialize(&petsc_argc, &petsc_argv, nullptr, nullptr) != 0) return 1;
  // What goes wrong becomes an exception, with one message.
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  PetscPopSignalHandler();
  const octupole::Ranks ranks = octupole::WorldRanks();
  int exit_code = 1;
  try {
    exit_code = octupole::Run(ranks, num_ours, argv);
  } catch (const octupole::DistributedError& error) {
    if (ranks.rank == 0) std::fprintf(stderr, "octupole-mpi: %s\n", error.what());
  } catch (const std::exception& error) {
    // The other ranks know nothing of it, and wait.
    std::fprintf(stderr, "octupole-mpi: rank %d: %s\n", ranks.rank, error.what());
    MPI_Abort(ranks.comm, 1);
  }
  PetscFinalize();
  return exit_code;
}
