#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "compare_command.h"
#include "field_command.h"
#include "info_command.h"
#ifdef OCTUPOLE_WITH_OPENMESH
#include "surface_command.h"
#endif

int main(int argc, char** argv) {
  CLI::App app("Frame fields on tetrahedral meshes and on surfaces.", "octupole");
  app.set_version_flag("--version", OCTUPOLE_VERSION);
  app.require_subcommand(1);
  octupole::AddFieldCommand(&app);
  octupole::AddInfoCommand(&app);
  octupole::AddCompareCommand(&app);
#ifdef OCTUPOLE_WITH_OPENMESH
  octupole::AddSurfaceCommand(&app);
#endif
  // Commands run as CLI11 callbacks, so whatever they throw comes out of parse().
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    constexpr int kUsageError = 2;
    return app.exit(error) == 0 ? 0 : kUsageError;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "octupole: %s\n", error.what());
    return 1;
  }
  return 0;
}
