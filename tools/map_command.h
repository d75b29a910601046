#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole map`: a seamless map of a tet mesh, written as .hexex, with a report as .json.
void AddMapCommand(CLI::App* app);

}  // namespace octupole
