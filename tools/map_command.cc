#include "map_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "activity.h"
#include "interruption.h"
#include "octupole/io/field_reader.h"
#include "octupole/io/map_reader.h"
#include "octupole/io/map_writer.h"
#include "octupole/map_solvers/seamless_map.h"
#include "octupole/maps/map_obstacles.h"
#include "octupole/maps/map_quality.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/view/map_scene.h"
#include "octupole/view/scene_page.h"
#include "output_files.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct MapArguments {
  std::filesystem::path mesh;
  std::filesystem::path field;
  std::filesystem::path output;
  std::filesystem::path vtu;
  std::filesystem::path markers;
  std::filesystem::path report;
  std::filesystem::path html;
  /// An earlier map.
  std::filesystem::path start;
  /// If given, it finds the features, whatever the mesh marks.
  std::optional<double> feature_angle;
  MapOptions options;
  bool quiet = false;
};

constexpr const char* kObstacleNames[] = {"",          "turn",    "valence_change", "wedge",      "thin_part",
                                          "collapsed", "flipped", "released",       "short_curve"};

nlohmann::ordered_json DescribeObstacles(const std::vector<MapObstacle>& obstacles) {
  auto list = nlohmann::ordered_json::array();
  for (const MapObstacle& obstacle : obstacles) {
    list.push_back({{"kind", kObstacleNames[static_cast<std::size_t>(obstacle.kind)]},
                    {"edges", obstacle.edges.size()},
                    {"tets", obstacle.tets.size()},
                    {"size", obstacle.size},
                    {"at", obstacle.place},
                    {"text", obstacle.Describe()}});
  }
  return list;
}

// At most a few lines of each kind; the report has them all.
void PrintObstacles(const std::vector<MapObstacle>& obstacles) {
  constexpr int kMaxLines = 5;
  std::map<ObstacleKind, int> count;
  for (const MapObstacle& obstacle : obstacles) {
    if (++count[obstacle.kind] <= kMaxLines) std::printf("obstacle   %s\n", obstacle.Describe().c_str());
  }
  for (const auto& [kind, total] : count) {
    if (total <= kMaxLines) continue;
    std::printf("obstacle   ... and %d more of the kind %s\n", total - kMaxLines,
                kObstacleNames[static_cast<std::size_t>(kind)]);
  }
}

std::vector<Eigen::Matrix3d> LoadFrames(const MapArguments& arguments, const TetMesh& mesh, Progress* progress) {
  if (!arguments.field.empty()) {
    std::vector<Eigen::Matrix3d> frames = ReadField(arguments.field).frames;
    if (frames.size() == mesh.points.size()) return frames;
    throw std::runtime_error(arguments.field.string() + ": frames of " + std::to_string(frames.size()) +
                             " points, but the mesh has " + std::to_string(mesh.points.size()));
  }
  FieldOptions<3> options;
  if (arguments.feature_angle) options.feature_angle_deg = *arguments.feature_angle;
  options.minimizer.callback = progress;
  options.minimizer.num_threads = arguments.options.num_threads;
  const Field<3> field = SolveField<3>(mesh, options);
  if (!field.IsUsable()) throw std::runtime_error(arguments.mesh.string() + ": no field: the energy is not finite");
  return field.frames;
}

void RunMap(const MapArguments& arguments) {
  std::vector<std::filesystem::path> inputs = TetMeshFiles(arguments.mesh);
  for (const auto* file : {&arguments.field, &arguments.start}) {
    if (!file->empty()) inputs.push_back(*file);
  }
  CheckOutputs(inputs, {{"--output", arguments.output, {".hexex"}},
                        {"--vtu", arguments.vtu, {".vtu"}},
                        {"--markers", arguments.markers, {".vtu"}},
                        {"--report", arguments.report},
                        {"--html", arguments.html, {".html", ".htm"}}});
  if (!arguments.html.empty()) CheckScenePages();
  const InterruptionGuard guard;
  Progress progress(&guard, arguments.quiet);
  std::vector<std::string> warnings;
  SetActivity("reading " + arguments.mesh.string());
  TetMesh mesh = ReadTetMesh(arguments.mesh, &warnings);
  for (std::string& warning : MeshWarnings(InspectMesh(mesh))) warnings.push_back(std::move(warning));
  if (!arguments.quiet) PrintWarnings(arguments.mesh, warnings);
  MapOptions options = arguments.options;
  if (arguments.feature_angle) {
    options.boundary.feature_angle_deg = *arguments.feature_angle;
    mesh.feature_edges.clear();
    mesh.feature_points.clear();
  }
  if (!arguments.start.empty()) options.start = ReadHexEx(arguments.start);
  SetActivity("solving", mesh.points.size());
  Stopwatch stopwatch;
  const std::vector<Eigen::Matrix3d> frames = LoadFrames(arguments, mesh, &progress);
  const double field_seconds = stopwatch.Lap();
  options.callback = &progress;
  const SeamlessMap map = SolveSeamlessMap(mesh, frames, options);
  progress.Finish();
  const MapDomain& domain = map.domain;
  const MapQuality quality = MeasureMap(domain.mesh, map.parameters, map.size);
  const std::vector<MapObstacle> obstacles = FindObstacles(domain, map.flipped, map.parameters);
  WriteHexEx(arguments.output, domain.mesh, map.parameters);
  if (!arguments.vtu.empty()) WriteMapVtu(arguments.vtu, domain.mesh, domain.cut, map.parameters);
  if (!arguments.html.empty()) {
    Scene scene = MakeMapScene(arguments.mesh.filename().string(), domain, map.parameters, obstacles,
                               options.boundary.feature_angle_deg);
    scene.figures = MapFigures(domain, quality, map.size);
    WriteScenePage(arguments.html, {scene});
  }
  if (!arguments.markers.empty()) WriteObstacles(arguments.markers, domain.mesh, obstacles);

  std::map<int, int> edges_of_valence;
  for (const SingularEdge& edge : domain.singular_edges) ++edges_of_valence[edge.valence];
  const nlohmann::ordered_json report = {
      {"mesh", arguments.mesh.string()},
      {"field", arguments.field.string()},
      {"output", arguments.output.string()},
      {"vertices", mesh.points.size()},
      {"tets", mesh.tets.size()},
      {"tets_after_splitting", domain.mesh.tets.size()},
      {"components", domain.combed.num_components},
      {"warnings", warnings},
      {"start", arguments.start.string()},
      {"size", map.size},
      {"unknowns", domain.unknowns.num_unknowns},
      {"sheets", domain.sheets.sheets.size()},
      {"released_sheets", std::count_if(domain.sheets.sheets.begin(), domain.sheets.sheets.end(),
                                        [](const auto& sheet) { return sheet.is_released; })},
      {"singular_edges",
       {{"valence_3", edges_of_valence[3]}, {"valence_5", edges_of_valence[5]}, {"other", edges_of_valence[0]}}},
      {"flipped_by_least_squares", map.flipped_before.size()},
      {"flipped", quality.flipped},
      {"flat", map.flipped.size()},
      {"flipped_volume", quality.flipped_volume},
      {"stretch_5", quality.stretch_5},
      {"stretch_95", quality.stretch_95},
      {"parameter_volume", quality.parameter_volume},
      {"integer", arguments.options.integer},
      {"rounded", map.num_rounded},
      {"is_integer_grid", map.is_integer_grid},
      {"termination", ceres::TerminationTypeToString(map.termination)},
      {"iterations", map.num_iterations},
      {"obstacles", DescribeObstacles(obstacles)},
      {"seconds",
       {{"field", field_seconds},
        {"setup", map.setup_seconds},
        {"linear", map.linear_seconds},
        {"foldovers", map.foldover_seconds}}},
  };
  WriteReport(arguments.report, report);
  if (!arguments.quiet) {
    std::printf("%s: %zu vertices, %zu tets, %zu after splitting\n", arguments.mesh.string().c_str(),
                mesh.points.size(), mesh.tets.size(), domain.mesh.tets.size());
    std::printf("map        size %g, %d unknowns: %s after %d iterations\n", map.size, domain.unknowns.num_unknowns,
                ceres::TerminationTypeToString(map.termination), map.num_iterations);
    std::printf("singular   %d edges of valence 3, %d of 5, %d other\n", edges_of_valence[3], edges_of_valence[5],
                edges_of_valence[0]);
    std::printf("foldovers  %zu tets turned over, %zu flat, %.3g %% of the volume; %zu by least squares\n",
                quality.flipped, map.flipped.size() - std::min(map.flipped.size(), quality.flipped),
                100 * quality.flipped_volume, map.flipped_before.size());
    std::printf("stretch    5 and 95 %%: %.3g, %.3g\n", quality.stretch_5, quality.stretch_95);
    if (arguments.options.integer) {
      std::printf("integer    %d unknowns rounded; the map stands for %.6g hexahedra%s\n", map.num_rounded,
                  quality.parameter_volume, map.is_integer_grid ? "" : ", but is not valid: see the obstacles");
    }
    PrintObstacles(obstacles);
    std::printf("seconds    field %.2f, setup %.2f, linear %.2f, foldovers %.2f\n", field_seconds, map.setup_seconds,
                map.linear_seconds, map.foldover_seconds);
    for (const auto* file : {&arguments.output, &arguments.vtu, &arguments.markers, &arguments.html}) {
      if (!file->empty()) std::printf("written    %s\n", file->string().c_str());
    }
  }
  if (guard.IsInterrupted()) {
    std::fprintf(stderr, "octupole: interrupted; the map reached so far is in %s\n", arguments.output.string().c_str());
  }
  guard.ExitIfInterrupted();
}

}  // namespace

void AddMapCommand(CLI::App* app) {
  auto arguments = std::make_shared<MapArguments>();
  CLI::App* command = app->add_subcommand("map", "Compute a seamless map of a tet mesh, for hexahedral meshers");
  command->add_option("mesh", arguments->mesh, "As for field")->required()->option_text("MESH");
  command
      ->add_option("--size", arguments->options.size,
                   "Length of the hexahedra's edges; by default twice the mesh's mean edge")
      ->check(AboveZero())
      ->option_text("H");
  command->add_option("--field", arguments->field, "Of octupole field on this mesh; by default it is computed")
      ->option_text("FIELD.vtu");
  command->add_option("-o,--output", arguments->output, "The map, for libHexEx; by default MESH.hexex, here")
      ->option_text("F.hexex");
  command->add_option("--vtu", arguments->vtu, "The cut mesh with the parameters, for ParaView")->option_text("F.vtu");
  command->add_option("--markers", arguments->markers, "What stands in the way, as lines and tets")
      ->option_text("F.vtu");
  command->add_option("--html", arguments->html, "The map's integer grid as a page for the browser")
      ->option_text("F.html");
  command
      ->add_option(
          "--feature-angle", arguments->feature_angle,
          "Between normals, above which an edge is a feature; if given, features that the mesh marks are ignored")
      ->check(CLI::Range(1., 179.))
      ->option_text("DEG [40]");
  command
      ->add_option("--start", arguments->start,
                   "An earlier map of this mesh to begin with: another H, integers, or more iterations")
      ->option_text("F.hexex");
  command->add_option("--report", arguments->report, "All figures as JSON")->option_text("F.json");
  command->add_flag("--integer", arguments->options.integer, "Round to an integer-grid map; it may fail and says so");
  command->add_option("--threads", arguments->options.num_threads, "For the solver")
      ->check(CLI::Range(1, 1024))
      ->option_text("N [1]");
  command->add_option("--max-iterations", arguments->options.max_iterations, "Against foldovers; stop there")
      ->check(AtLeastZero())
      ->option_text("N [200]");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([arguments] {
    if (arguments->output.empty()) arguments->output = arguments->mesh.stem().string() + ".hexex";
    RunMap(*arguments);
  });
}

}  // namespace octupole
