#include "grid_command.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "activity.h"
#include "interruption.h"
#include "octupole/adaptors/triangle_mesh_reader.h"
#include "octupole/grids/surface_grid.h"
#include "octupole/grids/surface_grid_field.h"
#include "octupole/grids/surface_grid_quality.h"
#include "octupole/grids/surface_grid_sampler.h"
#include "octupole/grids/surface_grid_tets.h"
#include "octupole/grids/surface_grid_vdb.h"
#include "octupole/grids/surface_grid_writer.h"
#include "octupole/io/sample_files.h"
#include "octupole/io/singularity_writer.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/singular_triangles.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/method_names.h"
#include "octupole/view/field_scene.h"
#include "octupole/view/scene_page.h"
#include "output_files.h"
#include "singularity_report.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct GridArguments {
  std::filesystem::path surface;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path singularities;
  std::filesystem::path vdb;
  std::filesystem::path html;
  /// Where the field is wanted, and the file for it.
  std::filesystem::path points;
  std::filesystem::path samples;
  int resolution = 64;
  std::optional<double> size;
  GridOptions grid;
  FieldMethod method = FieldMethod::kPenalty;
  SolverArguments solver;
};

// A surface, or the boundary of a tet mesh.
TriangleMesh LoadSurface(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  return IsSurfaceFile(path) ? ReadTriangleMesh(path, warnings) : BoundarySurface(ReadTetMesh(path, warnings));
}

void PrintSummary(const GridArguments& arguments, const nlohmann::ordered_json& report) {
  const auto count = [](const nlohmann::ordered_json& value) { return value.get<long long>(); };
  const auto number = [](const nlohmann::ordered_json& value) { return value.get<double>(); };
  std::printf("%s: %lld triangles\n", arguments.surface.string().c_str(), count(report["triangles"]));
  std::printf("grid       %lld nodes, %lld cells of size %.4g", count(report["nodes"]), count(report["cells"]),
              number(report["size"]));
  if (arguments.grid.levels > 1) std::printf(" and up to %d times that", 1 << (arguments.grid.levels - 1));
  const auto& alignment = report["alignment"];
  std::printf("\nalignment  %lld normals, %lld frames, %lld tangents, %lld free; %lld feature edges, %s\n",
              count(alignment["normals"]), count(alignment["frames"]), count(alignment["tangents"]),
              count(alignment["free"]), count(report["features"]["edges"]),
              report["features"]["source"] == "marked" ? "marked" : "by their angle");
  if (count(alignment["conflicts"]) > 0) {
    std::printf(
        "           at %lld nodes several sheets of the surface meet that no frame fits; a size of %.3g would "
        "separate them\n",
        count(alignment["conflicts"]), number(alignment["separating_size"]));
  }
  std::printf("method     degree %lld, %lld unknowns: %s after %lld iterations\n", count(report["degree"]),
              count(report["unknowns"]), report["termination"].get<std::string>().c_str(), count(report["iterations"]));
  std::printf("energy     %.6g; of the frames: degree 3 %.6g, degree 4 %.6g\n", number(report["energy"]),
              number(report["energy3"]), number(report["energy4"]));
  std::printf("boundary   error %.2g degrees (largest %.2g)\n", number(report["boundary_rms_deg"]),
              number(report["boundary_max_deg"]));
  std::printf("singular   %s\n", SummaryOf(report["singular_structure"]).c_str());
  const auto& seconds = report["seconds"];
  std::printf("seconds    read %.2f, grid %.2f, solve %.2f, trace %.2f, measure %.2f, write %.2f\n",
              number(seconds["read"]), number(seconds["grid"]), number(seconds["solve"]), number(seconds["trace"]),
              number(seconds["measure"]), number(seconds["write"]));
  for (const auto* file :
       {&arguments.output, &arguments.singularities, &arguments.vdb, &arguments.html, &arguments.samples}) {
    if (!file->empty()) std::printf("written    %s\n", file->string().c_str());
  }
}

nlohmann::ordered_json DescribeGridAlignment(const GridAlignment& alignment) {
  nlohmann::ordered_json section = DescribeAlignment(alignment);
  section["conflicts"] = alignment.num_conflicts;
  if (alignment.separating_size) section["separating_size"] = *alignment.separating_size;
  return section;
}

std::vector<std::size_t> CountCellsByLevel(const SurfaceGrid& grid, int num_levels) {
  std::vector<std::size_t> counts(num_levels, 0);
  for (const std::uint8_t level : grid.levels) ++counts[level];
  return counts;
}

// A page of the field at the nodes inside the solid; those outside are there for the surface's sake.
template <int kDegree>
void WritePage(const GridArguments& arguments, const TriangleMesh& surface, const SurfaceGrid& grid,
               const FieldSolution<kDegree>& field, const SingularCurves& curves, const GridQuality& quality) {
  std::vector<std::array<int, 2>> edges;
  for (const WeightedEdge& edge : grid.graph.edges) {
    if (grid.distances[edge.a] <= 0 && grid.distances[edge.b] <= 0) edges.push_back({edge.a, edge.b});
  }
  Scene scene = MakeFieldScene(arguments.surface.filename().string(), surface, grid.points, edges, field.frames, curves,
                               arguments.grid.feature_angle_deg);
  scene.figures = {{"nodes", std::to_string(grid.points.size())},
                   {"cells", std::to_string(grid.cells.size())},
                   {"boundary error, rms", TwoDecimals(quality.boundary_rms_deg) + "\u00b0"},
                   {"singular curves", std::to_string(curves.curves.size())},
                   {"method", NameOf(arguments.method)},
                   {"degree", std::to_string(kDegree)},
                   {"seed", std::to_string(arguments.solver.seed)}};
  WriteScenePage(arguments.html, {scene});
}

template <int kDegree>
void RunGrid(const GridArguments& arguments) {
  std::vector<std::filesystem::path> inputs = {arguments.surface};
  if (!arguments.points.empty()) inputs.push_back(arguments.points);
  CheckOutputs(inputs, {{"--output", arguments.output, {".vtu"}},
                        {"--report", arguments.report},
                        {"--singularities", arguments.singularities, {".vtu"}},
                        {"--vdb", arguments.vdb, {".vdb"}},
                        {"--html", arguments.html, {".html", ".htm"}},
                        {"--sample-output", arguments.samples, {".vtu", ".csv"}}});
  if (!arguments.html.empty()) CheckScenePages();
  const InterruptionGuard guard;
  Stopwatch stopwatch;
  const std::clock_t cpu_start = std::clock();
  std::vector<std::string> warnings;
  SetActivity("reading " + arguments.surface.string());
  const TriangleMesh surface = LoadSurface(arguments.surface, &warnings);
  const std::vector<Eigen::Vector3d> points =
      arguments.points.empty() ? std::vector<Eigen::Vector3d>() : ReadPoints(arguments.points);
  const double read_seconds = stopwatch.Lap();

  SetActivity("making the grid and solving");
  GridOptions grid_options = arguments.grid;
  grid_options.size = arguments.size ? *arguments.size : SizeForResolution(surface, arguments.resolution);
  grid_options.num_threads = arguments.solver.threads;
  Progress progress(&guard, arguments.solver.quiet);
  FieldOptions<kDegree> options;
  options.method = arguments.method;
  SetSolverOptions(arguments.solver, &progress, &options);
  Field<kDegree> field;
  double solve_seconds = 0;
  std::vector<std::size_t> num_nodes;  // of the grids
  const auto solve = [&](const SurfaceGrid& grid, std::vector<Eigen::Matrix3d> start) {
    num_nodes.push_back(grid.points.size());
    SetActivity("solving", grid.points.size());
    if (options.method == FieldMethod::kPenalty) options.start_frames = std::move(start);
    Stopwatch watch;
    field = SolveField<kDegree>(grid.graph, options);
    solve_seconds += watch.Lap();
    if (!field.IsUsable()) {
      throw std::runtime_error(arguments.surface.string() + ": the solver failed: " +
                               (field.ceres_summary ? field.ceres_summary->message : "the energy is not finite"));
    }
    return field.frames;
  };
  const SurfaceGrid grid = SolveOnGrids(surface, grid_options, solve, &warnings);
  progress.Finish();
  const double grid_seconds = stopwatch.Lap() - solve_seconds;
  if (!arguments.solver.quiet) PrintWarnings(arguments.surface, warnings);

  SetActivity("measuring and writing the field", grid.points.size());
  SingularCurves curves;
  {
    const GridTets tets = TetsAtSingularities(grid, field.frames);
    curves = TraceSingularCurves(tets.mesh, tets.frames, FindSingularTriangles(tets.mesh, tets.frames));
  }
  const double trace_seconds = stopwatch.Lap();
  const GridQuality quality = MeasureGridField(surface, grid, field.frames);
  const double measure_seconds = stopwatch.Lap();

  WriteGridField<kDegree>(arguments.output, grid, field.coefficients, field.frames);
  if (!arguments.singularities.empty()) WriteSingularities(arguments.singularities, curves, {}, {}, {});
  if (!arguments.vdb.empty()) WriteGridVdb(arguments.vdb, grid, field.frames);
  if (!arguments.html.empty()) WritePage<kDegree>(arguments, surface, grid, field, curves, quality);
  if (!arguments.points.empty()) {
    WriteSamples(arguments.samples, points, GridSampler(grid, field.frames).Sample(points));
  }
  const double write_seconds = stopwatch.Lap();

  nlohmann::ordered_json report = {
      {"mesh", arguments.surface.string()},
      {"output", arguments.output.string()},
      {"triangles", surface.triangles.size()},
      {"size", grid.size},
      {"levels", grid_options.levels},
      // Of all grids from coarse to fine.
      {"nodes_by_grid", num_nodes},
      {"nodes", grid.points.size()},
      {"cells", grid.cells.size()},
      {"cells_by_level", CountCellsByLevel(grid, grid_options.levels)},
      {"hanging_nodes", grid.hanging_nodes.size()},
      {"edges", grid.graph.edges.size()},
      {"alignment", DescribeGridAlignment(grid.alignment)},
      {"features",
       {{"source", grid.alignment.has_marked_features ? "marked" : "angle"},
        {"edges", grid.alignment.num_feature_edges}}},
      {"warnings", warnings},
      {"method", NameOf(arguments.method)},
      {"degree", kDegree},
      {"seed", arguments.solver.seed},
      {"unknowns", field.size.unknowns},
      {"termination", ceres::TerminationTypeToString(field.termination)},
      {"iterations", field.iterations.empty() ? 0 : field.iterations.back().iteration},
      {"energy", field.energy},
      {"energy3", quality.energy3},
      {"energy4", quality.energy4},
      {"boundary_rms_deg", quality.boundary_rms_deg},
      {"boundary_max_deg", quality.boundary_max_deg},
      {"boundary_samples", quality.boundary_samples},
      {"singular_structure", SingularStructureReport(curves, {})},
      {"seconds",
       {{"read", read_seconds},
        {"grid", grid_seconds},
        {"solve", solve_seconds},
        {"trace", trace_seconds},
        {"measure", measure_seconds},
        {"write", write_seconds}}},
      // Of all threads, for all that.
      {"cpu_seconds", static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC},
  };
  if (arguments.method == FieldMethod::kPenalty) report["solver"] = arguments.solver.solver.value_or("fast");
  WriteReport(arguments.report, report);
  if (guard.IsInterrupted()) {
    std::fprintf(stderr, "octupole: interrupted; the field reached so far is in %s\n",
                 arguments.output.string().c_str());
  }
  if (!arguments.solver.quiet) PrintSummary(arguments, report);
  guard.ExitIfInterrupted();
}

}  // namespace

void AddGridCommand(CLI::App* app) {
  auto arguments = std::make_shared<GridArguments>();
  CLI::App* command = app->add_subcommand("grid", "Compute a frame field inside a closed surface, on a grid");
  command
      ->add_option("surface", arguments->surface,
                   ".obj, .off, .stl or .ply; or a tet mesh, of which the boundary is taken")
      ->required()
      ->option_text("SURFACE");
  CLI::Option* resolution = command->add_option("--resolution", arguments->resolution,
                                                "Of the finest cells, along the longest side of the bounding box");
  resolution->check(CLI::Range(2, 100000))->option_text("N [64]");
  command->add_option("--size", arguments->size, "Of the finest cells, instead")
      ->check(CLI::PositiveNumber)
      ->excludes(resolution)
      ->option_text("H");
  command
      ->add_option("--levels", arguments->grid.levels,
                   "Sizes of cells, each twice the one before, from the surface inwards; 1: a uniform grid")
      ->check(CLI::Range(1, 8))
      ->option_text("K [1]");
  command->add_option("-o,--output", arguments->output, "The field, for ParaView; by default SURFACE_grid.vtu, here")
      ->option_text("F.vtu");
  command->add_option("--report", arguments->report, "All figures as JSON")->option_text("F.json");
  command->add_option("--singularities", arguments->singularities, "Singular curves as lines")->option_text("F.vtu");
  command->add_option("--html", arguments->html, "The field as a page for the browser, as by 'octupole view'")
      ->option_text("F.html");
  CLI::Option* points =
      command
          ->add_option("--sample", arguments->points,
                       "Where else the field is wanted: .csv, .txt or .xyz with x, y, z in each line, or any mesh, "
                       "tetrahedral or not: its vertices")
          ->option_text("POINTS_OR_MESH");
  command
      ->add_option("--sample-output", arguments->samples,
                   "The frames there; by default POINTS_OR_MESH_samples.vtu, here")
      ->needs(points)
      ->option_text("F.vtu|F.csv");
  command
      ->add_option_function<std::string>(
          "--method", [arguments](const std::string& name) { arguments->method = FieldMethodOf(name); },
          "penalty, or of the classics in degree 4 ray-sokolov, huang or mbo")
      ->check(CLI::IsMember({"penalty", "ray-sokolov", "huang", "mbo"}))
      ->option_text("NAME [penalty]");
  command->add_option("--vdb", arguments->vdb, "Signed distance and axes, for what reads OpenVDB")
      ->option_text("F.vdb");
  command
      ->add_option("--feature-angle", arguments->grid.feature_angle_deg,
                   "Between normals, above which an edge is a feature where none are marked")
      ->check(CLI::Range(1., 179.))
      ->option_text("DEG [40]");
  command
      ->add_option_function<std::string>(
          "--repair", [arguments](const std::string& name) { arguments->grid.repair = HoleRepairOf(name); },
          "Where the surface is open: none, an error; or close, with caps")
      ->check(CLI::IsMember({"none", "close"}))
      ->option_text("NAME [none]");
  AddSolverArguments(command, &arguments->solver);
  command->callback([arguments] {
    const bool is_classic = arguments->method != FieldMethod::kPenalty;
    if (is_classic && arguments->solver.solver) {
      throw CLI::ValidationError("--solver", "only for --method penalty, not for " + NameOf(arguments->method));
    }
    if (is_classic && arguments->solver.degree == 3) {
      throw CLI::ValidationError("--degree", NameOf(arguments->method) + " knows degree 4 only");
    }
    if (arguments->output.empty()) arguments->output = arguments->surface.stem().string() + "_grid.vtu";
    if (!arguments->points.empty() && arguments->samples.empty()) {
      arguments->samples = arguments->points.stem().string() + "_samples.vtu";
    }
    arguments->solver.degree.value_or(is_classic ? 4 : 3) == 3 ? RunGrid<3>(*arguments) : RunGrid<4>(*arguments);
  });
}

}  // namespace octupole
