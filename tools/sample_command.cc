#include "sample_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "octupole/field/field_sampler.h"
#include "octupole/io/field_reader.h"
#include "octupole/io/sample_files.h"
#include "output_files.h"
#include "solver_arguments.h"

namespace octupole {
namespace {

struct SampleArguments {
  std::filesystem::path field;
  std::filesystem::path points;
  std::filesystem::path output;
  bool cells = false;
  bool quiet = false;
};

void RunSample(const SampleArguments& arguments) {
  CheckOutputs({arguments.field, arguments.points}, {{"--output", arguments.output, {".vtu", ".csv"}}});
  Stopwatch stopwatch;
  const FieldFile field = ReadField(arguments.field);
  const std::vector<Eigen::Vector3d> points =
      arguments.cells ? ReadCellCenters(arguments.points) : ReadPoints(arguments.points);
  const double read_seconds = stopwatch.Lap();
  const FieldSampler sampler(field.tet_mesh, field.frames);
  const double build_seconds = stopwatch.Lap();
  const FieldSamples samples = sampler.Sample(points);
  const double sample_seconds = stopwatch.Lap();
  WriteSamples(arguments.output, points, samples);
  const double write_seconds = stopwatch.Lap();
  if (arguments.quiet) return;
  const auto num_outside = std::count(samples.is_inside.begin(), samples.is_inside.end(), 0);
  std::printf("%s: %zu points, %td of them outside: the frames of the nearest boundary points\n",
              arguments.points.string().c_str(), points.size(), num_outside);
  std::printf("seconds    read %.2f, build %.2f, sample %.2f, write %.2f\n", read_seconds, build_seconds,
              sample_seconds, write_seconds);
  std::printf("written    %s\n", arguments.output.string().c_str());
}

}  // namespace

void AddSampleCommand(CLI::App* app) {
  auto arguments = std::make_shared<SampleArguments>();
  CLI::App* command = app->add_subcommand("sample", "Give the frames of a field at any points");
  command->add_option("field", arguments->field, "As octupole field writes it")->required()->option_text("FIELD.vtu");
  command
      ->add_option("points", arguments->points,
                   ".csv, .txt or .xyz with x, y, z in each line, or any mesh, tetrahedral or not: its vertices")
      ->required()
      ->option_text("POINTS_OR_MESH");
  command->add_option("-o,--output", arguments->output, "The frames at the points")
      ->required()
      ->option_text("F.vtu|F.csv");
  command->add_flag("--cells", arguments->cells, "At the centres of the mesh's cells, hexahedra included");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([arguments] { RunSample(*arguments); });
}

}  // namespace octupole
