#include <ceres/version.h>
#include <glog/logging.h>
#include <zlib.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "activity.h"
#include "compare_command.h"
#include "field_command.h"
#include "info_command.h"
#include "large_pages.h"
#include "map_command.h"
#include "octupole/version.h"
#include "sample_command.h"
#ifdef OCTUPOLE_WITH_OPENMESH
#include <OpenMesh/Core/System/config.h>

#include "surface_command.h"
#ifdef OCTUPOLE_WITH_OPENVDB
#include "grid_command.h"
#endif
#endif
#ifdef OCTUPOLE_WITH_GMSH
#include <gmsh.h>
#endif
#include "view_command.h"

namespace octupole {
namespace {

// Our version, and those of the libraries that this program was built with.
std::string Versions() {
  const auto dotted = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  std::string versions = std::string("octupole ") + kVersion + "\nCeres " CERES_VERSION_STRING "\nEigen " +
                         dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) + "\nCLI11 " +
                         CLI11_VERSION + "\nnlohmann-json " +
                         dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH) +
                         "\nzlib " ZLIB_VERSION;
#ifdef OCTUPOLE_WITH_OPENMESH
  versions += "\nOpenMesh " + dotted(OM_GET_VER, OM_GET_MAJ, OM_GET_MIN);
#endif
#ifdef OCTUPOLE_WITH_GMSH
  versions += "\ngmsh " GMSH_API_VERSION;
#endif
  return versions;
}

void Run(int argc, char** argv, CLI::App* app) {
  // What Ceres has to say comes out through the same log as what we have to say.
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::WARNING;
  google::InitGoogleLogging("octupole");
  // A file that grows too large is an error like any other; the signal would leave the temporary file behind.
  std::signal(SIGXFSZ, SIG_IGN);

  app->set_version_flag("--version", Versions());
  app->require_subcommand(1);
  AddFieldCommand(app);
  AddInfoCommand(app);
  AddCompareCommand(app);
  AddSampleCommand(app);
  AddMapCommand(app);
#ifdef OCTUPOLE_WITH_OPENMESH
  AddSurfaceCommand(app);
#ifdef OCTUPOLE_WITH_OPENVDB
  AddGridCommand(app);
#endif
#endif
  AddViewCommand(app);
  // Commands run as CLI11 callbacks, so whatever they throw comes out of parse().
  app->parse(argc, argv);
}

}  // namespace
}  // namespace octupole

// NOLINTNEXTLINE(bugprone-exception-escape): only where the standard streams or the handlers themselves fail
int main(int argc, char** argv) {
  octupole::UseLargePages(argc, argv);
  CLI::App app("Frame fields on tetrahedral meshes and on surfaces.", "octupole");
  try {
    octupole::Run(argc, argv, &app);
  } catch (const CLI::RuntimeError& interruption) {
    return interruption.get_exit_code();
  } catch (const CLI::ParseError& error) {
    constexpr int kUsageError = 2;
    return app.exit(error) == 0 ? 0 : kUsageError;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "octupole: %s\n", octupole::OutOfMemoryMessage().c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "octupole: %s\n", error.what());
    return 1;
  }
  return 0;
}
