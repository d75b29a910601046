#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "octupole/field/boundary_alignment.h"

namespace octupole {

/// Throws std::runtime_error when there is no folder for a file that is to be written: to be asked before minutes are
/// spent on solving. The empty path, no file, passes.
void CheckFolderOf(const std::filesystem::path& file);

/// Writes a report as JSON; nothing where the path is empty.
void WriteReport(const std::filesystem::path& file, const nlohmann::ordered_json& report);

/// The section "alignment" of a report.
nlohmann::ordered_json DescribeAlignment(const BoundaryAlignment& alignment);

}  // namespace octupole
