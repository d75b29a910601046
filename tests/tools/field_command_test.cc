// `octupole field` as a user runs it: what it prints, writes, refuses and warns of.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "ball_in_box_mesh.h"
#include "command_line.h"
#include "corpus.h"
#include "cylinder_mesh.h"
#include "mesh_writers.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/version.h"
#include "test_files.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Outcome RunField(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " field " + arguments); }

void WriteMedit(const std::filesystem::path& path, const TetMesh& mesh) {
  std::ostringstream text;
  text << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << mesh.points.size() << "\n";
  for (const Eigen::Vector3d& p : mesh.points) text << p.transpose() << " 0\n";
  text << "Tetrahedra\n" << mesh.tets.size() << "\n";
  for (const auto& [a, b, c, d] : mesh.tets) text << a + 1 << " " << b + 1 << " " << c + 1 << " " << d + 1 << " 0\n";
  WriteText(path, text.str() + "End\n");
}

json ReadField(const std::filesystem::path& field, const std::string& mesh) {
  const Outcome outcome =
      Shell("/usr/bin/python3 " OCTUPOLE_SOURCE_DIR "/tests/tools/read_field.py " + Quoted(field) + " " + mesh);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(outcome.out);
}

TEST(FieldCommand, WritesFieldReportAndSummary) {
  const TemporaryFolder folder;
  for (const int degree : {3, 4}) {
    const Outcome outcome =
        RunField(Bracket() + " --max-iterations 40 --degree " + std::to_string(degree) + " --output " +
                 Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    EXPECT_THAT(outcome.out, HasSubstr("5291 vertices, 20828 tets"));
    EXPECT_THAT(outcome.out, HasSubstr((folder / "field.vtu").string()));

    const json report = ReadReport(folder / "report.json");
    for (const char* key : {"vertices", "tets", "edges", "degree", "unknowns", "nonzeros", "method", "solver",
                            "termination", "iterations", "energy", "energy3", "energy4", "boundary_rms_deg",
                            "boundary_max_deg", "singular_triangles", "alignment", "warnings"}) {
      EXPECT_TRUE(report.contains(key)) << key;
    }
    for (const char* key : {"read", "setup", "solve", "project", "write"}) {
      EXPECT_GE(report["seconds"].at(key).get<double>(), 0) << key;
    }
    const json& by_type = report.at("singular_triangles_by_type");
    const int sum_of_types = by_type.at("quarter").get<int>() + by_type.at("half").get<int>() +
                             by_type.at("diagonal_half").get<int>() + by_type.at("third").get<int>();
    EXPECT_EQ(report["singular_triangles"], sum_of_types);
    EXPECT_EQ(report["vertices"], 5291);
    EXPECT_EQ(report["degree"], degree);
    EXPECT_LE(report["iterations"], 40);
    EXPECT_LT(report["boundary_max_deg"], 1e-4);

    const json field = ReadField(folder / "field.vtu", Bracket());
    EXPECT_EQ(field["same_points"], true);
    EXPECT_EQ(field["same_tets"], true);
    EXPECT_EQ(field["right_handed"], true);
    EXPECT_LT(field["orthonormality"], 1e-9);
    EXPECT_EQ(field["components"], json({{"frame_x", 3},
                                         {"frame_y", 3},
                                         {"frame_z", 3},
                                         {degree == 3 ? "octupole" : "hexadecapole", 2 * degree + 1},
                                         {"alignment", 1}}));
    EXPECT_EQ(field["regions"], json({1}));
    const auto& alignment = report["alignment"];
    const int normals_and_tangents = alignment["normals"].get<int>() + alignment["tangents"].get<int>();
    EXPECT_EQ(field["alignments"][1], normals_and_tangents);
    EXPECT_EQ(field["alignments"][2], alignment["frames"]);
  }
}

// One number per tet is no material; asked for, it is followed all the same.
TEST(FieldCommand, ReportsInterfacesAndWarnsOfRegionsThatAreNone) {
  const TemporaryFolder folder;
  TetMesh mesh = MakeBallInBoxMesh(8);
  WriteText(folder / "ball.mesh", MeditText(mesh));
  const std::string files = " --output " + Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json");
  const Outcome followed = RunField(Quoted(folder / "ball.mesh") + files);
  ASSERT_EQ(followed.exit_code, 0) << followed.err;
  EXPECT_THAT(followed.err, IsEmpty());
  EXPECT_THAT(followed.out, HasSubstr("interfaces 192 faces; 98 normals, 0 frames, 0 tangents, 0 free; error "));
  json interfaces = ReadReport(folder / "report.json")["interfaces"];
  EXPECT_EQ(interfaces["faces"], 192);
  EXPECT_EQ(interfaces["normals"], 98);
  EXPECT_LT(interfaces["max_error_deg"], 1e-6);

  const Outcome ignored = RunField(Quoted(folder / "ball.mesh") + files + " --ignore-regions");
  ASSERT_EQ(ignored.exit_code, 0) << ignored.err;
  EXPECT_THAT(ignored.out, Not(HasSubstr("interfaces")));
  EXPECT_EQ(ReadReport(folder / "report.json")["interfaces"]["faces"], 0);

  for (std::size_t t = 0; t < mesh.regions.size(); ++t) mesh.regions[t] = static_cast<int>(t);
  WriteText(folder / "numbers.mesh", MeditText(mesh));
  const Outcome numbers = RunField(Quoted(folder / "numbers.mesh") + files);
  ASSERT_EQ(numbers.exit_code, 0) << numbers.err;
  EXPECT_THAT(numbers.err, HasSubstr("between the 3072 regions are taken for no interfaces"));
  EXPECT_THAT(numbers.err, HasSubstr("--follow-regions"));
  EXPECT_EQ(ReadReport(folder / "report.json")["interfaces"]["faces"], 0);
  EXPECT_EQ(ReadReport(folder / "report.json")["warnings"].size(), 1u);
  const Outcome forced = RunField(Quoted(folder / "numbers.mesh") + files + " --follow-regions --quiet");
  ASSERT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_EQ(ReadReport(folder / "report.json")["interfaces"]["faces"], MeshTriangles(mesh).size() - 768);
  EXPECT_EQ(RunField(Quoted(folder / "ball.mesh") + files + " --follow-regions --ignore-regions").exit_code, 2);
}

// A cylinder's four curves, as meshio reads them.
TEST(FieldCommand, WritesAndReportsTheSingularStructure) {
  const TemporaryFolder folder;
  WriteMedit(folder / "cylinder.mesh", MakeCylinderMesh(6, 6, 2));
  const Outcome outcome =
      RunField(Quoted(folder / "cylinder.mesh") + " --output " + Quoted(folder / "field.vtu") + " --report " +
               Quoted(folder / "report.json") + " --singularities " + Quoted(folder / "curves.vtu"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("4 curves (valence 3: 4, 5: 0, other: 0)"));
  const json structure = ReadReport(folder / "report.json")["singular_structure"];
  EXPECT_EQ(structure["curves"], 4);
  EXPECT_NEAR(structure["length"].get<double>(), 8, .5);
  for (const char* key : {"loops", "nodes", "node_ends", "open_ends"}) EXPECT_EQ(structure[key], 0) << key;
  EXPECT_EQ(structure["boundary_ends"], 8);
  ASSERT_EQ(structure["curves_by_type"].size(), 1u);
  EXPECT_EQ(structure["curves_by_type"][0]["type"], "quarter");
  EXPECT_EQ(structure["curves_by_type"][0]["valence"], 3);
  EXPECT_EQ(structure["curves_by_type"][0]["length"], structure["length"]);
  EXPECT_EQ(structure["surface_points"], 8);
  EXPECT_EQ(structure["surface_points_by_index"], json({{"0.25", 8}}));
  ASSERT_EQ(structure["boundary_components"].size(), 1u);
  EXPECT_EQ(structure["boundary_components"][0]["index_sum"], 2);
  EXPECT_EQ(structure["boundary_components"][0]["euler_characteristic"], 2);
  EXPECT_EQ(structure["boundary_components"][0]["closed"], true);
  EXPECT_EQ(structure["boundary_components"][0]["all_normal"], false);

  const Outcome read = Shell(
      "/usr/bin/python3 -c \"import meshio, json, sys; m = meshio.read(sys.argv[1]); "
      "print(json.dumps({k: sorted(set(d.tolist())) for k, d in m.cell_data_dict['type'].items()} | "
      "{'valence': sorted(set(m.cell_data_dict['valence']['line'].tolist())), "
      "'curve': sorted(set(m.cell_data_dict['curve']['line'].tolist())), "
      "'quarter_index': m.cell_data_dict['quarter_index']['vertex'].tolist()}))\" " +
      Quoted(folder / "curves.vtu"));
  ASSERT_EQ(read.exit_code, 0) << read.err;
  EXPECT_EQ(json::parse(read.out), json({{"line", {1}},
                                         {"vertex", {0}},
                                         {"valence", {3}},
                                         {"curve", {0, 1, 2, 3}},
                                         {"quarter_index", std::vector<int>(8, 1)}}));
}

TEST(FieldCommand, TakesEverySolverAndIsQuietWhenAsked) {
  const TemporaryFolder folder;
  WriteText(folder / "tet.mesh",
            "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
            "Tetrahedra\n1\n1 2 3 4 7\nEnd\n");
  for (const std::string solver : {"fast", "cholesky", "cgnr", "lbfgs"}) {
    const Outcome outcome =
        RunField(Quoted(folder / "tet.mesh") + " --quiet --threads 2 --seed 5 --solver " + solver + " --output " +
                 Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
    EXPECT_EQ(ReadReport(folder / "report.json")["solver"], solver);
  }
  EXPECT_EQ(ReadField(folder / "field.vtu", Quoted(folder / "tet.mesh"))["regions"], json({7}));
}

TEST(FieldCommand, WritesFramesForOtherPrograms) {
  const TemporaryFolder folder;
  const Outcome outcome =
      RunField(Bracket() + " --max-iterations 5 --output " + Quoted(folder / "field.vtu") + " --fra " +
               Quoted(folder / "field.fra") + " --quaternions " + Quoted(folder / "field.txt"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((folder / "field.fra").string()));
  const std::string fra = ReadText(folder / "field.fra"), quaternions = ReadText(folder / "field.txt");
  EXPECT_THAT(fra, testing::StartsWith("FRA 1\n20828 3 0\n"));
  EXPECT_EQ(std::count(fra.begin(), fra.end(), '\n'), 2 + 3 * 20828);
  EXPECT_EQ(std::count(quaternions.begin(), quaternions.end(), '\n'), 5291);
}

TEST(FieldCommand, TakesEveryMethod) {
  const TemporaryFolder folder;
  for (const std::string method : {"penalty", "ray-sokolov", "huang", "mbo"}) {
    const Outcome outcome = RunField(Bracket() + " --max-iterations 20 --method " + method + " --output " +
                                     Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("method     " + method + ", "));
    const json report = ReadReport(folder / "report.json");
    EXPECT_EQ(report["method"], method);
    EXPECT_EQ(report["degree"], method == "penalty" ? 3 : 4);
    EXPECT_EQ(report.contains("solver"), method == "penalty");
    EXPECT_GT(report["nonzeros"], report["unknowns"]);
    EXPECT_GE(report["cpu_seconds"], 0);
  }
}

TEST(FieldCommand, NamesItsOutputAfterTheMesh) {
  const TemporaryFolder folder;
  const Outcome outcome = Shell("cd " + Quoted(folder.path()) + " && " OCTUPOLE_COMMAND " field " + Bracket() +
                                " --quiet --max-iterations 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(ContentsOf(folder.path()), std::set<std::string>({"bracket_field.vtu"}));
}

TEST(FieldCommand, RepeatsWithItsSeed) {
  const TemporaryFolder folder;
  const auto run = [&](int seed) {
    RunField(Bracket() + " --quiet --max-iterations 5 --seed " + std::to_string(seed) + " --output " +
             Quoted(folder / "field.vtu"));
    return ReadText(folder / "field.vtu");
  };
  const std::string first = run(1);
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(run(1), first);
  EXPECT_NE(run(2), first);
}

TEST(FieldCommand, RefusesBadInputInOneLineAndTouchesNothing) {
  const TemporaryFolder folder;
  const std::string output =
      " --output " + Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json");
  WriteText(folder / "field.vtu", "precious");
  WriteText(folder / "bad.mesh", "MeshVersionFormatted 1\nDimension 3\nVertices 1\n0 0 zero 0\n");
  const auto contents = ContentsOf(folder.path());
  for (const auto& [mesh, cause] :
       {std::pair(folder / "bad.mesh", "bad.mesh:4: 'zero' where a coordinate was expected"),
        std::pair(folder / "missing.mesh", "missing.mesh: "), std::pair(folder / "part.step", "part.step: "),
        std::pair(folder.path(), ": ")}) {
    const Outcome outcome = RunField(Quoted(mesh) + output);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr(cause));
    EXPECT_THAT(outcome.err, HasSubstr(mesh.string()));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(ContentsOf(folder.path()), contents);
  EXPECT_EQ(ReadText(folder / "field.vtu"), "precious");
}

TEST(FieldCommand, SaysBeforeItSolvesThatItCannotWrite) {
  const TemporaryFolder folder;
  for (const std::string option : {"--output", "--report", "--singularities"}) {
    // Unbounded iterations: solving first would show in the test's time.
    const Outcome outcome = RunField(Bracket() + " " + option + " " + Quoted(folder / "missing" / "file"));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("there is no folder"));
  }
}

TEST(FieldCommand, RefusesBadUsage) {
  for (const std::string arguments :
       {"", "--degree 5", "--solver magic", "--method magic", "--method huang --solver fast", "--method mbo --degree 3",
        "--feature-angle 0", "--threads 0", "--starts 0", "--seed -1", "--max-iterations -1", "--nonsense"}) {
    const Outcome outcome = RunField(arguments.empty() ? arguments : Bracket() + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  const Outcome version = Shell(OCTUPOLE_COMMAND " --version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, testing::StartsWith(std::string("octupole ") + kVersion + "\n"));
  for (const char* library : {"Ceres 2.", "Eigen 3.", "zlib 1."}) EXPECT_THAT(version.out, HasSubstr(library));
  EXPECT_THAT(RunField("--help").out, HasSubstr("--feature-angle"));
}

TEST(FieldCommand, WritesTheFieldReachedWhenInterrupted) {
  const TemporaryFolder folder;
  // Sparse Cholesky takes minutes on this mesh; an iteration takes seconds.
  const Outcome outcome =
      Shell(Interrupting("INT") + " " OCTUPOLE_COMMAND " field " + Bracket() + " --solver cgnr --output " +
            Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"));
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_EQ(ReadReport(folder / "report.json")["termination"], "USER_SUCCESS");
  EXPECT_EQ(ReadField(folder / "field.vtu", Bracket())["same_tets"], true);
}

class FieldCommandCorpus : public CorpusTest {};

TEST_F(FieldCommandCorpus, GoesThroughBadMeshesAsTheManifestExpects) {
  const std::vector<Row> rows = ReadManifest(folder_ / "bad/manifest.tsv");
  ASSERT_FALSE(rows.empty()) << "no manifest in " << folder_;
  for (const Row& row : rows) {
    const std::filesystem::path mesh = folder_ / "bad" / row.at("name");
    SCOPED_TRACE(mesh);
    const TemporaryFolder folder;
    const Outcome outcome = RunField(Quoted(mesh) + " --max-iterations 10 --output " + Quoted(folder / "field.vtu"));
    if (outcome.exit_code == 0) {
      EXPECT_NE(row.at("expect"), "reject");
      EXPECT_EQ(ContentsOf(folder.path()), std::set<std::string>({"field.vtu"}));
    } else {
      EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
      EXPECT_NE(row.at("expect"), "accept") << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(mesh.string() + ":"));
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_THAT(ContentsOf(folder.path()), IsEmpty());
    }
  }
}

// The same to six digits, or both nothing: below 1e-5 degrees judge.py's arc cosine sees rounding only.
bool Agree(double ours, double judges) { return std::abs(ours - judges) <= 1e-6 * std::abs(judges) + 1e-5; }

class SlowFieldCommandCorpus : public FieldCommandCorpus {};

TEST_F(SlowFieldCommandCorpus, SatisfiesTheJudgeOnEveryTetMesh) {
  int num_meshes = 0;
  for (const Row& row : ReadManifest(folder_ / "tet/manifest.tsv")) {
    const std::filesystem::path mesh = folder_ / "tet" / row.at("name");
    SCOPED_TRACE(mesh);
    ++num_meshes;
    const TemporaryFolder folder;
    const Outcome outcome = RunField(Quoted(mesh) + " --max-iterations 30 --threads 2 --output " +
                                     Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    // meshio reads neither of these, so there the judge has no input to compare with.
    const bool is_read_by_judge = mesh.extension() != ".ovm" && mesh.extension() != ".tet";
    const Outcome judged = Shell("/usr/bin/python3 " + Quoted(folder_ / "../tools/judge.py") + " " +
                                 Quoted(folder / "field.vtu") + (is_read_by_judge ? " " + Quoted(mesh) : ""));
    ASSERT_EQ(judged.exit_code, 0) << judged.err;
    const json report = ReadReport(folder / "report.json"), judge = json::parse(judged.out);
    EXPECT_LT(judge["orthonormality"], 1e-9);
    EXPECT_LT(judge["boundary_max_deg"], 1e-4);
    EXPECT_LT(report["boundary_max_deg"], 1e-4);
    for (const char* key : {"vertices", "tets", "edges", "singular_triangles"})
      EXPECT_EQ(report[key], judge[key]) << key;
    for (const char* key : {"energy3", "energy4", "boundary_rms_deg", "boundary_max_deg"}) {
      EXPECT_TRUE(Agree(report[key], judge[key])) << key << ": " << report[key] << " against " << judge[key];
    }
  }
  EXPECT_EQ(num_meshes, 12);
}

}  // namespace
}  // namespace octupole
