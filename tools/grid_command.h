#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole grid`: a frame field in the solid that a surface bounds, on a grid, written as .vtu, with a report as
/// .json.
void AddGridCommand(CLI::App* app);

}  // namespace octupole
