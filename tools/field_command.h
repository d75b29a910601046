#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole field`: a frame field on a tet mesh, written as .vtu, with a report as .json.
void AddFieldCommand(CLI::App* app);

}  // namespace octupole
