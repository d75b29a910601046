#include "field_command.h"

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
#include "octupole/alignment/aligned_frame.h"
#include "octupole/field/field_quality.h"
#include "octupole/field/field_sampler.h"
#include "octupole/field/tet_frames.h"
#include "octupole/io/constraint_reader.h"
#include "octupole/io/field_reader.h"
#include "octupole/io/field_writer.h"
#include "octupole/io/singularity_writer.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/method_names.h"
#include "octupole/view/field_scene.h"
#include "octupole/view/scene_page.h"
#ifdef OCTUPOLE_WITH_GMSH
#include "octupole/adaptors/cad_mesher.h"
#endif
#include "output_files.h"
#include "singularity_report.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct FieldArguments {
  std::filesystem::path mesh;
  /// Of the tets, where the mesh is a CAD model.
  std::optional<double> size;
  std::filesystem::path output;
  std::filesystem::path report;
  std::filesystem::path fra;
  std::filesystem::path quaternions;
  std::filesystem::path singularities;
  std::filesystem::path html;
  FieldMethod method = FieldMethod::kPenalty;
  /// Its degree is by default 3, and 4 for the methods that know no other.
  SolverArguments solver;
  AlignmentArguments alignment;
  std::filesystem::path constraints;
  /// If given, the constraints are soft.
  std::optional<double> constraint_weight;
  /// An earlier field.
  std::filesystem::path start;
};

TetMesh LoadMesh(const FieldArguments& arguments, std::vector<std::string>* warnings) {
#ifdef OCTUPOLE_WITH_GMSH
  if (arguments.size) return MeshCadModel(arguments.mesh, *arguments.size);
  if (IsCadModel(arguments.mesh)) {
    throw std::runtime_error(arguments.mesh.string() + ": a CAD model needs the size of its tets, --size");
  }
#else
  if (arguments.size) {
    throw std::runtime_error(
        "--size is for CAD models, which this build does not read: configure it with "
        "-D OCTUPOLE_WITH_GMSH=ON");
  }
#endif
  return ReadTetMesh(arguments.mesh, warnings);
}

void PrintSummary(const FieldArguments& arguments, const nlohmann::ordered_json& report) {
  const auto number = [&](const char* key) { return report[key].get<double>(); };
  const auto& alignment = report["alignment"];
  std::printf("%s: %d vertices, %d tets, %d edges\n", arguments.mesh.string().c_str(), report["vertices"].get<int>(),
              report["tets"].get<int>(), report["edges"].get<int>());
  std::printf("boundary   %d normals, %d frames, %d tangents, %d free\n", alignment["normals"].get<int>(),
              alignment["frames"].get<int>(), alignment["tangents"].get<int>(), alignment["free"].get<int>());
  const auto& features = report["features"];
  const bool are_marked = features["source"] == "marked";
  std::printf("features   %d edges%s, %s\n", features["edges"].get<int>(),
              are_marked ? (" and " + std::to_string(features["points"].get<int>()) + " points").c_str() : "",
              are_marked ? "marked in the mesh" : "by their angle");
  if (const auto& interfaces = report["interfaces"]; interfaces["faces"] > 0) {
    std::printf("interfaces %d faces; %d normals, %d frames, %d tangents, %d free; error %.2g degrees\n",
                interfaces["faces"].get<int>(), interfaces["normals"].get<int>(), interfaces["frames"].get<int>(),
                interfaces["tangents"].get<int>(), interfaces["free"].get<int>(),
                interfaces["max_error_deg"].get<double>());
  }
  if (!arguments.constraints.empty()) {
    const auto& constraints = report["constraints"];
    std::printf("prescribed %d axes, %d frames; %d contradict the boundary, by up to %.2g degrees\n",
                constraints["axes"].get<int>(), constraints["frames"].get<int>(),
                constraints["contradictions"].get<int>(), constraints["largest_contradiction_deg"].get<double>());
  }
  std::string method = report["method"];
  if (report.contains("solver")) method += ", " + report["solver"].get<std::string>();
  std::printf("method     %s, degree %d, %d unknowns: %s after %d iterations\n", method.c_str(),
              report["degree"].get<int>(), report["unknowns"].get<int>(),
              report["termination"].get<std::string>().c_str(), report["iterations"].get<int>());
  std::printf("energy     %.6g; of the frames: degree 3 %.6g, degree 4 %.6g\n", number("energy"), number("energy3"),
              number("energy4"));
  std::printf("field      %d singular triangles, boundary error %.2g degrees (largest %.2g)\n",
              report["singular_triangles"].get<int>(), number("boundary_rms_deg"), number("boundary_max_deg"));
  std::printf("singular   %s\n", SummaryOf(report["singular_structure"]).c_str());
  const auto& seconds = report["seconds"];
  std::printf("seconds    read %.2f, setup %.2f, solve %.2f, project %.2f, write %.2f\n", seconds["read"].get<double>(),
              seconds["setup"].get<double>(), seconds["solve"].get<double>(), seconds["project"].get<double>(),
              seconds["write"].get<double>());
  for (const auto* file :
       {&arguments.output, &arguments.fra, &arguments.quaternions, &arguments.singularities, &arguments.html}) {
    if (!file->empty()) std::printf("written    %s\n", file->string().c_str());
  }
}

template <int kDegree>
void RunField(const FieldArguments& arguments) {
  std::vector<std::filesystem::path> inputs = TetMeshFiles(arguments.mesh);
  for (const auto* file : {&arguments.constraints, &arguments.start}) {
    if (!file->empty()) inputs.push_back(*file);
  }
  CheckOutputs(inputs, {{"--output", arguments.output, {".vtu"}},
                        {"--singularities", arguments.singularities, {".vtu"}},
                        {"--report", arguments.report},
                        {"--fra", arguments.fra},
                        {"--quaternions", arguments.quaternions},
                        {"--html", arguments.html, {".html", ".htm"}}});
  if (!arguments.html.empty()) CheckScenePages();
  const InterruptionGuard guard;
  Stopwatch stopwatch;
  std::vector<std::string> warnings;
  SetActivity("reading " + arguments.mesh.string());
  TetMesh mesh = LoadMesh(arguments, &warnings);
  SetActivity("solving", mesh.points.size());
  for (std::string& warning : MeshWarnings(InspectMesh(mesh))) warnings.push_back(std::move(warning));
  const double read_seconds = stopwatch.Lap();
  if (!arguments.solver.quiet) PrintWarnings(arguments.mesh, warnings);

  Progress progress(&guard, arguments.solver.quiet);
  FieldOptions<kDegree> options;
  if (arguments.alignment.feature_angle) {
    options.feature_angle_deg = *arguments.alignment.feature_angle;
    mesh.feature_edges.clear();
    mesh.feature_points.clear();
  }
  options.method = arguments.method;
  options.regions = arguments.alignment.regions;
  options.edge_weights = arguments.alignment.weights;
  SetSolverOptions(arguments.solver, &progress, &options);
  if (!arguments.constraints.empty()) options.constraints = ReadConstraints(arguments.constraints, mesh.points.size());
  options.constraint_weight = arguments.constraint_weight;
  if (!arguments.start.empty()) {
    const FieldFile start = ReadField(arguments.start);
    options.start_frames = TransferFrames(start.tet_mesh, start.frames, mesh.points);
  }
  const std::clock_t cpu_start = std::clock();
  const Field<kDegree> field = SolveField<kDegree>(mesh, options);
  const double cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  progress.Finish();
  if (!field.IsUsable()) {
    throw std::runtime_error(arguments.mesh.string() + ": the solver failed: " +
                             (field.ceres_summary ? field.ceres_summary->message : "the energy is not finite"));
  }
  SetActivity("measuring and writing the field", mesh.points.size());
  const Interfaces& interfaces = field.alignment.interfaces;
  if (const auto more = InterfaceWarningsOfTool(interfaces); !more.empty()) {
    if (!arguments.solver.quiet) PrintWarnings(arguments.mesh, more);
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  nlohmann::ordered_json interface_report = DescribeInterfaces(interfaces);
  interface_report.update(DescribeAlignment(field.alignment.interface_vertices));
  interface_report["max_error_deg"] = MeasureNormals(mesh.points, interfaces.triangles, field.frames).max_deg;
  const auto& boundary = field.alignment.boundary_triangles;
  const auto singular_triangles = FindSingularTriangles(mesh, field.frames);
  const FieldQuality quality = MeasureField(mesh, field.frames, singular_triangles, boundary);
  const SingularCurves curves = TraceSingularCurves(mesh, field.frames, singular_triangles);
  const SurfaceSingularities surface = FindSurfaceSingularities(mesh.points, boundary, field.frames);

  stopwatch.Lap();
  WriteField<kDegree>(arguments.output, mesh, field.coefficients, field.frames, field.alignment.alignments);
  if (!arguments.fra.empty()) WriteFra(arguments.fra, TetFrames(mesh, field.frames));
  if (!arguments.quaternions.empty()) WriteQuaternions(arguments.quaternions, field.frames);
  if (!arguments.singularities.empty()) {
    WriteSingularities(arguments.singularities, curves, mesh.points, boundary, surface.quarter_indices);
  }
  if (!arguments.html.empty()) {
    const auto points = SingularPoints(mesh.points, boundary, surface.quarter_indices);
    Scene scene = MakeFieldScene(arguments.mesh.filename().string(), mesh, field.frames,
                                 field.alignment.interfaces.triangles, curves, points, options.feature_angle_deg);
    scene.figures = FieldFigures(mesh, quality, curves, points);
    scene.figures.insert(scene.figures.end(), {{"method", NameOf(arguments.method)},
                                               {"degree", std::to_string(kDegree)},
                                               {"seed", std::to_string(arguments.solver.seed)},
                                               {"seconds to solve", TwoDecimals(field.solve_seconds)}});
    WriteScenePage(arguments.html, {scene});
  }
  const double write_seconds = stopwatch.Lap();

  nlohmann::ordered_json report = {
      {"mesh", arguments.mesh.string()},
      {"output", arguments.output.string()},
      {"vertices", mesh.points.size()},
      {"tets", mesh.tets.size()},
      {"edges", quality.edges},
      {"alignment", DescribeAlignment(field.alignment)},
      {"features",
       {{"source", field.alignment.has_marked_features ? "marked" : "angle"},
        {"edges", field.alignment.feature_edges.size()},
        {"seams", field.alignment.num_seam_edges},
        {"points", mesh.feature_points.size()}}},
      {"interfaces", interface_report},
      {"warnings", warnings},
      {"constraints", DescribeConstraints(field.constraints)},
      {"weights", arguments.alignment.weights == EdgeWeights::kUniform ? "uniform" : "fem"},
      {"start", arguments.start.string()},
      {"method", NameOf(arguments.method)},
      {"degree", kDegree},
      {"seed", arguments.solver.seed},
      {"unknowns", field.size.unknowns},
      {"nonzeros", field.size.nonzeros},
      {"termination", ceres::TerminationTypeToString(field.termination)},
      {"iterations", field.iterations.empty() ? 0 : field.iterations.back().iteration},
      {"energy", field.energy},
      {"energy3", quality.energy3},
      {"energy4", quality.energy4},
      // Where alignment is soft, of the nearest frames that keep to it: to compare with the others.
      {"energy4_aligned", arguments.method == FieldMethod::kHuang
                              ? MeasureField(mesh, AlignFrames(field.alignment.alignments, field.frames)).energy4
                              : quality.energy4},
      {"boundary_rms_deg", quality.boundary_rms_deg},
      {"boundary_max_deg", quality.boundary_max_deg},
      {"singular_triangles", quality.singular_triangles},
      {"singular_triangles_by_type", CountsByType(quality)},
      {"singular_structure", SingularStructureReport(curves, surface)},
      {"seconds",
       {{"read", read_seconds},
        {"setup", field.setup_seconds},
        {"solve", field.solve_seconds},
        {"project", field.project_seconds},
        {"write", write_seconds}}},
      // Of all threads, for setup, solve and project together.
      {"cpu_seconds", cpu_seconds},
  };
  if (arguments.method == FieldMethod::kPenalty) report["solver"] = arguments.solver.solver.value_or("fast");
  if (!arguments.report.empty()) report["energy4_fem"] = FiniteElementEnergy(mesh, field.frames);
  WriteReport(arguments.report, report);
  if (guard.IsInterrupted()) {
    std::fprintf(stderr, "octupole: interrupted; the field reached so far is in %s\n",
                 arguments.output.string().c_str());
  }
  if (!arguments.solver.quiet) PrintSummary(arguments, report);
  guard.ExitIfInterrupted();
}

}  // namespace

void AddFieldCommand(CLI::App* app) {
  auto arguments = std::make_shared<FieldArguments>();
  CLI::App* command = app->add_subcommand("field", "Compute a frame field on a tet mesh");
  command
      ->add_option("mesh", arguments->mesh,
                   ".mesh (Medit), .vtk, .vtu, .msh (Gmsh), .node/.ele (TetGen), .ovm (OpenVolumeMesh) or .tet")
      ->required()
      ->option_text("MESH");
  command->add_option("--size", arguments->size, "Of the tets that a CAD model (STEP, IGES, BREP) is meshed with")
      ->check(AboveZero())
      ->option_text("H");
  command->add_option("-o,--output", arguments->output, "The field, for ParaView; by default MESH_field.vtu, here")
      ->option_text("F.vtu");
  command->add_option("--report", arguments->report, "All figures as JSON")->option_text("F.json");
  command->add_option("--fra", arguments->fra, "One frame per tet as text, for hexahedral meshers")
      ->option_text("F.fra");
  command->add_option("--quaternions", arguments->quaternions, "One frame per vertex as text: w x y z")
      ->option_text("F.txt");
  command->add_option("--singularities", arguments->singularities, "Singular curves and points as lines and vertices")
      ->option_text("F.vtu");
  command->add_option("--html", arguments->html, "The field as a page for the browser, as by 'octupole view'")
      ->option_text("F.html");
  command
      ->add_option_function<std::string>(
          "--method", [arguments](const std::string& name) { arguments->method = FieldMethodOf(name); },
          "penalty, or of the classics in degree 4 ray-sokolov, huang or mbo")
      ->check(CLI::IsMember({"penalty", "ray-sokolov", "huang", "mbo"}))
      ->option_text("NAME [penalty]");
  AddAlignmentArguments(command, &arguments->alignment);
  command
      ->add_option(
          "--constraints", arguments->constraints,
          "Prescribed axes and frames: lines vertex,x,y,z[,x,y,z[,x,y,z]], or point arrays constraint_axis and "
          "constraint_axis_2")
      ->option_text("F.csv|F.vtu");
  command
      ->add_option("--constraint-weight", arguments->constraint_weight,
                   "Keep to the constraints softly, with this weight; with Ceres' solvers only")
      ->check(AtLeastZero())
      ->option_text("W");
  command
      ->add_option(
          "--start", arguments->start,
          "An earlier field, of this mesh or another, to begin with: for small changes, in a fraction of the time")
      ->option_text("FIELD.vtu");
  AddSolverArguments(command, &arguments->solver);
  command->callback([arguments] {
    if (arguments->output.empty()) arguments->output = arguments->mesh.stem().string() + "_field.vtu";
    const bool is_classic = arguments->method != FieldMethod::kPenalty;
    if (is_classic && arguments->solver.solver) {
      throw CLI::ValidationError("--solver", "only for --method penalty, not for " + NameOf(arguments->method));
    }
    if (is_classic && !arguments->start.empty()) {
      throw CLI::ValidationError("--start", "only for --method penalty, not for " + NameOf(arguments->method));
    }
    if (arguments->constraint_weight && arguments->solver.solver.value_or("fast") == "fast") {
      throw CLI::ValidationError("--constraint-weight", "only with a --solver of Ceres: cholesky, cgnr or lbfgs");
    }
    if (is_classic && arguments->solver.degree == 3) {
      throw CLI::ValidationError("--degree", NameOf(arguments->method) + " knows degree 4 only");
    }
    arguments->solver.degree.value_or(is_classic ? 4 : 3) == 3 ? RunField<3>(*arguments) : RunField<4>(*arguments);
  });
}

}  // namespace octupole
