#include "info_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "activity.h"
#include "octupole/field/mesh_summary.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "output_files.h"

namespace octupole {
namespace {

using nlohmann::ordered_json;

struct InfoArguments {
  std::filesystem::path mesh;
  std::filesystem::path report;
  bool quiet = false;
};

ordered_json DescribeRegions(const MeshSummary& summary) {
  ordered_json regions = ordered_json::array();
  for (const auto& [tag, count] : summary.tets_of_region) regions.push_back({{"tag", tag}, {"tets", count}});
  return regions;
}

ordered_json DescribeShells(const MeshSummary& summary) {
  ordered_json shells = ordered_json::array();
  for (const SurfaceComponent& shell : summary.shells) {
    shells.push_back({{"triangles", shell.triangles}, {"euler_characteristic", shell.euler_characteristic}});
    if (shell.is_closed) {
      shells.back()["genus"] = shell.genus();
    } else {
      shells.back()["genus"] = nullptr;
    }
  }
  return shells;
}

ordered_json Describe(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  SetActivity("reading " + path.string());
  const TetMesh mesh = ReadTetMesh(path, &warnings);
  SetActivity("looking at the mesh", mesh.points.size());
  const MeshSummary summary = SummarizeMesh(mesh);
  const MeshInspection& inspection = summary.inspection;
  for (std::string& warning : MeshWarnings(inspection)) warnings.push_back(std::move(warning));
  for (std::string& warning : InterfaceWarningsOfTool(summary.interfaces)) warnings.push_back(std::move(warning));
  return {
      {"mesh", path.string()},
      {"vertices", summary.vertices},
      {"edges", summary.edges},
      {"triangles", summary.triangles},
      {"tets", inspection.tets},
      {"bounding_box", {{"min", summary.bounding_box.min()}, {"max", summary.bounding_box.max()}}},
      {"regions", DescribeRegions(summary)},
      {"components", inspection.components},
      {"boundary_triangles", summary.boundary_triangles},
      {"boundary_components", DescribeShells(summary)},
      {"features",
       {{"marked_edges", mesh.feature_edges.size()},
        {"marked_points", mesh.feature_points.size()},
        {"seams", summary.seams},
        {"sharp_edges", summary.sharp_edges}}},
      {"interfaces", DescribeInterfaces(summary.interfaces)},
      {"mean_ratio",
       {{"min", summary.least_mean_ratio}, {"mean", summary.average_mean_ratio}, {"max", summary.largest_mean_ratio}}},
      {"inverted_tets", inspection.inverted_tets},
      {"zero_volume_tets", inspection.zero_volume_tets},
      {"duplicate_tets", inspection.duplicate_tets},
      {"isolated_vertices", inspection.isolated_vertices},
      {"duplicate_vertices", inspection.duplicate_vertices},
      {"overfull_triangles", inspection.overfull_triangles},
      {"non_manifold_boundary_edges", inspection.non_manifold_boundary_edges},
      {"warnings", warnings}};
}

// A list of at most a few items: a mesh may have thousands of regions or shells.
class Enumeration {
 public:
  void Add(const std::string& item) {
    constexpr int kMaxItems = 6;
    if (++count_ <= kMaxItems) text_ += (count_ > 1 ? ", " : "") + item;
    if (count_ == kMaxItems + 1) text_ += ", ...";
  }
  const char* text() const { return text_.c_str(); }

 private:
  std::string text_;
  int count_ = 0;
};

void Print(const ordered_json& info) {
  const auto count = [](const ordered_json& object, const char* key) { return object.at(key).get<long long>(); };
  std::printf("%s: %lld vertices, %lld edges, %lld triangles, %lld tets\n", info["mesh"].get<std::string>().c_str(),
              count(info, "vertices"), count(info, "edges"), count(info, "triangles"), count(info, "tets"));
  const auto& min = info["bounding_box"]["min"];
  const auto& max = info["bounding_box"]["max"];
  std::printf("box         %.6g..%.6g, %.6g..%.6g, %.6g..%.6g\n", min[0].get<double>(), max[0].get<double>(),
              min[1].get<double>(), max[1].get<double>(), min[2].get<double>(), max[2].get<double>());
  Enumeration regions, shells;
  for (const auto& region : info["regions"]) {
    regions.Add(std::to_string(count(region, "tag")) + " (" + std::to_string(count(region, "tets")) + " tets)");
  }
  std::printf("regions     %zu%s%s\n", info["regions"].size(), info["regions"].empty() ? "" : ": ", regions.text());
  for (const auto& shell : info["boundary_components"]) {
    shells.Add(shell["genus"].is_null() ? "not closed" : "genus " + std::to_string(count(shell, "genus")));
  }
  std::printf("components  %lld; boundary %zu: %s; %lld triangles\n", count(info, "components"),
              info["boundary_components"].size(), shells.text(), count(info, "boundary_triangles"));
  const auto& features = info["features"];
  std::printf("features    %lld edges (%lld of seams) and %lld points marked; %lld edges sharper than 40 degrees\n",
              count(features, "marked_edges"), count(features, "seams"), count(features, "marked_points"),
              count(features, "sharp_edges"));
  if (const auto& interfaces = info["interfaces"]; interfaces["faces"] > 0) {
    std::printf("interfaces  %lld faces: %lld between regions, %lld tagged\n", count(interfaces, "faces"),
                interfaces["between_regions"]["followed"] ? count(interfaces["between_regions"], "faces") : 0,
                interfaces["tagged"]["followed"] ? count(interfaces["tagged"], "faces") : 0);
  }
  const auto& quality = info["mean_ratio"];
  std::printf("quality     mean ratio %.3f, least %.3f, largest %.3f\n", quality["mean"].get<double>(),
              quality["min"].get<double>(), quality["max"].get<double>());
  for (const auto& warning : info["warnings"]) std::printf("warning     %s\n", warning.get<std::string>().c_str());
  if (info["warnings"].empty()) std::printf("nothing odd\n");
}

}  // namespace

void AddInfoCommand(CLI::App* app) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = app->add_subcommand("info", "Say what a tet mesh holds and what is odd about it");
  command->add_option("mesh", arguments->mesh, "As for field")->required()->option_text("MESH");
  command->add_option("--report", arguments->report, "The same as JSON")->option_text("F.json");
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback([arguments] {
    CheckOutputs(TetMeshFiles(arguments->mesh), {{"--report", arguments->report}});
    const ordered_json info = Describe(arguments->mesh);
    WriteReport(arguments->report, info);
    if (!arguments->quiet) Print(info);
  });
}

}  // namespace octupole
