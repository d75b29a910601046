// `octupole field` with constraints, weights and a start, and `octupole sample`, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "command_line.h"
#include "cylinder_mesh.h"
#include "mesh_writers.h"
#include "test_files.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class ControlCommand : public testing::Test {
 protected:
  ControlCommand() { WriteText(folder_ / "mesh.mesh", MeditText(MakeCylinderMesh(6, 6, 2))); }

  std::string Path(const std::string& name) const { return Quoted(folder_ / name); }

  Outcome Field(const std::string& arguments) const {
    return Shell(OCTUPOLE_COMMAND " field " + Path("mesh.mesh") + " -o " + Path("field.vtu") + " --report " +
                 Path("report.json") + " " + arguments);
  }

  json Report() const { return ReadReport(folder_ / "report.json"); }

  TemporaryFolder folder_;
};

TEST_F(ControlCommand, FieldTakesConstraintsAndSaysWhereTheyContradict) {
  // A vertex inside, and one of the bottom's middle with an axis 30 degrees from the normal.
  WriteText(folder_ / "c.csv", "vertex,x,y,z\n171,1,1,0,0,0,1\n24,0,0.5,0.8660254037844386\n");
  for (const char* options : {"", "--method huang", "--solver lbfgs", "--solver lbfgs --constraint-weight 50"}) {
    const Outcome outcome = Field("--constraints " + Path("c.csv") + " " + options);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("prescribed 1 axes, 1 frames; 1 contradict the boundary, by up to 30 degrees"));
    EXPECT_EQ(Report()["constraints"]["frames"], 1);
    EXPECT_NEAR(Report()["constraints"]["largest_contradiction_deg"].get<double>(), 30, 1e-6);
  }
  WriteText(folder_ / "bad.csv", "171,1,1,0\n343,0,0,1\n");
  const Outcome outcome = Field("--constraints " + Path("bad.csv"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("bad.csv:2: vertex 343 is none of 0..342"));
  EXPECT_EQ(Field("--constraints " + Path("c.csv") + " --constraint-weight 5").exit_code, 2);
}

TEST_F(ControlCommand, FieldTakesWeights) {
  ASSERT_EQ(Field("").exit_code, 0);
  const json uniform = Report();
  ASSERT_EQ(Field("--weights fem").exit_code, 0);
  const json fem = Report();
  EXPECT_EQ(uniform["weights"], "uniform");
  EXPECT_EQ(fem["weights"], "fem");
  EXPECT_LT(fem["energy4_fem"], uniform["energy4_fem"]);
  EXPECT_GT(fem["energy4"], uniform["energy4"]);
}

TEST_F(ControlCommand, FieldStartsFromAFieldOfThisMeshOrAnother) {
  ASSERT_EQ(Field("").exit_code, 0);
  const json cold = Report();
  std::filesystem::rename(folder_ / "field.vtu", folder_ / "start.vtu");
  ASSERT_EQ(Field("--start " + Path("start.vtu")).exit_code, 0);
  EXPECT_LT(Report()["iterations"].get<int>(), cold["iterations"].get<int>() / 3);
  EXPECT_LT(Report()["energy4"].get<double>(), 1.001 * cold["energy4"].get<double>());
  EXPECT_EQ(Report()["singular_structure"]["curves"], 4);
  // Another mesh of the same cylinder.
  WriteText(folder_ / "mesh.mesh", MeditText(MakeCylinderMesh(8, 5, 2)));
  const Outcome outcome = Field("--start " + Path("start.vtu"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Report()["singular_structure"]["curves"], 4);
  EXPECT_LT(Report()["boundary_max_deg"], 1e-4);
  EXPECT_EQ(Field("--method mbo --start " + Path("start.vtu")).exit_code, 2);
  const Outcome no_field = Field("--start " + Path("mesh.mesh"));
  EXPECT_EQ(no_field.exit_code, 1);
  EXPECT_THAT(no_field.err, HasSubstr("mesh.mesh: this is no VTU file"));
}

TEST_F(ControlCommand, SampleGivesFramesAtPointsVerticesAndCells) {
  ASSERT_EQ(Field("").exit_code, 0);
  const auto sample = [&](const std::string& points, const std::string& output) {
    return Shell(OCTUPOLE_COMMAND " sample " + Path("field.vtu") + " " + points + " -o " + Path(output));
  };
  WriteText(folder_ / "points.csv", "x,y,z\n0,0,1\n0,0,5\n");
  Outcome outcome = sample(Path("points.csv"), "samples.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("points.csv: 2 points, 1 of them outside"));
  const std::string text = ReadText(folder_ / "samples.csv");
  EXPECT_THAT(text, StartsWith("x,y,z,frame_x_x,"));
  EXPECT_THAT(text, HasSubstr(",1\n0,0,5,"));
  // The mesh itself, and cells; read back with meshio.
  for (const auto& [arguments, count] : {std::pair(Path("mesh.mesh"), 343), {"--cells " + Path("mesh.mesh"), 1296}}) {
    outcome = sample(arguments, "samples.vtu");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(std::to_string(count) + " points, 0 of them outside"));
    const Outcome read = Shell(
        "/usr/bin/python3 -c \"import meshio, sys; m = meshio.read(sys.argv[1]); "
        "print(len(m.points), sorted(m.point_data))\" " +
        Path("samples.vtu"));
    EXPECT_EQ(read.out, std::to_string(count) + " ['frame_x', 'frame_y', 'frame_z', 'is_inside']\n") << read.err;
  }
  EXPECT_EQ(sample(Path("points.csv"), "samples.txt").exit_code, 1);
  EXPECT_THAT(sample("--cells " + Path("points.csv"), "samples.csv").err, HasSubstr("points.csv"));
}

}  // namespace
}  // namespace octupole
