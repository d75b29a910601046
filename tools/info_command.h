#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole info`: what a mesh file holds and what is odd about it.
void AddInfoCommand(CLI::App* app);

}  // namespace octupole
