#include "solver_arguments.h"

#include <glog/logging.h>
#include <unistd.h>

#include <cstdio>
#include <map>

#include "octupole/solvers/method_names.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {
namespace {

const std::map<std::string, EdgeWeights> kWeightsOfName = {{"uniform", EdgeWeights::kUniform},
                                                           {"fem", EdgeWeights::kFiniteElement}};

void LogStep(const StepSummary& step) {
  if (step.num_vertices == 0) {
    LOG(INFO) << step.name << ", " << step.cumulative_time_in_seconds << " s";
    return;
  }
  LOG(INFO) << step.name << ": " << step.num_vertices << " vertices, " << step.num_iterations << " iterations, energy "
            << step.energy << ", " << step.cumulative_time_in_seconds << " s";
}

}  // namespace

CLI::Validator AtLeastZero() {
  return {[](const std::string& text) {
            double number = 0;
            return CLI::detail::lexical_cast(text, number) && number < 0 ? text + " is less than 0" : std::string();
          },
          ""};
}

CLI::Validator AboveZero() {
  return {[](const std::string& text) {
            double number = 1;
            return CLI::detail::lexical_cast(text, number) && !(number > 0) ? text + " is not above 0" : std::string();
          },
          ""};
}

void AddSolverArguments(CLI::App* command, SolverArguments* arguments) {
  command->add_option("--degree", arguments->degree, "Of the harmonics: 3 (octupoles) or 4")
      ->check(CLI::IsMember({3, 4}))
      ->option_text("N [3]");
  command->add_option("--solver", arguments->solver, "fast, or of Ceres cholesky, cgnr or lbfgs")
      ->check(CLI::IsMember({"fast", "cholesky", "cgnr", "lbfgs"}))
      ->option_text("NAME [fast]");
  command->add_option("--seed", arguments->seed, "Of the random start")->option_text("N [0]");
  command
      ->add_option(
          "--starts", arguments->starts,
          "That the fast solver tries at most, until two agree: more for lower energies; 5 from 14,000 vertices on")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N [15]");
  command->add_option("--threads", arguments->threads, "For the solver")
      ->check(CLI::Range(1, 1024))
      ->option_text("N [1]");
  command->add_option("--max-iterations", arguments->max_iterations, "Stop there, converged or not")
      ->check(AtLeastZero())
      ->option_text("N");
  CLI::Option* quiet = command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->add_flag("--verbose", arguments->verbose, "Log each step of the solver to stderr")->excludes(quiet);
}

void AddAlignmentArguments(CLI::App* command, AlignmentArguments* arguments) {
  command
      ->add_option(
          "--feature-angle", arguments->feature_angle,
          "Between normals, above which an edge is a feature; if given, features that the mesh marks are ignored")
      ->check(CLI::Range(1., 179.))
      ->option_text("DEG [40]");
  const auto add_regions = [&](const char* flag, RegionUse use, const char* what) {
    return command->add_flag_callback(
        flag, [arguments, use] { arguments->regions = use; }, what);
  };
  add_regions("--ignore-regions", RegionUse::kIgnore, "Follow no surfaces inside the mesh")
      ->excludes(add_regions("--follow-regions", RegionUse::kFollow,
                             "Follow all faces between regions and tagged triangles inside, ragged ones too"));
  command
      ->add_option_function<std::string>(
          "--weights", [arguments](const std::string& name) { arguments->weights = kWeightsOfName.at(name); },
          "Of the mesh's edges: uniform, or fem (finite elements), which heed their lengths")
      ->check(CLI::IsMember({"uniform", "fem"}))
      ->option_text("NAME [uniform]");
}

template <int kDegree>
void SetSolverOptions(const SolverArguments& arguments, ceres::IterationCallback* callback,
                      FieldOptions<kDegree>* options) {
  options->seed = arguments.seed;
  options->minimizer.num_threads = arguments.threads;
  options->minimizer.num_starts = arguments.starts;
  if (arguments.max_iterations) options->minimizer.max_iterations = *arguments.max_iterations;
  options->minimizer.callback = callback;
  if (arguments.verbose) {
    FLAGS_minloglevel = google::INFO;
    options->minimizer.step_callback = LogStep;
  }
  const std::optional<SolverPreset> preset = SolverPresetOf(arguments.solver.value_or("fast"));
  if (!preset) return;
  options->solver = MakeSolverOptions(*preset);
  options->solver->num_threads = arguments.threads;
  if (arguments.max_iterations) options->solver->max_num_iterations = *arguments.max_iterations;
  options->solver->callbacks.push_back(callback);
}

std::string TwoDecimals(double number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", number);
  return text;
}

void PrintWarnings(const std::filesystem::path& file, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "%s: warning: %s\n", file.string().c_str(), warning.c_str());
  }
}

Progress::Progress(const InterruptionGuard* guard, bool is_quiet)
    : guard_(guard), is_shown_(!is_quiet && isatty(fileno(stderr)) != 0) {}

ceres::CallbackReturnType Progress::operator()(const ceres::IterationSummary& summary) {
  if (is_shown_) {
    std::fprintf(stderr, "\r\033[Kiteration %d  energy %.6g  %.1f s", summary.iteration, 2 * summary.cost,
                 summary.cumulative_time_in_seconds);
    std::fflush(stderr);
  }
  return guard_->IsInterrupted() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
}

void Progress::Finish() const {
  if (is_shown_) std::fprintf(stderr, "\r\033[K");
}

template void SetSolverOptions<3>(const SolverArguments&, ceres::IterationCallback*, FieldOptions<3>*);
template void SetSolverOptions<4>(const SolverArguments&, ceres::IterationCallback*, FieldOptions<4>*);

}  // namespace octupole
