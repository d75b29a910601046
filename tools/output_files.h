#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/alignment/constraints.h"

namespace octupole {

/// A file that a command is to write, if its path is not empty.
struct OutputFile {
  /// That names it on the command line.
  const char* option;
  std::filesystem::path path;
  /// If not empty, the path must have one of these.
  std::vector<std::string> endings = {};
};

/// To be asked before anything is read and minutes are spent on solving.
/// \throw std::runtime_error when an output has no folder or an ending that is not known, or is the same file as an
/// input or another output, by whatever names and links.
void CheckOutputs(const std::vector<std::filesystem::path>& inputs, const std::vector<OutputFile>& outputs);

/// Writes a report as JSON; nothing where the path is empty.
void WriteReport(const std::filesystem::path& file, const nlohmann::ordered_json& report);

/// The section "alignment" of a report.
nlohmann::ordered_json DescribeAlignment(const AlignmentCounts& counts);

/// The section "interfaces" of a report: their faces and what they came from.
nlohmann::ordered_json DescribeInterfaces(const Interfaces& interfaces);

/// InterfaceWarnings, with how to override what they say.
std::vector<std::string> InterfaceWarningsOfTool(const Interfaces& interfaces);

/// The section "constraints" of a report.
nlohmann::ordered_json DescribeConstraints(const ConstraintSummary& constraints);

}  // namespace octupole
