// `octupole map` as a user runs it. The file is checked as an extractor would read it, by nothing of ours.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "command_line.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

Outcome RunMap(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " map " + arguments); }

std::string Octahedron(const TemporaryFolder& folder) {
  WriteText(folder / "part.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices 6\n1 0 0 0\n-1 0 0 0\n0 1 0 0\n0 -1 0 0\n0 0 1 0\n0 0 -1 0\n"
            "Tetrahedra 4\n1 3 5 6 0\n3 2 5 6 0\n2 4 5 6 0\n4 1 5 6 0\nEnd\n");
  return Quoted(folder / "part.mesh");
}

TEST(MapCommand, WritesMapReportAndSummary) {
  const TemporaryFolder folder;
  const Outcome outcome = RunMap(Bracket() + " --max-iterations 3 -o " + Quoted(folder / "map.hexex") + " --vtu " +
                                 Quoted(folder / "map.vtu") + " --markers " + Quoted(folder / "markers.vtu") +
                                 " --report " + Quoted(folder / "map.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("5291 vertices, 20828 tets"));
  EXPECT_THAT(ContentsOf(folder.path()), testing::ElementsAre("map.hexex", "map.json", "map.vtu", "markers.vtu"));
  const json report = ReadReport(folder / "map.json");
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["vertices"], 5291);
  EXPECT_LT(report["flipped_volume"], 0.02);
  // Least squares: half of the tets are stretched less than they should be, and half more.
  EXPECT_GT(report["stretch_5"], 0);
  EXPECT_LT(report["stretch_5"], 1);
  EXPECT_GT(report["stretch_95"], 1);
  EXPECT_LT(report["stretch_95"], 2);
  std::istringstream text(ReadText(folder / "map.hexex"));
  std::size_t num_points, num_tets, num_numbers = 0;
  text >> num_points;
  for (double x; num_numbers < 3 * num_points && text >> x;) ++num_numbers;
  text >> num_tets;
  EXPECT_EQ(num_tets, report["tets_after_splitting"]);
  num_numbers = 0;
  for (double x; text >> x;) ++num_numbers;
  EXPECT_EQ(num_numbers, 16 * num_tets);
}

TEST(MapCommand, RefusesBadInput) {
  const TemporaryFolder folder;
  const std::string part = Octahedron(folder);
  ASSERT_EQ(
      Shell(OCTUPOLE_COMMAND " field " + Bracket() + " --max-iterations 0 --quiet -o " + Quoted(folder / "field.vtu"))
          .exit_code,
      0);
  const Outcome other = RunMap(part + " --field " + Quoted(folder / "field.vtu"));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("frames of 5291 points, but the mesh has 6"));
  WriteText(folder / "none.vtu",
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"6\" NumberOfCells=\"0\">"
            "<PointData></PointData></Piece></UnstructuredGrid></VTKFile>");
  const Outcome none = RunMap(part + " --field " + Quoted(folder / "none.vtu"));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("none.vtu:1: the element Points is missing"));
  EXPECT_EQ(RunMap(part + " --size 0").exit_code, 2);
  EXPECT_EQ(RunMap(part + " -o " + Quoted(folder / "map.txt")).exit_code, 1);
  WriteText(folder / "inverted.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0.2 0.2 2 0\n"
            "Tetrahedra 3\n1 2 3 4 0\n2 3 4 5 0\n1 3 2 5 0\nEnd\n");
  const Outcome inverted = RunMap(Quoted(folder / "inverted.mesh") + " --quiet");
  EXPECT_EQ(inverted.exit_code, 1);
  EXPECT_THAT(inverted.err, HasSubstr("is inverted: its volume is"));
}

}  // namespace
}  // namespace octupole
