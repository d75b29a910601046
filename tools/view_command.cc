#include "view_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "octupole/alignment/interfaces.h"
#include "octupole/field/field_quality.h"
#include "octupole/io/field_reader.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/singularities/singular_triangles.h"
#include "octupole/view/field_scene.h"
#include "octupole/view/scene_page.h"
#include "output_files.h"

namespace octupole {
namespace {

struct ViewArguments {
  std::filesystem::path field;
  std::filesystem::path singularities;
  std::filesystem::path with;
  std::filesystem::path output;
  bool quiet = false;
};

// The curves are those of the file, if one is given, or traced.
Scene LoadScene(const std::filesystem::path& path, const std::filesystem::path& singularities) {
  const FieldFile field = ReadField(path);
  const std::string title = path.filename().string();
  SingularStructure structure;
  if (!singularities.empty()) structure = ReadSingularities(singularities);
  if (field.tet_mesh.tets.empty()) {
    const TriangleMesh& mesh = field.surface;
    if (singularities.empty()) {
      structure.points =
          SingularPoints(mesh.points, mesh.triangles, QuarterIndices(mesh.points, mesh.triangles, field.frames));
    }
    Scene scene = MakeSurfaceScene(title, mesh, field.frames, structure.points);
    scene.figures = {{"vertices", std::to_string(mesh.points.size())},
                     {"triangles", std::to_string(mesh.triangles.size())},
                     {"singular points", std::to_string(structure.points.size())}};
    return scene;
  }
  const TetMesh& mesh = field.tet_mesh;
  const auto boundary = BoundaryTriangles(mesh);
  const auto singular_triangles = FindSingularTriangles(mesh, field.frames);
  if (singularities.empty()) {
    structure.curves = TraceSingularCurves(mesh, field.frames, singular_triangles);
    structure.points = SingularPoints(mesh.points, boundary, QuarterIndices(mesh.points, boundary, field.frames));
  }
  Scene scene = MakeFieldScene(title, mesh, field.frames, FindInterfaces(mesh, boundary).triangles, structure.curves,
                               structure.points);
  scene.figures = FieldFigures(mesh, MeasureField(mesh, field.frames, singular_triangles, boundary), structure.curves,
                               structure.points);
  return scene;
}

void RunView(const ViewArguments& arguments) {
  std::vector<std::filesystem::path> inputs = {arguments.field};
  for (const auto* file : {&arguments.singularities, &arguments.with}) {
    if (!file->empty()) inputs.push_back(*file);
  }
  CheckOutputs(inputs, {{"--output", arguments.output, {".html", ".htm"}}});
  CheckScenePages();
  std::vector<Scene> scenes = {LoadScene(arguments.field, arguments.singularities)};
  if (!arguments.with.empty()) scenes.push_back(LoadScene(arguments.with, {}));
  WriteScenePage(arguments.output, scenes);
  if (!arguments.quiet) std::printf("written    %s; open it in a browser\n", arguments.output.string().c_str());
}

}  // namespace

void AddViewCommand(CLI::App* app) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app->add_subcommand("view", "Write a field as a page for the browser");
  command->add_option("field", arguments->field, "The field, as 'octupole field' or 'octupole surface' wrote it")
      ->required()
      ->option_text("FIELD.vtu");
  command
      ->add_option("--singularities", arguments->singularities,
                   "Its singular curves, as --singularities of 'octupole field' wrote them; by default they are traced")
      ->option_text("C.vtu");
  command->add_option("--with", arguments->with, "Another field beside it, under the same camera and cut")
      ->option_text("OTHER.vtu");
  command->add_option("-o,--output", arguments->output, "The page; by default FIELD.html, here")->option_text("F.html");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([arguments] {
    if (arguments->output.empty()) arguments->output = arguments->field.stem().string() + ".html";
    RunView(*arguments);
  });
}

}  // namespace octupole
