#pragma once

#include <CLI/CLI.hpp>

namespace octupole {

void AddSampleCommand(CLI::App* app);

}  // namespace octupole
