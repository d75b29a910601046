#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

/// Adds `octupole view FIELD.vtu -o F.html`.
void AddViewCommand(CLI::App* app);

}  // namespace octupole
