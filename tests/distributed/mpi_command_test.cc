#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "command_line.h"
#include "octupole/io/field_reader.h"
#include "test_files.h"

// octupole-mpi as a user runs it.

namespace octupole {
namespace {

Outcome OctupoleMpi(int num_ranks, const std::string& arguments) {
  return Shell(OCTUPOLE_MPI_COMMAND " -n " + std::to_string(num_ranks) + " " OCTUPOLE_MPI_TOOL " " + arguments);
}

TEST(MpiCommand, FindsTheFieldOfTheOtherCommand) {
  const TemporaryFolder folder;
  const Outcome one = Shell(OCTUPOLE_COMMAND " field " + Bracket() + " -o " + Quoted(folder / "one.vtu") +
                            " --report " + Quoted(folder / "one.json"));
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto expected = ReadReport(folder / "one.json");
  for (const int num_ranks : {1, 2}) {
    const Outcome outcome = OctupoleMpi(num_ranks, "field " + Bracket() + " -o " + Quoted(folder / "f.pvtu") +
                                                       " --report " + Quoted(folder / "f.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("boundary error"), std::string::npos);
    const auto report = ReadReport(folder / "f.json");
    for (const char* key : {"vertices", "tets", "edges", "unknowns"}) EXPECT_EQ(report[key], expected[key]) << key;
    EXPECT_EQ(report["ranks"], num_ranks);
    EXPECT_NEAR(report["energy4"], expected["energy4"], 0.005 * expected["energy4"].get<double>());
    EXPECT_LT(report["boundary_max_deg"], 1e-10);
  }
  std::size_t num_tets = 0;
  for (const char* piece : {"f_0.vtu", "f_1.vtu"}) num_tets += ReadField(folder / piece).tet_mesh.tets.size();
  EXPECT_EQ(num_tets, expected["tets"].get<std::size_t>());
}

TEST(MpiCommand, KeepsCheckpointsToGoOnFromOnAnyNumberOfRanks) {
  const TemporaryFolder folder;
  const std::string field = "field " + Bracket() + " --quiet --gather 500 --report " + Quoted(folder / "f.json");
  ASSERT_EQ(OctupoleMpi(2, field + " -o " + Quoted(folder / "f.h5") + " --checkpoint " + Quoted(folder / "c.h5") +
                               " --every 0.001")
                .exit_code,
            0);
  const double energy = ReadReport(folder / "f.json")["energy4"];
  EXPECT_EQ(ContentsOf(folder.path()), (std::set<std::string>{"c.h5", "f.h5", "f.json"}));
  for (const char* start : {"c.h5", "f.h5"}) {
    const Outcome outcome =
        OctupoleMpi(3, field + " -o " + Quoted(folder / "g.pvtu") + " --restart " + Quoted(folder / start));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_LT(ReadReport(folder / "f.json")["energy4"], 1.0001 * energy);
  }
}

TEST(MpiCommand, PassesOptionsToPetsc) {
  const TemporaryFolder folder;
  const Outcome outcome = OctupoleMpi(
      2, "field " + Bracket() + " --gather 500 -o " + Quoted(folder / "f.pvtu") + " -tao_monitor -log_view");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("Function value"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("PETSc Performance Summary"), std::string::npos);
}

TEST(MpiCommand, SaysOnceWhatIsWrong) {
  const TemporaryFolder folder;
  WriteText(folder / "bad.vtk", "nothing");
  WriteText(folder / "f.pvtu", "mine");
  const auto expect_error = [&](const std::string& arguments, int exit_code, const std::string& message) {
    const Outcome outcome = OctupoleMpi(2, arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    const auto position = outcome.err.find(message);
    EXPECT_NE(position, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(message, position + 1), std::string::npos) << outcome.err;
    EXPECT_EQ(ReadText(folder / "f.pvtu"), "mine");
  };
  const std::string output = " -o " + Quoted(folder / "f.pvtu");
  expect_error("field " + Quoted(folder / "bad.vtk") + output, 1, "bad.vtk");
  expect_error("field " + Quoted(folder / "missing.msh") + output, 1, "missing.msh");
  expect_error("field " + Bracket() + " -o f.vtk", 1, "f.vtk");
  expect_error("field " + Bracket() + output + " --degree 5", 2, "--degree");
  expect_error("field " + Bracket() + output + " --restart " + Quoted(folder / "bad.vtk"), 1, "bad.vtk");
  EXPECT_EQ(ContentsOf(folder.path()), (std::set<std::string>{"bad.vtk", "f.pvtu"}));
}

TEST(MpiCommand, DiesAtOnceWhenARankIsKilled) {
  const TemporaryFolder folder;
  // The first rank waits for a mesh that never comes, and the second for the first, until it is killed.
  WriteText(folder / "rank.sh", "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then (sleep 1; kill -9 $$) & fi\nexec \"$@\"\n");
  ASSERT_EQ(Shell("mkfifo " + Quoted(folder / "mesh.vtk")).exit_code, 0);
  const Outcome outcome =
      Shell("timeout 60 " OCTUPOLE_MPI_COMMAND " -n 2 sh " + Quoted(folder / "rank.sh") +
            " " OCTUPOLE_MPI_TOOL " field " + Quoted(folder / "mesh.vtk") + " -o " + Quoted(folder / "f.pvtu"));
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_NE(outcome.exit_code, 124) << "it hangs";
  EXPECT_EQ(ContentsOf(folder.path()), (std::set<std::string>{"mesh.vtk", "rank.sh"}));
}

}  // namespace
}  // namespace octupole
