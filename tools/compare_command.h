#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole compare`: methods beside each other on the caller's meshes, as a table, CSV and JSON. Each run is a
/// process of its own, `octupole field`, so that peak memory is that of the method.
void AddCompareCommand(CLI::App* app);

}  // namespace octupole
