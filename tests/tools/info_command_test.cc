// `octupole info` as a user runs it. On the corpus it is held to what the manifest says of each mesh.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "ball_in_box_mesh.h"
#include "command_line.h"
#include "corpus.h"
#include "mesh_writers.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

Outcome RunInfo(const std::string& arguments) { return Shell(OCTUPOLE_COMMAND " info " + arguments); }

TEST(InfoCommand, SaysWhatAMeshHolds) {
  const TemporaryFolder folder;
  const Outcome outcome = RunInfo(Bracket() + " --report " + Quoted(folder / "info.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, HasSubstr("5291 vertices, 29792 edges, 45327 triangles, 20828 tets"));
  EXPECT_THAT(outcome.out, HasSubstr("nothing odd"));
  const json info = ReadReport(folder / "info.json");
  EXPECT_EQ(info["regions"], json::parse(R"([{"tag": 1, "tets": 20828}])"));
  EXPECT_EQ(info["components"], 1);
  EXPECT_EQ(info["features"]["sharp_edges"], 466);
  // Of a solid, V - E + F - T is half of what it is of its boundary.
  EXPECT_EQ(
      info["vertices"].get<int>() - info["edges"].get<int>() + info["triangles"].get<int>() - info["tets"].get<int>(),
      info["boundary_components"][0]["euler_characteristic"].get<int>() / 2);
}

TEST(InfoCommand, SaysWhatIsOdd) {
  const TemporaryFolder folder;
  // A tet, its mirror image on one face, and a point of none.
  WriteText(folder / "odd.mesh",
            "MeshVersionFormatted 1\nDimension 3\nVertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 0\n9 9 9 0\n"
            "Tetrahedra\n2\n1 2 3 4 7\n1 2 3 5 8\nEnd\n");
  const Outcome outcome = RunInfo(Quoted(folder / "odd.mesh"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("regions     2: 7 (1 tets), 8 (1 tets)"));
  EXPECT_THAT(outcome.out, HasSubstr("boundary 1: genus 0; 6 triangles"));
  EXPECT_THAT(outcome.out, HasSubstr("warning     1 tetrahedron is inverted"));
  EXPECT_THAT(outcome.out, HasSubstr("warning     1 vertex belongs to no tetrahedron"));
  EXPECT_THAT(RunInfo(Quoted(folder / "odd.mesh") + " --quiet").out, IsEmpty());
}

TEST(InfoCommand, CountsInterfacesSeamsAndMidEdgeNodes) {
  const TemporaryFolder folder;
  TetMesh mesh = MakeBallInBoxMesh(8);
  const auto boundary = BoundaryTriangles(mesh);
  mesh.surface_triangles = boundary;
  mesh.surface_tags.assign(boundary.size(), 4);
  // On the bottom of the box, and inside.
  mesh.feature_edges = {{10, 11}, {11, 20}, {364, 365}};
  WriteText(folder / "ball.mesh", MeditText(mesh));
  const Outcome outcome = RunInfo(Quoted(folder / "ball.mesh") + " --report " + Quoted(folder / "info.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("features    3 edges (2 of seams)"));
  EXPECT_THAT(outcome.out, HasSubstr("interfaces  192 faces: 192 between regions, 0 tagged"));
  const json info = ReadReport(folder / "info.json");
  EXPECT_EQ(info["features"]["seams"], 2);
  EXPECT_EQ(info["interfaces"]["faces"], 192);
  EXPECT_EQ(info["interfaces"]["between_regions"]["followed"], true);

  WriteText(
      folder / "second.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n"
      "7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n11 9 9 9\n$EndNodes\n$Elements\n1\n"
      "1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n");
  const Outcome second_order = RunInfo(Quoted(folder / "second.msh"));
  EXPECT_THAT(second_order.out, HasSubstr("warning     1 vertex belongs to no tetrahedron"));
}

TEST(InfoCommand, RefusesBadInputAndUsage) {
  const TemporaryFolder folder;
  const Outcome missing = RunInfo(Quoted(folder / "missing.mesh"));
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("missing.mesh: cannot be read"));
  EXPECT_EQ(RunInfo("").exit_code, 2);
}

class InfoCommandCorpus : public CorpusTest {};

TEST_F(InfoCommandCorpus, AgreesWithTheManifest) {
  int num_meshes = 0;
  for (const Row& row : ReadManifest(folder_ / "tet/manifest.tsv")) {
    const std::filesystem::path mesh = folder_ / "tet" / row.at("name");
    SCOPED_TRACE(mesh);
    const TemporaryFolder folder;
    const Outcome outcome = RunInfo(Quoted(mesh) + " --report " + Quoted(folder / "info.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json info = ReadReport(folder / "info.json");
    EXPECT_EQ(info["vertices"], std::stoi(row.at("nV")));
    EXPECT_EQ(info["tets"], std::stoi(row.at("nT")));
    EXPECT_EQ(info["boundary_triangles"], std::stoi(row.at("bTri")));
    EXPECT_EQ(info["components"], std::stoi(row.at("tet_components")));
    ASSERT_EQ(info["boundary_components"].size(), std::stoul(row.at("boundary_components")));
    EXPECT_EQ(info["boundary_components"][0]["genus"], std::stod(row.at("genus")));
    double least, mean, largest;
    ASSERT_EQ(std::sscanf(row.at("q_min/mean/max").c_str(), "%lf/%lf/%lf", &least, &mean, &largest), 3);
    EXPECT_NEAR(info["mean_ratio"]["min"], least, 6e-4);
    EXPECT_NEAR(info["mean_ratio"]["mean"], mean, 6e-4);
    EXPECT_NEAR(info["mean_ratio"]["max"], largest, 6e-4);
    ++num_meshes;
  }
  EXPECT_EQ(num_meshes, 12);
}

}  // namespace
}  // namespace octupole
