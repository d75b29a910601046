// Reads every file of a corpus of good and damaged meshes and holds the outcome to its manifest.
//
// OCTUPOLE_CORPUS names its folder, with the subfolders bad/ and tet/ and a manifest.tsv in each.

#include <gtest/gtest.h>

#include <stdexcept>

#include "corpus.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "test_files.h"

namespace octupole {
namespace {

class MeshCorpus : public CorpusTest {};

TEST_F(MeshCorpus, BadMeshesGoAsTheManifestExpects) {
  const std::vector<Row> rows = ReadManifest(folder_ / "bad/manifest.tsv");
  ASSERT_FALSE(rows.empty()) << "no manifest in " << folder_;
  for (const Row& row : rows) {
    const std::string& name = row.at("name");
    const std::string& expect = row.at("expect");
    SCOPED_TRACE(name);
    TetMesh mesh;
    const std::string message = MessageOf<std::runtime_error>([&] { mesh = ReadTetMesh(folder_ / "bad" / name); });
    if (!message.empty()) {
      EXPECT_NE(expect, "accept") << message;
      EXPECT_NE(message.find(name + ":"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      continue;
    }
    EXPECT_NE(expect, "reject");
    EXPECT_NO_THROW(CheckTetMesh(mesh));
    EXPECT_EQ(InspectMesh(mesh).tets, static_cast<int>(mesh.tets.size()));
    if (row.at("parsed").substr(0, 2) == "V ") {
      EXPECT_EQ("V " + std::to_string(mesh.points.size()) + " T " + std::to_string(mesh.tets.size()), row.at("parsed"));
    }
  }
}

TEST_F(MeshCorpus, GoodMeshesHaveTheCountsOfTheManifest) {
  const std::vector<Row> rows = ReadManifest(folder_ / "tet/manifest.tsv");
  ASSERT_FALSE(rows.empty()) << "no manifest in " << folder_;
  for (const Row& row : rows) {
    const std::filesystem::path path = folder_ / "tet" / row.at("name");
    SCOPED_TRACE(path);
    std::vector<std::string> warnings;
    const TetMesh mesh = ReadTetMesh(path, &warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(std::to_string(mesh.points.size()), row.at("nV"));
    EXPECT_EQ(std::to_string(mesh.tets.size()), row.at("nT"));
    EXPECT_EQ(std::to_string(BoundaryTriangles(mesh).size()), row.at("bTri"));
    EXPECT_TRUE(MeshWarnings(InspectMesh(mesh)).empty());
  }
}

}  // namespace
}  // namespace octupole
