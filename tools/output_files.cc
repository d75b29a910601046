#include "output_files.h"

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <system_error>

#include "octupole/io/atomic_file.h"

namespace octupole {
namespace {

using std::filesystem::path;

// Whether both names lead to one file, or would, were there any.
bool AreSame(const path& a, const path& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  const auto place = [&](const path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(FollowLinks(file)), ignored);
  };
  return place(a) == place(b);
}

void CheckEnding(const OutputFile& output) {
  const std::vector<std::string>& endings = output.endings;
  if (endings.empty() || std::count(endings.begin(), endings.end(), output.path.extension()) > 0) return;
  std::string known;
  for (const std::string& ending : endings) known += (known.empty() ? "" : " or ") + ending;
  throw std::runtime_error(output.path.string() + ": " + output.option + " writes " + known + " files only");
}

}  // namespace

void CheckOutputs(const std::vector<path>& inputs, const std::vector<OutputFile>& outputs) {
  for (const OutputFile& output : outputs) {
    if (output.path.empty()) continue;
    const path folder = output.path.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
      throw std::runtime_error(output.path.string() + ": there is no folder " + folder.string());
    }
    CheckEnding(output);
    for (const path& input : inputs) {
      if (!AreSame(input, output.path)) continue;
      throw std::runtime_error(output.path.string() + ": " + output.option + " would overwrite the input " +
                               input.string());
    }
    for (const OutputFile* other = outputs.data(); other != &output; ++other) {
      if (other->path.empty() || !AreSame(other->path, output.path)) continue;
      throw std::runtime_error(output.path.string() + ": " + output.option + " and " + other->option + " are one file");
    }
  }
}

void WriteReport(const path& file, const nlohmann::ordered_json& report) {
  if (file.empty()) return;
  WriteFileAtomically(file, [&](std::ostream& stream) { stream << report.dump(2) << "\n"; });
}

nlohmann::ordered_json DescribeAlignment(const AlignmentCounts& counts) {
  return {{"normals", counts.num_normals},
          {"frames", counts.num_frames},
          {"tangents", counts.num_tangents},
          {"free", counts.num_free}};
}

nlohmann::ordered_json DescribeInterfaces(const Interfaces& interfaces) {
  const auto describe = [](const InnerFaces& faces) -> nlohmann::ordered_json {
    return {{"faces", faces.count}, {"fitting_share", faces.fitting_share}, {"followed", faces.are_followed}};
  };
  return {{"faces", interfaces.triangles.size()},
          {"between_regions", describe(interfaces.between_regions)},
          {"tagged", describe(interfaces.tagged)}};
}

std::vector<std::string> InterfaceWarningsOfTool(const Interfaces& interfaces) {
  std::vector<std::string> warnings = InterfaceWarnings(interfaces);
  for (std::string& warning : warnings) warning += " (--follow-regions follows all, --ignore-regions none)";
  return warnings;
}

nlohmann::ordered_json DescribeConstraints(const ConstraintSummary& constraints) {
  return {{"axes", constraints.num_axes},
          {"frames", constraints.num_frames},
          {"contradictions", constraints.num_contradictions},
          {"largest_contradiction_deg", constraints.largest_contradiction_deg}};
}

}  // namespace octupole
