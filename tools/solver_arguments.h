#pragma once

#include <ceres/iteration_callback.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interruption.h"
#include "octupole/solvers/field_solver.h"

namespace octupole {

/// What the commands that solve have in common on the command line.
struct SolverArguments {
  std::optional<int> degree;
  /// As on the command line: "fast", or "cholesky", "cgnr" or "lbfgs" of Ceres.
  std::optional<std::string> solver;
  std::uint32_t seed = 0;
  int starts = 15;
  int threads = 1;
  std::optional<int> max_iterations;
  bool quiet = false;
  bool verbose = false;
};

/// For numbers on the command line.
CLI::Validator AtLeastZero();
CLI::Validator AboveZero();

/// Adds --degree, --solver, --seed, --starts, --threads, --max-iterations, --quiet and --verbose.
void AddSolverArguments(CLI::App* command, SolverArguments* arguments);

/// Sets what they ask for; `callback`, which must outlive the options, is called at every iteration.
template <int kDegree>
void SetSolverOptions(const SolverArguments& arguments, ceres::IterationCallback* callback,
                      FieldOptions<kDegree>* options);

/// A number as text with two digits behind the point.
std::string TwoDecimals(double number);

/// Prints what is odd about a file, one line each.
void PrintWarnings(const std::filesystem::path& file, const std::vector<std::string>& warnings);

/// What the commands have in common that align a field with a tet mesh.
struct AlignmentArguments {
  /// If given, it finds the features, whatever the mesh marks.
  std::optional<double> feature_angle;
  RegionUse regions = RegionUse::kAutomatic;
  EdgeWeights weights = EdgeWeights::kUniform;
};

/// Adds --feature-angle, --ignore-regions, --follow-regions and --weights. `arguments` must outlive the parsing.
void AddAlignmentArguments(CLI::App* command, AlignmentArguments* arguments);

class Stopwatch {
 public:
  /// Seconds since the construction or the last lap.
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Stops the solver on Ctrl-C, and shows the progress in one line, where stderr is a terminal and nobody asked for
/// silence.
class Progress final : public ceres::IterationCallback {
 public:
  Progress(const InterruptionGuard* guard, bool is_quiet);
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override;
  void Finish() const;

 private:
  const InterruptionGuard* guard_;
  bool is_shown_;
};

}  // namespace octupole
