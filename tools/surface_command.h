#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole surface`: a cross field on a surface, written as .vtu, with a report as .json.
void AddSurfaceCommand(CLI::App* app);

}  // namespace octupole
