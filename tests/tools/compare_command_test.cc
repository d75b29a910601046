// `octupole compare` as a user runs it. The figures are those of `octupole field`, which has its own tests.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "command_line.h"
#include "corpus.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Outcome RunCompare(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " compare " + arguments); }

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> MethodsOf(const json& rows) {
  std::vector<std::string> methods;
  for (const json& row : rows) methods.push_back(row["method"]);
  return methods;
}

void WriteTet(const std::filesystem::path& mesh) {
  WriteText(mesh,
            "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 4 7\nEnd\n");
}

TEST(CompareCommand, RunsAllMethodsThatDoNotTakeMinutes) {
  const TemporaryFolder folder;
  const Outcome outcome = RunCompare(Bracket() + " --max-iterations 3 --json " + Quoted(folder / "all.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("5291 vertices, 20828 tets"));
  EXPECT_THAT(outcome.out, HasSubstr("NO_CONVERGENCE"));
  const json mesh = ReadReport(folder / "all.json")["meshes"][0];
  EXPECT_THAT(MethodsOf(mesh["methods"]), ElementsAre("octupole-fast", "degree4-fast", "octupole-lbfgs",
                                                      "degree4-lbfgs", "ray-sokolov", "huang", "mbo"));
  EXPECT_THAT(MethodsOf(mesh["ratios"]), ElementsAre("octupole/degree4-fast", "octupole/degree4-lbfgs"));
  for (const json& row : mesh["methods"]) {
    EXPECT_GT(row["unknowns"], 5291);
    EXPECT_GT(row["nonzeros"], row["unknowns"]);
    EXPECT_LE(row["iterations"], 3);
    EXPECT_GT(row["peak_memory_mb"], 1);
    EXPECT_LT(row["peak_memory_mb"], 1000);
    EXPECT_GE(row["process_cpu_seconds"], row["cpu_seconds"]);
    EXPECT_EQ(row["singular_triangles"], row["quarter"].get<int>() + row["half"].get<int>() +
                                             row["diagonal_half"].get<int>() + row["third"].get<int>());
  }
  // The paper's claim: 7 and 2 unknowns instead of 9 and 2.
  const double ratio = mesh["ratios"][0]["unknowns"];
  EXPECT_GT(ratio, 7. / 9);
  EXPECT_LT(ratio, 1);
  EXPECT_EQ(ratio, mesh["methods"][0]["unknowns"].get<double>() / mesh["methods"][1]["unknowns"].get<double>());
}

// The same figures as the command that it runs gives.
TEST(CompareCommand, SaysWhatTheFieldCommandSays) {
  const TemporaryFolder folder;
  const std::string options = Bracket() + " --max-iterations 30 --seed 3 --threads 2 --feature-angle 20";
  ASSERT_EQ(Shell(OCTUPOLE_COMMAND " field " + options + " --quiet --method huang --output " +
                  Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"))
                .exit_code,
            0);
  ASSERT_EQ(RunCompare(options + " --methods huang --repeat 2 --json " + Quoted(folder / "all.json")).exit_code, 0);
  const json report = ReadReport(folder / "report.json");
  const json row = ReadReport(folder / "all.json")["meshes"][0]["methods"][0];
  for (const char* key : {"unknowns", "nonzeros", "iterations", "energy3", "energy4", "energy4_aligned",
                          "boundary_rms_deg", "boundary_max_deg", "singular_triangles", "termination"}) {
    EXPECT_EQ(row[key], report[key]) << key;
  }
  EXPECT_NE(report["energy4"], report["energy4_aligned"]);
}

TEST(CompareCommand, WritesOneLineAMethodAndMesh) {
  const TemporaryFolder folder;
  WriteTet(folder / "a, b.mesh");
  WriteTet(folder / "c.mesh");
  const Outcome outcome =
      RunCompare(Quoted(folder / "a, b.mesh") + " " + Quoted(folder / "c.mesh") +
                 " --methods octupole-cholesky,degree4-cholesky --csv " + Quoted(folder / "all.csv"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<std::string> lines = Lines(ReadText(folder / "all.csv"));
  ASSERT_EQ(lines.size(), 1u + 2u * 3u);
  EXPECT_THAT(lines[0], testing::StartsWith("mesh,vertices,method,unknowns,"));
  EXPECT_THAT(lines[1], testing::StartsWith("\"" + (folder / "a, b.mesh").string() + "\",4,octupole-cholesky,"));
  EXPECT_THAT(lines[6], testing::StartsWith((folder / "c.mesh").string() + ",4,octupole/degree4-cholesky,"));
  const auto num_commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  for (const std::size_t i : {4, 5, 6}) EXPECT_EQ(num_commas(lines[i]), num_commas(lines[0])) << lines[i];
}

TEST(CompareCommand, TracesTheEnergyUntilItConverges) {
  const TemporaryFolder folder;
  WriteTet(folder / "tet.mesh");
  ASSERT_EQ(
      RunCompare(Quoted(folder / "tet.mesh") + " --methods octupole-fast,huang --trace " + Quoted(folder / "trace.csv"))
          .exit_code,
      0);
  const std::vector<std::string> lines = Lines(ReadText(folder / "trace.csv"));
  ASSERT_GT(lines.size(), 3u);
  EXPECT_EQ(lines[0], "mesh,method,iterations,cpu_seconds,energy3,energy4,energy4_aligned,boundary_rms_deg");
  EXPECT_THAT(lines[1], HasSubstr(",octupole-fast,0,"));
  EXPECT_THAT(lines.back(), HasSubstr(",huang,"));
}

// A run that fails is a row that says so; the others go on.
TEST(CompareCommand, GoesOnAfterAFailure) {
  const TemporaryFolder folder;
  WriteTet(folder / "tet.mesh");
  WriteText(folder / "bad.mesh", "MeshVersionFormatted 1\nDimension 3\nVertices 1\n0 0 zero 0\n");
  const Outcome outcome = RunCompare(Quoted(folder / "bad.mesh") + " " + Quoted(folder / "tet.mesh") +
                                     " --methods huang,mbo --csv " + Quoted(folder / "all.csv"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("bad.mesh:4: 'zero' where a coordinate was expected"));
  EXPECT_THAT(outcome.err, HasSubstr("2 of the runs failed"));
  EXPECT_THAT(outcome.out, HasSubstr("tet.mesh: 4 vertices"));
  const std::vector<std::string> lines = Lines(ReadText(folder / "all.csv"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[1], HasSubstr("'zero' where a coordinate was expected"));
  EXPECT_THAT(lines[3], Not(HasSubstr("zero")));
}

TEST(CompareCommand, RefusesABadMeshInOneLine) {
  const TemporaryFolder folder;
  for (const std::string name : {"missing.mesh", "part.step"}) {
    const Outcome outcome = RunCompare(Quoted(folder / name));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr((folder / name).string() + ": "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  for (const std::string option : {"--csv", "--json", "--trace"}) {
    const Outcome outcome = RunCompare(Bracket() + " " + option + " " + Quoted(folder / "missing" / "file"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("there is no folder"));
  }
}

TEST(CompareCommand, RefusesBadUsage) {
  for (const std::string arguments : {"", "--methods magic", "--methods huang,magic", "--repeat 0", "--threads 0",
                                      "--seed -1", "--max-iterations -1", "--nonsense"}) {
    const Outcome outcome = RunCompare(arguments.empty() ? arguments : Bracket() + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  EXPECT_THAT(RunCompare("--help").out, HasSubstr("octupole-cholesky"));
}

}  // namespace
}  // namespace octupole
