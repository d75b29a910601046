#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "command_line.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A closed cylinder of radius 1 and height 2, of quadrilaterals and two polygons.
std::string CylinderOff(int sides) {
  std::string points, faces, bottom, top;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.) * i / sides;
    for (const int z : {0, 2}) {
      points +=
          std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " + std::to_string(z) + "\n";
    }
    const int j = (i + 1) % sides;
    faces += "4 " + std::to_string(2 * i) + " " + std::to_string(2 * j) + " " + std::to_string(2 * j + 1) + " " +
             std::to_string(2 * i + 1) + "\n";
    bottom = " " + std::to_string(2 * i) + bottom;
    top += " " + std::to_string(2 * i + 1);
  }
  return "OFF\n" + std::to_string(2 * sides) + " " + std::to_string(sides + 2) + " 0\n" + points + faces +
         std::to_string(sides) + bottom + "\n" + std::to_string(sides) + top + "\n";
}

class GridCommand : public testing::Test {
 protected:
  Outcome RunGrid(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " grid " + arguments); }
  std::string File(const std::string& name) { return Quoted(folder_ / name); }

  TemporaryFolder folder_;
};

TEST_F(GridCommand, WritesTheFieldOfASurface) {
  WriteText(folder_ / "cylinder.off", CylinderOff(48));
  const Outcome outcome =
      RunGrid(File("cylinder.off") + " --resolution 24 --levels 2 -o " + File("f.vtu") + " --report " + File("r.json") +
              " --singularities " + File("s.vtu") + " --vdb " + File("f.vdb"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("4 curves (valence 3: 4, 5: 0, other: 0)"));
  const json report = ReadReport(folder_ / "r.json");
  EXPECT_NEAR(report["size"].get<double>(), 2. / 24, 1e-6);
  EXPECT_EQ(report["features"]["edges"], 96);
  EXPECT_EQ(report["alignment"]["free"], 0);
  EXPECT_LT(report["boundary_rms_deg"], 3);

  WriteText(folder_ / "read.py",
            "import json, sys, meshio, numpy\n"
            "m = meshio.read(sys.argv[1])\n"
            "axes = numpy.stack([m.point_data['frame_' + c] for c in 'xyz'], axis=2)\n"
            "radius = numpy.linalg.norm(m.points[:, :2], axis=1)\n"
            "d = numpy.maximum(radius - 1, abs(m.points[:, 2] - 1) - 1)\n"
            "near = (d < 0) & (d > -0.15)\n"
            "print(json.dumps({'hexes': len(m.cells_dict['hexahedron']), 'nodes': len(m.points),\n"
            "  'levels': sorted(set(m.cell_data['level'][0].tolist())),\n"
            "  'off': abs(numpy.linalg.det(axes) - 1).max(), 'octupole': m.point_data['octupole'].shape[1],\n"
            "  'distance': abs(m.point_data['distance'] - d)[near].max(),\n"
            "  'lines': len(meshio.read(sys.argv[2]).cells_dict['line'])}))\n");
  const Outcome read = Shell("/usr/bin/python3 " + File("read.py") + " " + File("f.vtu") + " " + File("s.vtu"));
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const json field = json::parse(read.out);
  EXPECT_EQ(field["hexes"], report["cells"]);
  EXPECT_EQ(field["nodes"], report["nodes"]);
  EXPECT_EQ(field["levels"], json({0, 1}));
  EXPECT_EQ(field["octupole"], 7);
  EXPECT_LT(field["off"], 1e-9);
  EXPECT_LT(field["distance"], 0.01);
  EXPECT_GT(field["lines"], 40);

  openvdb::initialize();
  openvdb::io::File vdb((folder_ / "f.vdb").string());
  vdb.open();
  const auto distance = openvdb::gridPtrCast<openvdb::FloatGrid>(vdb.readGrid("distance"));
  EXPECT_EQ(distance->activeVoxelCount(), report["nodes"].get<std::uint64_t>());
  const openvdb::Coord voxel = openvdb::Coord::round(distance->worldToIndex({0, 0, 1.96}));
  const openvdb::Vec3d place = distance->indexToWorld(voxel);
  EXPECT_NEAR(distance->tree().getValue(voxel), place.z() - 2, 0.01);
  const auto axis = openvdb::gridPtrCast<openvdb::Vec3SGrid>(vdb.readGrid("frame_x"));
  EXPECT_NEAR(axis->tree().getValue(voxel).length(), 1, 1e-5);
}

TEST_F(GridCommand, TakesTheBoundaryOfATetMesh) {
  const Outcome outcome = RunGrid(Bracket() + " --size 4 --degree 4 --quiet -o " + File("f.vtu") + " --report " +
                                  File("r.json") + " --max-iterations 3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const json report = ReadReport(folder_ / "r.json");
  EXPECT_EQ(report["size"], 4);
  EXPECT_EQ(report["triangles"], 7342);
}

// Nodes of any mesh, by a method of degree 4, and a page.
TEST_F(GridCommand, GivesTheFieldAnywhere) {
  WriteText(folder_ / "cylinder.off", CylinderOff(32));
  WriteText(folder_ / "points.csv", "x,y,z\n0,0,1.9\n0.98,0,1\n5,0,1\n");
  const Outcome outcome = RunGrid(File("cylinder.off") + " --resolution 8 --method ray-sokolov --quiet -o " +
                                  File("f.vtu") + " --report " + File("r.json") + " --html " + File("p.html") +
                                  " --sample " + File("points.csv") + " --sample-output " + File("s.csv"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report = ReadReport(folder_ / "r.json");
  EXPECT_EQ(report["method"], "ray-sokolov");
  EXPECT_EQ(report["degree"], 4);
  EXPECT_THAT(ReadText(folder_ / "p.html"), HasSubstr("boundary error"));
  // At each point, one axis is along z, and the outermost is as that at the surface.
  WriteText(folder_ / "read.py",
            "import sys, numpy\n"
            "rows = numpy.loadtxt(sys.argv[1], delimiter=',', skiprows=1)\n"
            "axes = rows[:, 3:12].reshape(-1, 3, 3)\n"
            "print(len(rows), *rows[:, 12].astype(int), abs(axes[:, :, 2]).max(axis=1).min() > 0.99,\n"
            "      abs(axes[1:, :, 0]).max(axis=1).min() > 0.97)\n");
  const Outcome read = Shell("/usr/bin/python3 " + File("read.py") + " " + File("s.csv"));
  EXPECT_EQ(read.out, "3 1 1 0 True True\n") << read.err;
}

// A grid is not as large as its file. The loader tells of each start.
TEST_F(GridCommand, StartsAnewForLargePages) {
  const auto has_two_starts = [](const std::string& command) {
    const std::string out = Shell("env -u GLIBC_TUNABLES LD_SHOW_AUXV=1 " + command + " --help").out;
    EXPECT_THAT(out, HasSubstr("AT_EXECFN"));
    return out.find("AT_EXECFN") != out.rfind("AT_EXECFN");
  };
  EXPECT_TRUE(has_two_starts(OCTUPOLE_COMMAND " grid"));
  EXPECT_FALSE(has_two_starts("GLIBC_TUNABLES= " OCTUPOLE_COMMAND " grid"));
  EXPECT_FALSE(has_two_starts(OCTUPOLE_COMMAND " info"));
}

TEST_F(GridCommand, SaysWhatIsWrong) {
  WriteText(folder_ / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const Outcome open = RunGrid(File("open.obj") + " -o " + File("f.vtu"));
  EXPECT_EQ(open.exit_code, 1);
  EXPECT_THAT(open.err, HasSubstr("the surface is open: 1 hole, the largest with a perimeter of 4.24"));
  const Outcome closed = RunGrid(File("open.obj") + " --resolution 8 --repair close -o " + File("f.vtu"));
  EXPECT_EQ(closed.exit_code, 0) << closed.err;
  EXPECT_THAT(closed.err, HasSubstr("warning: the surface is open: 1 hole"));
  const Outcome large = RunGrid(File("open.obj") + " --size 1e-5 --repair close -o " + File("f.vtu"));
  EXPECT_EQ(large.exit_code, 1);
  EXPECT_THAT(large.err, HasSubstr("GB of memory"));
  EXPECT_EQ(RunGrid(File("open.obj") + " --size 1 --resolution 8").exit_code, 2);
  EXPECT_EQ(RunGrid(File("open.obj") + " --levels 0").exit_code, 2);
  EXPECT_EQ(RunGrid(File("open.obj") + " --method huang --solver lbfgs").exit_code, 2);
  EXPECT_EQ(RunGrid(File("open.obj") + " --method mbo --degree 3").exit_code, 2);
  EXPECT_EQ(RunGrid(File("open.obj") + " --sample-output " + File("s.vtu")).exit_code, 2);
}

}  // namespace
}  // namespace octupole
