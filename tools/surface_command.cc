#include "surface_command.h"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "activity.h"
#include "interruption.h"
#include "octupole/adaptors/triangle_mesh_reader.h"
#include "octupole/field/cross_field.h"
#include "octupole/frames/frame.h"
#include "octupole/io/cross_field_writer.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/method_names.h"
#include "octupole/view/field_scene.h"
#include "octupole/view/scene_page.h"
#include "output_files.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct SurfaceArguments {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path html;
  double feature_angle = 40;
  OpenBoundary open_boundary = OpenBoundary::kAligned;
  SolverArguments solver;
};

void PrintSummary(const SurfaceArguments& arguments, const nlohmann::ordered_json& report) {
  const auto integer = [](const nlohmann::ordered_json& value) { return value.get<int>(); };
  const auto& alignment = report["alignment"];
  std::printf("%s: %d vertices, %d faces, %d edges, Euler characteristic %d, %s\n", arguments.mesh.string().c_str(),
              integer(report["vertices"]), integer(report["faces"]), integer(report["edges"]),
              integer(report["euler_characteristic"]), report["is_closed"].get<bool>() ? "closed" : "open");
  std::printf("alignment  %d normals, %d frames, %d tangents, %d free; %d feature edges, border %s\n",
              integer(alignment["normals"]), integer(alignment["frames"]), integer(alignment["tangents"]),
              integer(alignment["free"]), integer(report["features"]["edges"]),
              report["boundary"].get<std::string>().c_str());
  std::printf("solver     %s, degree %d, %d unknowns: %s after %d iterations\n",
              report["solver"].get<std::string>().c_str(), integer(report["degree"]), integer(report["unknowns"]),
              report["termination"].get<std::string>().c_str(), integer(report["iterations"]));
  std::printf("energy     %.6g; of the frames: degree 3 %.6g, degree 4 %.6g\n", report["energy"].get<double>(),
              report["energy3"].get<double>(), report["energy4"].get<double>());
  std::string by_index;
  for (const auto& [index, count] : report["singular_faces_by_index"].items()) {
    by_index += (by_index.empty() ? " (" : ", ") + std::to_string(integer(count)) + " of index " + index;
  }
  std::printf("field      %d singular faces%s, indices sum to %g\n", integer(report["singular_faces"]),
              by_index.empty() ? "" : (by_index + ")").c_str(), report["index_sum"].get<double>());
  const auto& seconds = report["seconds"];
  std::printf("seconds    read %.2f, setup %.2f, solve %.2f, project %.2f, write %.2f\n", seconds["read"].get<double>(),
              seconds["setup"].get<double>(), seconds["solve"].get<double>(), seconds["project"].get<double>(),
              seconds["write"].get<double>());
  for (const auto* path : {&arguments.output, &arguments.html}) {
    if (!path->empty()) std::printf("written    %s\n", path->string().c_str());
  }
}

template <int kDegree>
void RunSurface(const SurfaceArguments& arguments) {
  CheckOutputs({arguments.mesh}, {{"--output", arguments.output, {".vtu"}},
                                  {"--report", arguments.report},
                                  {"--html", arguments.html, {".html", ".htm"}}});
  if (!arguments.html.empty()) CheckScenePages();
  const InterruptionGuard guard;
  Stopwatch stopwatch;
  std::vector<std::string> warnings;
  SetActivity("reading " + arguments.mesh.string());
  std::vector<int> faces;
  const TriangleMesh mesh = ReadTriangleMesh(arguments.mesh, &warnings, &faces);
  const double read_seconds = stopwatch.Lap();
  if (!arguments.solver.quiet) PrintWarnings(arguments.mesh, warnings);

  SetActivity("solving", mesh.points.size());
  Progress progress(&guard, arguments.solver.quiet);
  FieldOptions<kDegree> options;
  options.feature_angle_deg = arguments.feature_angle;
  options.open_boundary = arguments.open_boundary;
  SetSolverOptions(arguments.solver, &progress, &options);
  const std::clock_t cpu_start = std::clock();
  const Field<kDegree> field = SolveField<kDegree>(mesh, options);
  const double cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  progress.Finish();
  if (!field.IsUsable()) {
    throw std::runtime_error(arguments.mesh.string() + ": the solver failed: " +
                             (field.ceres_summary ? field.ceres_summary->message : "the energy is not finite"));
  }

  const auto edges = MeshEdges(mesh);
  double energy3 = 0, energy4 = 0;
  for (const auto& [a, b] : edges) {
    energy3 += FrameDifference<3>(field.frames[a], field.frames[b]);
    energy4 += FrameDifference<4>(field.frames[a], field.frames[b]);
  }
  const SurfaceSingularities singularities = FindSurfaceSingularities(mesh.points, mesh.triangles, field.frames);
  const std::vector<int> face_indices = QuarterIndicesOfFaces(faces, singularities.quarter_indices);
  int euler_characteristic = 0, quarter_sum = 0;
  bool is_closed = true;
  for (const SurfaceComponent& component : singularities.components) {
    euler_characteristic += component.euler_characteristic;
    quarter_sum += component.quarter_index_sum;
    is_closed &= component.is_closed;
  }
  // By index, "1/4" and so on.
  std::map<int, int> count_of_index;
  for (const int index : face_indices) {
    if (index != 0) ++count_of_index[index];
  }
  nlohmann::ordered_json by_index = nlohmann::ordered_json::object();
  int num_singular = 0;
  for (const auto& [index, count] : count_of_index) {
    by_index[std::to_string(index) + "/4"] = count;
    num_singular += count;
  }

  stopwatch.Lap();
  const std::vector<Eigen::Matrix3d> crosses = CrossField(mesh, field.frames);
  WriteCrossField(arguments.output, mesh, faces, crosses, field.alignment.alignments, face_indices);
  if (!arguments.html.empty()) {
    Scene scene = MakeSurfaceScene(arguments.mesh.filename().string(), mesh, crosses,
                                   SingularPoints(mesh.points, mesh.triangles, singularities.quarter_indices),
                                   arguments.feature_angle);
    scene.figures = {{"vertices", std::to_string(mesh.points.size())},
                     {"faces", std::to_string(face_indices.size())},
                     {"Euler characteristic", std::to_string(euler_characteristic)},
                     {"singular faces", std::to_string(num_singular)},
                     {"degree", std::to_string(kDegree)},
                     {"seed", std::to_string(arguments.solver.seed)}};
    WriteScenePage(arguments.html, {scene});
  }
  const double write_seconds = stopwatch.Lap();

  const nlohmann::ordered_json report = {
      {"mesh", arguments.mesh.string()},
      {"output", arguments.output.string()},
      {"vertices", mesh.points.size()},
      {"faces", face_indices.size()},
      {"triangles", mesh.triangles.size()},
      {"edges", edges.size()},
      {"components", singularities.components.size()},
      {"euler_characteristic", euler_characteristic},
      {"is_closed", is_closed},
      {"boundary", arguments.open_boundary == OpenBoundary::kAligned ? "aligned" : "free"},
      {"alignment", DescribeAlignment(field.alignment)},
      {"features", {{"source", "angle"}, {"edges", field.alignment.feature_edges.size()}}},
      {"warnings", warnings},
      {"degree", kDegree},
      {"seed", arguments.solver.seed},
      {"solver", arguments.solver.solver.value_or("fast")},
      {"unknowns", field.size.unknowns},
      {"termination", ceres::TerminationTypeToString(field.termination)},
      {"iterations", field.iterations.empty() ? 0 : field.iterations.back().iteration},
      {"energy", field.energy},
      {"energy3", energy3},
      {"energy4", energy4},
      {"singular_faces", num_singular},
      {"singular_faces_by_index", by_index},
      {"index_sum", quarter_sum / 4.},
      {"seconds",
       {{"read", read_seconds},
        {"setup", field.setup_seconds},
        {"solve", field.solve_seconds},
        {"project", field.project_seconds},
        {"write", write_seconds}}},
      // Of all threads, for setup, solve and project together.
      {"cpu_seconds", cpu_seconds},
  };
  WriteReport(arguments.report, report);
  if (guard.IsInterrupted()) {
    std::fprintf(stderr, "octupole: interrupted; the field reached so far is in %s\n",
                 arguments.output.string().c_str());
  }
  if (!arguments.solver.quiet) PrintSummary(arguments, report);
  guard.ExitIfInterrupted();
}

}  // namespace

void AddSurfaceCommand(CLI::App* app) {
  auto arguments = std::make_shared<SurfaceArguments>();
  CLI::App* command = app->add_subcommand("surface", "Compute a cross field on a surface mesh");
  command->add_option("mesh", arguments->mesh, ".obj, .off, .stl or .ply; triangles or polygons")
      ->required()
      ->option_text("MESH");
  command->add_option("-o,--output", arguments->output, "The field, for ParaView; by default MESH_field.vtu, here")
      ->option_text("F.vtu");
  command->add_option("--report", arguments->report, "All figures as JSON")->option_text("F.json");
  command->add_option("--html", arguments->html, "The field as a page for the browser, as by 'octupole view'")
      ->option_text("F.html");
  command->add_option("--feature-angle", arguments->feature_angle, "Between normals, above which an edge is a crease")
      ->check(CLI::Range(1., 179.))
      ->option_text("DEG [40]");
  command
      ->add_option_function<std::string>(
          "--boundary", [arguments](const std::string& name) { arguments->open_boundary = OpenBoundaryOf(name); },
          "Where the surface is open, its border: aligned or free")
      ->check(CLI::IsMember({"aligned", "free"}))
      ->option_text("NAME [aligned]");
  AddSolverArguments(command, &arguments->solver);
  command->callback([arguments] {
    if (arguments->output.empty()) arguments->output = arguments->mesh.stem().string() + "_field.vtu";
    arguments->solver.degree.value_or(3) == 3 ? RunSurface<3>(*arguments) : RunSurface<4>(*arguments);
  });
}

}  // namespace octupole
