// `octupole surface` as a user runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "command_line.h"
#include "corpus.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

Outcome RunSurface(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " surface " + arguments); }

// Quadrilaterals around the unit cylinder, open at both ends.
std::string CylinderObj(int around, int along) {
  std::ostringstream obj;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      obj << "v " << std::cos(angle) << " " << std::sin(angle) << " " << 2 * M_PI * j / around << "\n";
    }
  }
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i + 1, b = j * around + (i + 1) % around + 1;
      obj << "f " << a << " " << b << " " << b + around << " " << a + around << "\n";
    }
  }
  return obj.str();
}

TEST(SurfaceCommand, WritesFieldReportAndSummary) {
  const TemporaryFolder folder;
  WriteText(folder / "cylinder.obj", CylinderObj(24, 8));
  const Outcome outcome = RunSurface(Quoted(folder / "cylinder.obj") + " --output " + Quoted(folder / "field.vtu") +
                                     " --report " + Quoted(folder / "report.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("216 vertices, 192 faces, 600 edges, Euler characteristic 0, open"));
  EXPECT_THAT(outcome.out, HasSubstr("0 singular faces, indices sum to 0"));
  const json report = ReadReport(folder / "report.json");
  EXPECT_EQ(report["triangles"], 384);
  EXPECT_EQ(report["alignment"]["frames"], 48) << "the borders";
  EXPECT_EQ(report["unknowns"], 2 * (216 - 48));
  EXPECT_EQ(report["singular_faces_by_index"], json::object());
  for (const char* key : {"read", "setup", "solve", "project", "write"}) {
    EXPECT_GE(report["seconds"].at(key).get<double>(), 0) << key;
  }

  // The tangents run around and along; each triangle knows its face.
  const std::string script =
      "import json, sys, meshio, numpy\n"
      "m = meshio.read(sys.argv[1])\n"
      "u, v, n = (m.point_data[k] for k in ('tangent_u', 'tangent_v', 'normal'))\n"
      "radial = m.points * [1, 1, 0]\n"
      "along = numpy.maximum(abs(u[:, 2]), abs(v[:, 2]))\n"
      "handed = numpy.einsum('ij,ij->i', numpy.cross(u, v), n)\n"
      "print(json.dumps({'normal': (n * radial).sum(1).min(), 'along': along.min(), 'handed': handed.min(),\n"
      "  'triangles': len(m.cells_dict['triangle']), 'faces': len(set(m.cell_data['face'][0].tolist())),\n"
      "  'indices': sorted(set(m.cell_data['quarter_index'][0].tolist())),\n"
      "  'alignment': sorted(set(m.point_data['alignment'].tolist()))}))\n";
  WriteText(folder / "read.py", script);
  const Outcome read = Shell("/usr/bin/python3 " + Quoted(folder / "read.py") + " " + Quoted(folder / "field.vtu"));
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const json field = json::parse(read.out);
  EXPECT_GT(field["normal"], 1 - 1e-4);
  EXPECT_GT(field["along"], 1 - 1e-4);
  EXPECT_GT(field["handed"], 1 - 1e-6);
  EXPECT_EQ(field["triangles"], 384);
  EXPECT_EQ(field["faces"], 192);
  EXPECT_EQ(field["indices"], json::array({0}));
  EXPECT_EQ(field["alignment"], json::array({1, 2}));
}

TEST(SurfaceCommand, LeavesBordersFreeWhereAsked) {
  const TemporaryFolder folder;
  WriteText(folder / "cylinder.obj", CylinderObj(24, 8));
  const Outcome outcome = RunSurface(Quoted(folder / "cylinder.obj") + " --quiet --boundary free --degree 4 --output " +
                                     Quoted(folder / "f.vtu") + " --report " + Quoted(folder / "r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
  const json report = ReadReport(folder / "r.json");
  EXPECT_EQ(report["alignment"]["normals"], 216);
  EXPECT_EQ(report["boundary"], "free");
  EXPECT_EQ(report["degree"], 4);
}

// Three triangles at one edge, a vertex of no face: solved, and said.
TEST(SurfaceCommand, WarnsOfWhatIsOdd) {
  const TemporaryFolder folder;
  WriteText(folder / "y.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv -1 -1 0\nv 5 5 5\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  const Outcome outcome = RunSurface(Quoted(folder / "y.obj") + " --output " + Quoted(folder / "f.vtu"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no oriented manifold; cut open, it has 4 more vertices"));
  EXPECT_THAT(outcome.err, HasSubstr("1 vertex belongs to no face"));
}

// All in one line, without a word of OpenMesh's own, and without waiting for what a file only claims to hold.
TEST(SurfaceCommand, RefusesWhatIsNoSurface) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  const struct {
    const char* name;
    std::string text;
    const char* message;
  } cases[] = {
      {"mesh.xyz", "1 2 3", "not one of .obj, .off, .stl and .ply"},
      {"empty.obj", "", "no faces"},
      {"words.obj", "no mesh at all\n", "no faces"},
      {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\n",
       "nan.obj:2: nan where a finite number was expected"},
      {"bare.obj", triangle + "f\n", "bare.obj:4: a face without vertices"},
      {"range.obj", triangle + "f 1 2 4\n", "face 1 has a vertex that is not there"},
      {"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "face 1 has a vertex that is not there"},
      {"nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", ""},
      {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "ends too early"},
      {"claim.off", "OFF\n2000000000 1 0\n0 0 0\n1 0 0\n", ""},
      {"words.off", "no mesh at all\n", ""},
      {"range.ply", ply + "3 0 1 3\n", "face 1 has a vertex that is not there"},
      {"negative.ply", ply + "-3 0 1 2\n", ""},
      {"cut.ply", ply.substr(0, 60), ""},
      {"words.stl", "no mesh at all\n", ""},
      {"cut.stl", std::string(100, '\1'), ""},
  };
  const TemporaryFolder folder;
  for (const auto& bad : cases) {
    WriteText(folder / bad.name, bad.text);
    const Outcome outcome = RunSurface(Quoted(folder / bad.name) + " --output " + Quoted(folder / "f.vtu"));
    EXPECT_EQ(outcome.exit_code, 1) << bad.name << outcome.out;
    EXPECT_THAT(outcome.err, testing::StartsWith("octupole: " + (folder / bad.name).string() + ":"));
    EXPECT_THAT(outcome.err, HasSubstr(bad.message));
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_EQ(ContentsOf(folder.path()).count("f.vtu"), 0u);
  }
  EXPECT_EQ(RunSurface(Quoted(folder / "missing.obj")).exit_code, 1);
  EXPECT_EQ(RunSurface("--boundary round x.obj").exit_code, 2);
}

class SurfaceCorpus : public CorpusTest {};

TEST_F(SurfaceCorpus, IndicesSumToTheEulerCharacteristic) {
  const std::vector<Row> rows = ReadManifest(folder_ / "surface/manifest.tsv");
  ASSERT_FALSE(rows.empty()) << "no manifest in " << folder_;
  const TemporaryFolder folder;
  for (const Row& row : rows) {
    const std::string& name = row.at("name");
    const Outcome outcome = RunSurface(Quoted(folder_ / "surface" / name) + " --quiet --output " +
                                       Quoted(folder / "f.vtu") + " --report " + Quoted(folder / "r.json"));
    ASSERT_EQ(outcome.exit_code, 0) << name << outcome.err;
    const json report = ReadReport(folder / "r.json");
    EXPECT_EQ(std::to_string(report["vertices"].get<int>()), row.at("nV")) << name;
    EXPECT_EQ(std::to_string(report["faces"].get<int>()), row.at("nF")) << name;
    EXPECT_EQ(report["is_closed"], row.at("open_edges") == "0") << name;
    EXPECT_THAT(report["warnings"], IsEmpty()) << name;
    const double euler_characteristic = 2 - 2 * std::stod(row.at("genus"));
    EXPECT_EQ(report["euler_characteristic"], euler_characteristic) << name;
    EXPECT_EQ(report["index_sum"], euler_characteristic) << name;
    EXPECT_EQ(report["termination"], "CONVERGENCE") << name;
  }
}

}  // namespace
}  // namespace octupole
