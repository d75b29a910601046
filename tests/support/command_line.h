#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "test_files.h"

// How tests run the octupole command, OCTUPOLE_COMMAND, as a user does.

namespace octupole {

struct Outcome {
  int exit_code;  // -1 when a signal ended it
  std::string out;
  std::string err;
};

inline std::string Quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

inline Outcome Shell(const std::string& command) {
  const TemporaryFolder folder;
  const int status =
      std::system((command + " </dev/null >" + Quoted(folder / "out") + " 2>" + Quoted(folder / "err")).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadText(folder / "out"), ReadText(folder / "err")};
}

/// To write before a command: sends it SIGINT or SIGTERM half a second after it has begun to catch them, however long
/// it takes to start on a busy machine. Ends as the command ends.
inline std::string Interrupting(const std::string& signal) {
  return "sh -c '\"$@\" & command=$!; "
         // The signals that a process catches, as bits: 2 is SIGINT.
         "while kill -0 $command && ! grep -q \"^SigCgt:.*[2367abef]$\" /proc/$command/status; do sleep 0.05; done; "
         "sleep 0.5; kill -s " +
         signal + " $command; wait $command' interrupting";
}

/// The mesh of the demo, ready for the shell.
inline std::string Bracket() { return Quoted(OCTUPOLE_SOURCE_DIR "/examples/data/bracket.mesh"); }

inline nlohmann::json ReadReport(const std::filesystem::path& path) { return nlohmann::json::parse(ReadText(path)); }

/// Names of what is in a folder.
inline std::set<std::string> ContentsOf(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

}  // namespace octupole
