#include "octupole/adaptors/cad_mesher.h"

#include <gmsh.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "command_line.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

// A file of the model that `build` makes.
void WriteModel(const std::filesystem::path& path, const std::function<void()>& build) {
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  build();
  gmsh::model::occ::synchronize();
  gmsh::write(path.string());
  gmsh::finalize();
}

double Volume(const TetMesh& mesh) {
  double volume = 0;
  for (const double sixfold : SixfoldVolumes(mesh)) volume += std::abs(sixfold) / 6;
  return volume;
}

TEST(MeshCadModel, MarksTheEdgesOfABox) {
  const TemporaryFolder folder;
  for (const char* name : {"box.step", "box.brep"}) {
    WriteModel(folder / name, [] { gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3); });
    const TetMesh mesh = MeshCadModel(folder / name, 0.5);
    CheckTetMesh(mesh);
    EXPECT_NEAR(Volume(mesh), 6, 1e-9);
    EXPECT_EQ(InspectMesh(mesh).inverted_tets, 0);
    EXPECT_EQ(mesh.feature_points.size(), 8u);
    double length = 0;
    for (const auto& [a, b] : mesh.feature_edges) length += (mesh.points[a] - mesh.points[b]).norm();
    EXPECT_NEAR(length, 4 * (1 + 2 + 3), 1e-9);
  }
  EXPECT_TRUE(IsCadModel("part.STP"));
}

// Its two rims are creases; the seam along its side is not.
TEST(MeshCadModel, LeavesOutTheSeamOfACylinder) {
  const TemporaryFolder folder;
  WriteModel(folder / "cylinder.step", [] { gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 3, 1); });
  const TetMesh mesh = MeshCadModel(folder / "cylinder.step", 0.4);
  EXPECT_FALSE(mesh.feature_edges.empty());
  for (const auto& [a, b] : mesh.feature_edges) {
    EXPECT_NEAR(mesh.points[a].z(), mesh.points[b].z(), 1e-9);
    EXPECT_NEAR(mesh.points[a].head<2>().norm(), 1, 1e-9);
  }
  EXPECT_TRUE(mesh.feature_points.empty());
}

TEST(MeshCadModel, NumbersTheVolumes) {
  const TemporaryFolder folder;
  WriteModel(folder / "two.brep", [] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    gmsh::model::occ::addSphere(5, 0, 0, 1);
  });
  const TetMesh mesh = MeshCadModel(folder / "two.brep", 0.5);
  EXPECT_EQ(
      std::count(mesh.regions.begin(), mesh.regions.end(), 1) + std::count(mesh.regions.begin(), mesh.regions.end(), 2),
      static_cast<std::ptrdiff_t>(mesh.tets.size()));
  EXPECT_EQ(InspectMesh(mesh).components, 2);
}

TEST(MeshCadModel, RefusesWhatItCannotMesh) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, double size) {
    return MessageOf<std::runtime_error>([&] { MeshCadModel(folder / name, size); });
  };
  WriteText(folder / "bad.step", "rubbish\n");
  WriteModel(folder / "flat.brep", [] { gmsh::model::occ::addRectangle(0, 0, 0, 1, 1); });
  EXPECT_NE(message("bad.step", 1).find("bad.step: gmsh: "), std::string::npos) << message("bad.step", 1);
  EXPECT_NE(message("missing.step", 1).find("missing.step: cannot be read"), std::string::npos);
  EXPECT_NE(message("flat.brep", 1).find("flat.brep: the model has no volume"), std::string::npos);
  EXPECT_NE(message("mesh.vtk", 1).find("the extension"), std::string::npos);
  for (const double size : {0., -1., std::nan("")}) {
    EXPECT_THROW(MeshCadModel(folder / "bad.step", size), std::invalid_argument);
  }
}

TEST(FieldCommand, ReadsCadModels) {
  const TemporaryFolder folder;
  WriteModel(folder / "cylinder.brep", [] { gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 3, 1); });
  const std::string command = OCTUPOLE_COMMAND " field " + Quoted(folder / "cylinder.brep") + " --output " +
                              Quoted(folder / "field.vtu") + " --report " + Quoted(folder / "report.json");
  const Outcome without_size = Shell(command);
  EXPECT_EQ(without_size.exit_code, 1);
  EXPECT_NE(without_size.err.find("needs the size of its tets"), std::string::npos) << without_size.err;
  const Outcome outcome = Shell(command + " --size 0.4 --max-iterations 5");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(ReadReport(folder / "report.json")["features"]["source"], "marked");
}

}  // namespace
}  // namespace octupole
