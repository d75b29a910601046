#include "octupole/io/field_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/io/field_writer.h"
#include "octupole/io/singularity_writer.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST(ReadField, ReadsWhatWriteFieldWrote) {
  TetMesh mesh = MakeBoxMesh({2, 1, 1}, {1, 1, 1});
  mesh.regions.assign(mesh.tets.size(), 5);
  std::mt19937 generator(1);
  std::vector<Octupole> coefficients;
  std::vector<Eigen::Matrix3d> frames;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    frames.push_back(RandomFrame(&generator));
    coefficients.push_back(HarmonicFromFrame<3>(frames.back()));
  }
  const TemporaryFolder folder;
  WriteField<3>(folder / "a.vtu", mesh, coefficients, frames, std::vector<Alignment>(mesh.points.size()));
  const FieldFile field = ReadField(folder / "a.vtu");
  EXPECT_EQ(field.tet_mesh.points, mesh.points);
  EXPECT_EQ(field.tet_mesh.tets, mesh.tets);
  EXPECT_EQ(field.tet_mesh.regions, mesh.regions);
  EXPECT_TRUE(field.surface.triangles.empty());
  ASSERT_EQ(field.frames.size(), frames.size());
  for (std::size_t v = 0; v < frames.size(); ++v) EXPECT_EQ(field.frames[v], frames[v]) << v;
}

// Writes a triangle with the axes of its three points, all the same.
void WriteTriangle(const std::filesystem::path& path, const Vector3d& u, const Vector3d& v, const Vector3d& n) {
  const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, us(3, u), vs(3, v), ns(3, n);
  const std::vector<int> triangle = {0, 1, 2};
  WriteVtu(path, points, {{VtuCellType::kTriangle, triangle.data(), 1}},
           {{"tangent_u", 3, us[0].data()}, {"tangent_v", 3, vs[0].data()}, {"normal", 3, ns[0].data()}}, {});
}

TEST(ReadField, ReadsSurfacesAndMakesAxesRotations) {
  const TemporaryFolder folder;
  WriteTriangle(folder / "a.vtu", {0, 1.001, 0}, {1, 0, 0}, {0, 0, 0.999});  // left-handed and a little long
  const FieldFile field = ReadField(folder / "a.vtu");
  EXPECT_TRUE(field.tet_mesh.tets.empty());
  EXPECT_EQ(field.surface.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}}));
  Eigen::Matrix3d expected;
  expected << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  ASSERT_EQ(field.frames.size(), 3u);
  EXPECT_TRUE(field.frames[1].isApprox(expected, 1e-12)) << field.frames[1];
}

TEST(ReadField, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const auto message = [&] { return MessageOf<std::runtime_error>([&] { ReadField(folder / "a.vtu"); }); };
  EXPECT_THAT(message(), HasSubstr("a.vtu"));
  WriteText(folder / "a.vtu", "solid");
  EXPECT_THAT(message(), HasSubstr("this is no VTU file"));
  WriteVtu(folder / "a.vtu", MakeBoxMesh({1, 1, 1}, {1, 1, 1}), {});
  EXPECT_THAT(message(), HasSubstr("frame_x, frame_y and frame_z are missing"));
  WriteTriangle(folder / "a.vtu", {1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_THAT(message(), HasSubstr("the axes at point 0 are not orthonormal"));
}

TEST(ReadSingularities, ReadsWhatWriteSingularitiesWrote) {
  SingularCurves curves;
  curves.curves.push_back({TurnType::kQuarter, 3, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 2, 1, {}});
  curves.curves.push_back({TurnType::kThird, 0, {{2, 0, 0}, {2, 3, 0}, {2, 0, 0}}, 6, 0, {}});
  curves.nodes.push_back({{2, 0, 0}, 4});
  const std::vector<Vector3d> points = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const TemporaryFolder folder;
  WriteSingularities(folder / "a.vtu", curves, points, {{0, 1, 2}, {0, 1, 3}}, {0, -1});
  const SingularStructure read = ReadSingularities(folder / "a.vtu");
  ASSERT_EQ(read.curves.curves.size(), 2u);
  const SingularCurve& open = read.curves.curves[0];
  EXPECT_EQ(open.type, TurnType::kQuarter);
  EXPECT_EQ(open.valence, 3);
  EXPECT_EQ(open.points, curves.curves[0].points);
  EXPECT_EQ(open.length, 2);
  EXPECT_EQ(open.ends[0], CurveEnd::kBoundary);
  EXPECT_EQ(open.ends[1], CurveEnd::kNode);
  EXPECT_TRUE(read.curves.curves[1].is_loop());
  EXPECT_EQ(read.curves.curves[1].points, curves.curves[1].points);
  ASSERT_EQ(read.curves.nodes.size(), 1u);
  EXPECT_EQ(read.curves.nodes[0].num_ends, 4);
  ASSERT_EQ(read.points.size(), 1u);
  EXPECT_EQ(read.points[0].quarter_index, -1);
  EXPECT_EQ(read.points[0].point, Vector3d(1, 0, 1));

  WriteSingularities(folder / "empty.vtu", {}, {}, {}, {});
  EXPECT_TRUE(ReadSingularities(folder / "empty.vtu").curves.curves.empty());
}

TEST(ReadSingularities, WantsItsArrays) {
  const TemporaryFolder folder;
  WriteTriangle(folder / "a.vtu", {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { ReadSingularities(folder / "a.vtu"); }),
              HasSubstr("the cell array type is missing"));
}

}  // namespace
}  // namespace octupole
