#include "compare_command.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "child_process.h"
#include "interruption.h"
#include "octupole/io/atomic_file.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "output_files.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;
using std::filesystem::path;

// A method with the options of `octupole field` that choose it.
struct Configuration {
  std::string name;
  std::vector<std::string> options;
  /// Runs when all do. The others take minutes where these take seconds.
  bool is_default;
};

const std::vector<Configuration>& AllConfigurations() {
  static const std::vector<Configuration> configurations = [] {
    std::vector<Configuration> result;
    for (const char* solver : {"fast", "lbfgs", "cgnr", "cholesky"}) {
      const bool is_default = solver == std::string("fast") || solver == std::string("lbfgs");
      result.push_back({std::string("octupole-") + solver, {"--degree", "3", "--solver", solver}, is_default});
      result.push_back({std::string("degree4-") + solver, {"--degree", "4", "--solver", solver}, is_default});
    }
    for (const char* method : {"ray-sokolov", "huang", "mbo"}) {
      result.push_back({method, {"--method", method}, true});
    }
    return result;
  }();
  return configurations;
}

// A figure of a run: its column in the CSV, where it is in the report of `octupole field`, to which the process adds
// its own, and its heading and decimals in the table, if it is there.
struct Figure {
  const char* column;
  const char* place;
  const char* heading;
  int decimals;
};

constexpr Figure kFigures[] = {
    {"unknowns", "/unknowns", "unknowns", 0},
    {"nonzeros", "/nonzeros", "non-zeros", 0},
    {"iterations", "/iterations", "iter.", 0},
    {"read_seconds", "/seconds/read", nullptr, 0},
    {"setup_seconds", "/seconds/setup", "setup", 2},
    {"solve_seconds", "/seconds/solve", "solve", 2},
    {"project_seconds", "/seconds/project", "project", 2},
    {"write_seconds", "/seconds/write", nullptr, 0},
    {"cpu_seconds", "/cpu_seconds", "cpu s", 2},
    {"process_cpu_seconds", "/process/cpu_seconds", nullptr, 0},
    {"peak_memory_mb", "/process/peak_memory_mb", "MB", 0},
    {"energy3", "/energy3", "energy3", 1},
    {"energy4", "/energy4", "energy4", 1},
    {"energy4_aligned", "/energy4_aligned", "aligned", 1},
    {"boundary_rms_deg", "/boundary_rms_deg", "rms deg", 3},
    {"boundary_max_deg", "/boundary_max_deg", "max deg", 3},
    {"singular_triangles", "/singular_triangles", nullptr, 0},
    {"quarter", "/singular_triangles_by_type/quarter", "1/4", 0},
    {"half", "/singular_triangles_by_type/half", "1/2", 0},
    {"diagonal_half", "/singular_triangles_by_type/diagonal_half", "1/2d", 0},
    {"third", "/singular_triangles_by_type/third", "1/3", 0},
};

// Of the claim of fewer unknowns: what degree 3 takes, divided by what degree 4 takes.
constexpr const char* kRatios[] = {"unknowns",      "nonzeros",    "iterations",     "setup_seconds",
                                   "solve_seconds", "cpu_seconds", "peak_memory_mb", "energy4"};

struct CompareArguments {
  std::vector<path> meshes;
  std::vector<std::string> methods;
  int repeat = 1;
  std::optional<double> feature_angle;
  std::uint32_t seed = 0;
  int threads = 1;
  std::optional<int> max_iterations;
  path csv;
  path json;
  path trace;
};

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "octupole_compare_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make the folder " + name);
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  path operator/(const char* name) const { return path_ / name; }

 private:
  path path_;
};

// One run of `octupole field`: its report with what the process took in "process", or only an "error".
class Runner {
 public:
  explicit Runner(const CompareArguments& arguments) : arguments_(arguments) {}

  Json Run(const path& mesh, const Configuration& configuration, std::optional<int> max_iterations) const {
    const path report_file = scratch_ / "report.json", error_file = scratch_ / "errors";
    std::filesystem::remove(report_file);
    std::vector<std::string> options = {"field",     "--quiet",
                                        "--output",  (scratch_ / "field.vtu").string(),
                                        "--report",  report_file.string(),
                                        "--seed",    std::to_string(arguments_.seed),
                                        "--threads", std::to_string(arguments_.threads)};
    options.insert(options.end(), configuration.options.begin(), configuration.options.end());
    if (arguments_.feature_angle) {
      options.insert(options.end(), {"--feature-angle", std::to_string(*arguments_.feature_angle)});
    }
    if (max_iterations) {
      options.insert(options.end(), {"--max-iterations", std::to_string(*max_iterations)});
    }
    options.insert(options.end(), {"--", mesh.string()});
    const ChildOutcome outcome = RunSelf(options, error_file);
    if (outcome.exit_code != 0) return {{"error", ErrorOf(outcome.exit_code, error_file)}};
    std::ifstream stream(report_file);
    Json report = Json::parse(stream);
    report["process"] = {{"cpu_seconds", outcome.cpu_seconds}, {"peak_memory_mb", outcome.peak_memory_mb}};
    return report;
  }

 private:
  static std::string ErrorOf(int exit_code, const path& error_file) {
    std::ifstream stream(error_file);
    std::string line;
    std::getline(stream, line);
    const std::string name = "octupole: ";
    if (line.rfind(name, 0) == 0) line.erase(0, name.size());
    return line.empty() ? "exit code " + std::to_string(exit_code) : line;
  }

  const CompareArguments& arguments_;
  ScratchFolder scratch_;
};

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// The row of a method: the medians of its runs' figures, or the first error.
Json Summarize(const std::string& method, const std::vector<Json>& runs) {
  Json row = {{"method", method}};
  for (const Json& run : runs) {
    if (!run.contains("error")) continue;
    row["error"] = run["error"];
    return row;
  }
  for (const Figure& figure : kFigures) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const Json& run : runs) values.push_back(run.at(Pointer(figure.place)).get<double>());
    const Json& first = runs[0].at(Pointer(figure.place));
    // Whole numbers stay whole unless runs differ.
    row[figure.column] = first.is_number_integer() && values.front() == Median(values) ? first : Json(Median(values));
  }
  row["termination"] = runs[0]["termination"];
  return row;
}

const Json* FindRow(const Json& rows, const std::string& method) {
  for (const Json& row : rows) {
    if (row["method"] == method && !row.contains("error")) return &row;
  }
  return nullptr;
}

// Seven unknowns instead of nine: rows of degree 3 divided by those of degree 4, for each solver that ran in both.
Json Ratios(const Json& rows) {
  Json ratios = Json::array();
  for (const char* solver : {"fast", "lbfgs", "cgnr", "cholesky"}) {
    const Json* octupole = FindRow(rows, std::string("octupole-") + solver);
    const Json* degree4 = FindRow(rows, std::string("degree4-") + solver);
    if (octupole == nullptr || degree4 == nullptr) continue;
    Json ratio = {{"method", std::string("octupole/degree4-") + solver}};
    for (const char* column : kRatios) {
      // An energy below this is that of a constant field, and rounding.
      constexpr double kZero = 1e-3;
      const double divisor = (*degree4)[column].get<double>();
      if (divisor > kZero) ratio[column] = (*octupole)[column].get<double>() / divisor;
    }
    ratios.push_back(ratio);
  }
  return ratios;
}

int WidthOf(const Figure& figure) {
  return std::max(figure.decimals == 0 ? 4 : 7, static_cast<int>(std::string(figure.heading).size()));
}

void PrintRow(const Json& row, bool is_ratio) {
  std::printf("%-24s", row["method"].get<std::string>().c_str());
  if (row.contains("error")) {
    std::printf("failed: %s\n", row["error"].get<std::string>().c_str());
    return;
  }
  for (const Figure& figure : kFigures) {
    if (figure.heading == nullptr) continue;
    const int decimals = is_ratio ? 2 : figure.decimals;
    if (row.contains(figure.column)) {
      std::printf(" %*.*f", WidthOf(figure), decimals, row[figure.column].get<double>());
    } else {
      std::printf(" %*s", WidthOf(figure), "");
    }
  }
  if (row.contains("termination") && row["termination"] != "CONVERGENCE") {
    std::printf("  %s", row["termination"].get<std::string>().c_str());
  }
  std::printf("\n");
}

void PrintTable(const Json& comparison, int repeat) {
  std::printf("%s: %d vertices, %d tets, %d edges", comparison["mesh"].get<std::string>().c_str(),
              comparison["vertices"].get<int>(), comparison["tets"].get<int>(), comparison["edges"].get<int>());
  if (repeat > 1) std::printf("; medians of %d runs in turn", repeat);
  std::printf("\n%-24s", "method");
  for (const Figure& figure : kFigures) {
    if (figure.heading != nullptr) std::printf(" %*s", WidthOf(figure), figure.heading);
  }
  std::printf("\n");
  for (const Json& row : comparison["methods"]) PrintRow(row, false);
  for (const Json& row : comparison["ratios"]) PrintRow(row, true);
  std::printf("\n");
  std::fflush(stdout);
}

std::string QuotedForCsv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string CsvField(const Json& row, const char* column) {
  if (!row.contains(column)) return "";
  return row[column].is_string() ? QuotedForCsv(row[column].get<std::string>()) : row[column].dump();
}

// Rows of objects as lines of the columns given.
void WriteCsv(const path& file, const std::vector<const char*>& columns, const std::vector<Json>& rows) {
  WriteFileAtomically(file, [&](std::ostream& stream) {
    for (const char* column : columns) stream << (column == columns[0] ? "" : ",") << column;
    stream << "\n";
    for (const Json& row : rows) {
      for (const char* column : columns) stream << (column == columns[0] ? "" : ",") << CsvField(row, column);
      stream << "\n";
    }
  });
}

void WriteComparisonCsv(const path& file, const Json& comparisons) {
  std::vector<const char*> columns = {"mesh", "vertices", "method"};
  for (const Figure& figure : kFigures) columns.push_back(figure.column);
  columns.insert(columns.end(), {"termination", "error"});
  std::vector<Json> rows;
  for (const Json& comparison : comparisons) {
    for (const char* part : {"methods", "ratios"}) {
      for (Json row : comparison[part]) {
        row["mesh"] = comparison["mesh"];
        if (comparison.contains("vertices")) row["vertices"] = comparison["vertices"];
        rows.push_back(std::move(row));
      }
    }
  }
  WriteCsv(file, columns, rows);
}

void ShowProgress(const std::string& text) {
  if (isatty(fileno(stderr)) == 0) return;
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
}

// All methods on one mesh, in turn, as often as asked. Nothing when interrupted.
std::optional<Json> CompareOn(const path& mesh, const std::vector<Configuration>& configurations,
                              const CompareArguments& arguments, const Runner& runner, const InterruptionGuard& guard) {
  std::map<std::string, std::vector<Json>> runs;
  for (int i = 0; i < arguments.repeat; ++i) {
    for (const Configuration& configuration : configurations) {
      ShowProgress(mesh.string() + ": " + configuration.name);
      runs[configuration.name].push_back(runner.Run(mesh, configuration, arguments.max_iterations));
      if (guard.IsInterrupted()) return std::nullopt;
    }
  }
  ShowProgress("");
  Json comparison = {{"mesh", mesh.string()}};
  Json rows = Json::array();
  for (const Configuration& configuration : configurations) {
    const std::vector<Json>& of_method = runs[configuration.name];
    rows.push_back(Summarize(configuration.name, of_method));
    if (rows.back().contains("error")) continue;
    for (const char* key : {"vertices", "tets", "edges"}) comparison[key] = of_method[0][key];
  }
  comparison["ratios"] = Ratios(rows);
  comparison["methods"] = std::move(rows);
  return comparison;
}

// The energy that each method has reached after more and more iterations, each time by a run of its own, until it
// converges.
void Trace(const path& mesh, const std::vector<Configuration>& configurations, const Runner& runner,
           const InterruptionGuard& guard, std::vector<Json>* rows) {
  constexpr double kGrowth = 1.4;
  for (const Configuration& configuration : configurations) {
    for (int limit = 0;; limit = std::max(limit + 1, static_cast<int>(kGrowth * limit))) {
      ShowProgress(mesh.string() + ": " + configuration.name + ", " + std::to_string(limit) + " iterations");
      const Json run = runner.Run(mesh, configuration, limit);
      if (guard.IsInterrupted()) return;
      if (run.contains("error")) break;
      Json row = {{"mesh", mesh.string()}, {"method", configuration.name}};
      for (const char* key : {"iterations", "cpu_seconds", "energy3", "energy4", "energy4_aligned", "boundary_rms_deg"})
        row[key] = run[key];
      rows->push_back(std::move(row));
      if (run["termination"] != "NO_CONVERGENCE") break;
    }
  }
  ShowProgress("");
}

// The error that all methods have in common, which then is the mesh's.
std::optional<std::string> CommonError(const Json& rows) {
  for (const Json& row : rows) {
    if (!row.contains("error") || row["error"] != rows[0]["error"]) return std::nullopt;
  }
  return rows[0]["error"].get<std::string>();
}

void RunCompare(const CompareArguments& arguments) {
  std::vector<path> inputs;
  for (const path& mesh : arguments.meshes) {
    for (path& file : TetMeshFiles(mesh)) inputs.push_back(std::move(file));
  }
  CheckOutputs(inputs, {{"--csv", arguments.csv}, {"--json", arguments.json}, {"--trace", arguments.trace}});
  std::vector<Configuration> configurations;
  for (const Configuration& configuration : AllConfigurations()) {
    const bool is_named = std::count(arguments.methods.begin(), arguments.methods.end(), configuration.name) > 0;
    if (arguments.methods.empty() ? configuration.is_default : is_named) configurations.push_back(configuration);
  }
  const InterruptionGuard guard;
  const Runner runner(arguments);
  Json comparisons = Json::array();
  std::vector<Json> trace;
  std::size_t num_failures = 0;
  std::vector<std::string> mesh_errors;
  for (const path& mesh : arguments.meshes) {
    std::optional<Json> comparison = CompareOn(mesh, configurations, arguments, runner, guard);
    if (!comparison) break;
    const Json& rows = (*comparison)["methods"];
    num_failures += std::count_if(rows.begin(), rows.end(), [](const Json& row) { return row.contains("error"); });
    if (const std::optional<std::string> error = CommonError(rows)) {
      mesh_errors.push_back(*error);
    } else {
      PrintTable(*comparison, arguments.repeat);
      if (!arguments.trace.empty()) Trace(mesh, configurations, runner, guard, &trace);
    }
    comparisons.push_back(std::move(*comparison));
    if (guard.IsInterrupted()) break;
  }
  ShowProgress("");
  if (!arguments.csv.empty()) WriteComparisonCsv(arguments.csv, comparisons);
  if (!arguments.json.empty()) {
    const Json all = {{"seed", arguments.seed},
                      {"threads", arguments.threads},
                      {"repeat", arguments.repeat},
                      {"meshes", comparisons}};
    WriteReport(arguments.json, all);
  }
  if (!arguments.trace.empty()) {
    WriteCsv(
        arguments.trace,
        {"mesh", "method", "iterations", "cpu_seconds", "energy3", "energy4", "energy4_aligned", "boundary_rms_deg"},
        trace);
  }
  if (guard.IsInterrupted()) std::fprintf(stderr, "octupole: interrupted; what was compared until then is complete\n");
  guard.ExitIfInterrupted();
  // With one mesh alone, its error is all there is to say.
  if (arguments.meshes.size() == 1 && !mesh_errors.empty()) throw std::runtime_error(mesh_errors[0]);
  for (const std::string& error : mesh_errors) std::fprintf(stderr, "octupole: %s\n", error.c_str());
  if (num_failures > 0) throw std::runtime_error(std::to_string(num_failures) + " of the runs failed");
}

}  // namespace

void AddCompareCommand(CLI::App* app) {
  auto arguments = std::make_shared<CompareArguments>();
  std::string names, on_request;
  std::vector<std::string> all;
  for (const Configuration& configuration : AllConfigurations()) {
    std::string& list = configuration.is_default ? names : on_request;
    list += (list.empty() ? "" : ", ") + configuration.name;
    all.push_back(configuration.name);
  }
  CLI::App* command = app->add_subcommand("compare", "Run several methods on meshes and put the figures side by side");
  command->footer(
      "Seconds are wall-clock time by phase; cpu s is the CPU time of setup, solving and projection on all threads.\n"
      "MB is the peak memory of the whole run. Energies are those of the frames; aligned is energy4 of the nearest\n"
      "frames that keep to the boundary, which differs where a method aligns softly. 1/4, 1/2, 1/2d, 1/3: singular\n"
      "triangles by the turn around them. The rows octupole/degree4 are ratios. docs/comparison.md says more.");
  command->add_option("mesh", arguments->meshes, "As for field")->required()->option_text("MESH ...");
  command
      ->add_option("--methods", arguments->methods,
                   "Comma-separated, of " + names + " (all these by default); on request only " + on_request)
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows is a mesh
      ->check(CLI::IsMember(all).description(""))
      ->option_text("A,B,...");
  command->add_option("--repeat", arguments->repeat, "Run all methods in turn so often, and give medians")
      ->check(CLI::Range(1, 1000))
      ->option_text("N [1]");
  command->add_option("--feature-angle", arguments->feature_angle, "As for field")
      ->check(CLI::Range(1., 179.))
      ->option_text("DEG");
  command->add_option("--seed", arguments->seed, "Of the random starts")->option_text("N [0]");
  command->add_option("--threads", arguments->threads, "For each run")
      ->check(CLI::Range(1, 1024))
      ->option_text("N [1]");
  command->add_option("--max-iterations", arguments->max_iterations, "Of each run")
      ->check(AtLeastZero())
      ->option_text("N");
  command->add_option("--csv", arguments->csv, "All figures, one line a method and mesh")->option_text("F.csv");
  command->add_option("--json", arguments->json, "The same as JSON")->option_text("F.json");
  command
      ->add_option("--trace", arguments->trace,
                   "Energy against CPU time, by further runs with 0, 1, 2, ... iterations until they converge; "
                   "scripts/plot_trace draws it")
      ->option_text("F.csv");
  command->callback([arguments] { RunCompare(*arguments); });
}

}  // namespace octupole
