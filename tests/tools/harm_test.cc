// What must not happen to a user whatever they type, send or run out of: a file lost, a file left behind, an exit code
// that says all is well.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "command_line.h"

namespace octupole {
namespace {

using std::filesystem::path;
using testing::HasSubstr;
using testing::IsEmpty;

// A command with its input, whose files lie in one folder, and an option of it that names an output.
struct Output {
  std::string command;
  std::string input;
  std::string option;
  std::string ending;
};

class Harm : public testing::Test {
 protected:
  Harm() {
    WriteText(folder_ / "part.mesh",
              "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n"
              "Tetrahedra 2\n1 2 3 4 0\n2 3 4 5 0\nEnd\n");
    WriteText(folder_ / "part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 3 2 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    WriteText(folder_ / "part.node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
    WriteText(folder_ / "part.ele", "1 4 0\n1 1 2 3 4\n");
    WriteText(folder_ / "part.edge", "1 1\n1 1 2 1\n");
  }

  // Runs in the folder, so that default outputs would show there, too.
  Outcome Run(const std::string& arguments, const std::string& before = "") const {
    return Shell("cd " + Quoted(folder_.path()) + " && " + before + " " OCTUPOLE_COMMAND " " + arguments);
  }

  std::vector<Output> AllOutputs() const {
    std::vector<Output> outputs = {
        {"field", "part.mesh", "--output", ".vtu"},
        {"field", "part.mesh", "--report", ".json"},
        {"field", "part.mesh", "--fra", ".fra"},
        {"field", "part.mesh", "--quaternions", ".txt"},
        {"field", "part.mesh", "--singularities", ".vtu"},
        {"field", "part.mesh", "--html", ".html"},
        {"map", "part.mesh", "--output", ".hexex"},
        {"map", "part.mesh", "--vtu", ".vtu"},
        {"map", "part.mesh", "--markers", ".vtu"},
        {"map", "part.mesh", "--report", ".json"},
        {"info", "part.mesh", "--report", ".json"},
        {"compare --methods octupole-fast", "part.mesh", "--csv", ".csv"},
        {"compare --methods octupole-fast", "part.mesh", "--json", ".json"},
        {"compare --methods octupole-fast --max-iterations 1", "part.mesh", "--trace", ".csv"}};
    if (Shell(OCTUPOLE_COMMAND " surface --help").exit_code == 0) {
      outputs.push_back({"surface", "part.obj", "--output", ".vtu"});
      outputs.push_back({"surface", "part.obj", "--report", ".json"});
      outputs.push_back({"surface", "part.obj", "--html", ".html"});
    }
    return outputs;
  }

  const TemporaryFolder folder_;
};

TEST_F(Harm, NoOutputIsAnInputByWhateverName) {
  std::filesystem::create_directory(folder_ / "sub");
  const std::set<std::string> before = ContentsOf(folder_.path());
  for (const Output& output : AllOutputs()) {
    // The input itself has the ending that the output must have.
    const std::string input = "input" + output.ending;
    std::filesystem::copy_file(folder_ / output.input, folder_ / input);
    std::filesystem::create_symlink(input, folder_ / ("link" + output.ending));
    std::filesystem::create_hard_link(folder_ / input, folder_ / ("hard" + output.ending));
    for (const std::string& name : {input, "./" + input, "sub/../" + input, (folder_ / input).string(),
                                    "link" + output.ending, "hard" + output.ending}) {
      const Outcome outcome = Run(output.command + " " + input + " " + output.option + " " + name);
      EXPECT_EQ(outcome.exit_code, 1) << output.command << " " << output.option << " " << name;
      EXPECT_THAT(outcome.err, HasSubstr("would overwrite the input"));
      EXPECT_EQ(ReadText(folder_ / input), ReadText(folder_ / output.input));
    }
    for (const char* name : {"input", "link", "hard"}) std::filesystem::remove(folder_ / (name + output.ending));
    EXPECT_EQ(ContentsOf(folder_.path()), before);
  }
}

// A mesh of TetGen is three files.
TEST_F(Harm, NoOutputIsAFileBesideTheInputThatBelongsToIt) {
  for (const char* file : {"part.node", "part.ele", "part.edge"}) {
    const std::string text = ReadText(folder_ / file);
    for (const char* input : {"part.node", "part.ele"}) {
      const Outcome outcome = Run(std::string("info ") + input + " --report " + file);
      EXPECT_EQ(outcome.exit_code, 1) << file;
      EXPECT_EQ(ReadText(folder_ / file), text);
    }
  }
}

TEST_F(Harm, NoTwoOutputsAreOneFile) {
  std::filesystem::create_symlink("a.vtu", folder_ / "link.vtu");
  const std::set<std::string> before = ContentsOf(folder_.path());
  for (const std::string arguments :
       {"field part.mesh -o a.vtu --singularities ./a.vtu", "field part.mesh -o a.vtu --singularities link.vtu",
        "field part.mesh -o a.vtu --report a.vtu", "field part.mesh --report part_field.vtu",
        "field part.mesh --fra a --quaternions a", "compare part.mesh --csv a --json a",
        "compare part.mesh --csv a --trace ./a"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("are one file")) << arguments;
    EXPECT_EQ(ContentsOf(folder_.path()), before);
  }
}

TEST_F(Harm, AnEndingThatSaysOtherwiseIsRefused) {
  for (const Output& output : AllOutputs()) {
    if (output.ending != ".vtu") continue;
    const Outcome outcome = Run(output.command + " " + output.input + " " + output.option + " field.txt");
    EXPECT_EQ(outcome.exit_code, 1) << output.command << output.option;
    EXPECT_THAT(outcome.err, HasSubstr("writes .vtu files only"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "field.txt"));
  }
}

TEST_F(Harm, ALinkStaysAndItsTargetIsWritten) {
  std::filesystem::create_directory(folder_ / "far");
  for (const Output& output : AllOutputs()) {
    const std::string target = "far/target" + output.ending, link = "link" + output.ending;
    std::filesystem::create_symlink(target, folder_ / link);
    const Outcome outcome = Run(output.command + " " + output.input + " " + output.option + " " + link);
    ASSERT_EQ(outcome.exit_code, 0) << output.command << output.option << outcome.err;
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / link)) << output.command << output.option;
    EXPECT_EQ(ContentsOf(folder_ / "far"), std::set<std::string>({"target" + output.ending}));
    EXPECT_FALSE(ReadText(folder_ / target).empty());
    std::filesystem::remove(folder_ / link);
    std::filesystem::remove(folder_ / target);
  }
}

// A limit on the size of files, and where we may mount one a full disk.
TEST_F(Harm, AFullDiskLeavesWhatWasThereAndNothingElse) {
  std::filesystem::create_directory(folder_ / "full");
  const bool is_mounted = mount("none", (folder_ / "full").c_str(), "tmpfs", 0, "size=8k") == 0;
  int num_failures = 0;
  for (const Output& output : AllOutputs()) {
    const std::string file = "full/old" + output.ending;
    std::vector<std::string> limits;
    if (is_mounted) limits.emplace_back();
    // 512 bytes, which the message fits into. The runs of compare could not write either.
    if (output.command.rfind("compare", 0) != 0) limits.emplace_back("ulimit -f 1; ");
    for (const std::string& limit : limits) {
      std::ofstream(folder_ / file) << std::string(limit.empty() ? 8000 : 10, 'x');
      const std::string old = ReadText(folder_ / file);
      // The default output, where it is not the one at stake, goes where there is room.
      const std::string elsewhere =
          output.command == "field" && output.option != "--output" ? " -o /dev/shm/harm.vtu" : "";
      const Outcome outcome =
          Run(output.command + " " + output.input + " " + output.option + " " + file + (limit.empty() ? elsewhere : ""),
              limit);
      if (outcome.exit_code == 0) continue;  // it fits
      ++num_failures;
      EXPECT_EQ(outcome.exit_code, 1) << output.command << output.option << limit << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("cannot be written"));
      EXPECT_EQ(ContentsOf(folder_ / "full"), std::set<std::string>({"old" + output.ending}));
      EXPECT_EQ(ReadText(folder_ / file), old);
    }
    std::filesystem::remove(folder_ / file);
  }
  EXPECT_GE(num_failures, 5);
  std::filesystem::remove("/dev/shm/harm.vtu");
  if (is_mounted) umount((folder_ / "full").c_str());
}

// A batch system's signal, and Ctrl-C.
TEST_F(Harm, AnInterruptedSolverWritesWhatIsReachedAndSaysSo) {
  for (const auto& [signal, exit_code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    for (const auto& [command, what, file] :
         {std::tuple("field --solver cgnr", "field", "f.vtu"), {"map --integer", "map", "f.hexex"}}) {
      const Outcome outcome = Run(std::string(command) + " " + Bracket() + " -o " + file, Interrupting(signal));
      EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(std::string("interrupted; the ") + what + " reached so far is in " + file));
      EXPECT_FALSE(ReadText(folder_ / file).empty());
      std::filesystem::remove(folder_ / file);
    }
  }
}

TEST_F(Harm, AnInterruptedComparisonEndsItsRunAndLeavesNothingBehind) {
  for (const auto& [signal, exit_code] : {std::pair("INT", 130), std::pair("TERM", 143)}) {
    std::filesystem::create_directory(folder_ / "scratch");
    // A minute's work; the signal goes to this process alone, as batch systems may send it.
    const Outcome outcome = Run("compare " + Bracket() + " --methods octupole-cholesky --csv c.csv",
                                "TMPDIR=scratch " + Interrupting(signal));
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    EXPECT_THAT(ContentsOf(folder_ / "scratch"), IsEmpty());
    EXPECT_TRUE(std::filesystem::exists(folder_ / "c.csv"));
    std::filesystem::remove_all(folder_ / "scratch");
  }
}

TEST_F(Harm, OutOfMemorySaysDuringWhatAndHowMuchIsNeeded) {
  // A header that promises two million vertices, in a file that could hold them.
  std::ofstream(folder_ / "large.mesh") << "MeshVersionFormatted 2\nDimension 3\nVertices 2000000\n"
                                        << std::string(40000000, ' ');
  const Outcome reading = Run("info large.mesh", "ulimit -v 100000; ");
  EXPECT_EQ(reading.exit_code, 1);
  EXPECT_THAT(reading.err,
              HasSubstr("out of memory while reading large.mesh; a field needs about 0.9 GB for a million"));
  EXPECT_EQ(std::count(reading.err.begin(), reading.err.end(), '\n'), 1) << reading.err;
}

TEST_F(Harm, NumbersOutOfRangeGetASentence) {
  for (const std::string arguments :
       {"field part.mesh --max-iterations -3", "compare part.mesh --max-iterations -3", "field part.mesh --size -3"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr("-3 is ")) << arguments;
    EXPECT_LT(outcome.err.size(), 100u) << arguments << outcome.err;
  }
}

// One line a level to the log, none without.
TEST_F(Harm, VerboseLogsTheStepsOfTheFastSolver) {
  const Outcome outcome = Run("field " + Bracket() + " --verbose");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              testing::ContainsRegex("random start 2: [0-9]+ vertices, [0-9]+ iterations, energy [0-9.]+, [0-9.]+ s"));
  EXPECT_THAT(outcome.err, testing::ContainsRegex("frames: 5291 vertices"));
  EXPECT_THAT(outcome.err, testing::ContainsRegex("start [0-9]+ chosen"));
  EXPECT_EQ(Run("field part.mesh").err, "");
  EXPECT_EQ(Run("field part.mesh --verbose --quiet").exit_code, 2);
}

}  // namespace
}  // namespace octupole
