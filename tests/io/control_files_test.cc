// Files of what a caller prescribes, of fields to begin with, and of samples.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <stdexcept>

#include "mesh_writers.h"
#include "octupole/frames/frame.h"
#include "octupole/io/constraint_reader.h"
#include "octupole/io/field_reader.h"
#include "octupole/io/field_writer.h"
#include "octupole/io/sample_files.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::EndsWith;
using testing::HasSubstr;

class ControlFiles : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    WriteText(folder_ / name, text);
    return folder_ / name;
  }

  TemporaryFolder folder_;
};

TEST_F(ControlFiles, ReadConstraintsOfOneTwoAndThreeAxes) {
  const auto constraints = ReadConstraints(Write("c.csv",
                                                 "vertex,x,y,z,more\n"
                                                 "# none of the mesh's first\n"
                                                 "4,0,0,2\r\n\n"
                                                 "7;1;1;0;-3;3;0  # a frame\n"
                                                 "9 0 1 0  0 0 1  1 0 0\n"
                                                 "4,0,0,-1\n"),
                                           10);
  ASSERT_EQ(constraints.size(), 3u) << "the same axis again is the same constraint";
  EXPECT_EQ(constraints[0].vertex, 4);
  EXPECT_EQ(constraints[0].alignment.kind(), AlignmentKind::kAxis);
  EXPECT_TRUE(constraints[0].alignment.frame().col(2).isApprox(Vector3d::UnitZ()));
  EXPECT_EQ(constraints[1].vertex, 7);
  const Matrix3d turned = Eigen::AngleAxisd(EIGEN_PI / 4, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT(FrameDifference<4>(constraints[1].alignment.frame(), turned), 1e-12);
  EXPECT_EQ(constraints[2].vertex, 9);
  EXPECT_LT(FrameDifference<4>(constraints[2].alignment.frame(), Matrix3d::Identity()), 1e-12);
}

TEST_F(ControlFiles, ConstraintErrorsNameTheLineAndTheValue) {
  const auto error = [&](const std::string& text) {
    return MessageOf<std::runtime_error>([&] { ReadConstraints(Write("c.csv", text), 10); });
  };
  EXPECT_THAT(error("0,1,0,0\n10,0,0,1\n"), EndsWith("c.csv:2: vertex 10 is none of 0..9"));
  EXPECT_THAT(error("-1,0,0,1\n"), EndsWith("c.csv:1: vertex -1 is none of 0..9"));
  EXPECT_THAT(error("1.5,0,0,1\n"), EndsWith("c.csv:1: vertex 1.5 is none of 0..9"));
  EXPECT_THAT(error("1,0,0,0\n"), EndsWith("c.csv:1: vertex 1: Alignment::Axis: not a direction: [0 0 0]"));
  EXPECT_THAT(error("v,x,y,z\n1,nan,0,0\n"), EndsWith("c.csv:2: nan where a finite number was expected for a number"));
  EXPECT_THAT(error("1,0,0,1\n2,0,0,1\n1,0,1,0\n"), EndsWith("c.csv:3: vertex 1 has another direction in line 1"));
  EXPECT_THAT(error("1,0,0\n"), HasSubstr("c.csv:1: 3 numbers, where a vertex"));
  EXPECT_THAT(error("1,0,0,1,1,0,1\n"),
              HasSubstr("c.csv:1: vertex 1: Alignment::TwoAxes: [0 0 1] and [1 0 1] are at 45"));
  EXPECT_THAT(error("1,0,0,1\n2,0,x,1\n"), EndsWith("c.csv:2: 'x' where a number was expected"));
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { ReadConstraints(folder_ / "none.csv", 10); }),
              HasSubstr("cannot be read"));
}

TEST_F(ControlFiles, ReadConstraintsFromPointArrays) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  std::vector<Vector3d> first(8, Vector3d::Zero()), second = first;
  first[2] = {0, 3, 0};
  first[5] = {0, 3, 0};
  second[5] = {1, 0, 1};
  const auto write = [&](const char* name) {
    WriteVtu(folder_ / "c.vtu", mesh, {{name, 3, first[0].data()}, {"constraint_axis_2", 3, second[0].data()}});
    return folder_ / "c.vtu";
  };
  const auto constraints = ReadConstraints(write("constraint_axis"), 8);
  ASSERT_EQ(constraints.size(), 2u);
  EXPECT_EQ(constraints[0].vertex, 2);
  EXPECT_EQ(constraints[0].alignment.kind(), AlignmentKind::kAxis);
  EXPECT_EQ(constraints[1].vertex, 5);
  EXPECT_EQ(constraints[1].alignment.kind(), AlignmentKind::kFrame);
  const auto error = [](const auto& run) { return MessageOf<std::runtime_error>(run); };
  EXPECT_THAT(error([&] { ReadConstraints(write("constraint_axis"), 9); }),
              EndsWith("c.vtu: 8 points, but the mesh has 9"));
  EXPECT_THAT(error([&] { ReadConstraints(write("other"), 8); }),
              EndsWith("c.vtu: the point array constraint_axis is missing"));
  first[5].setZero();
  EXPECT_THAT(error([&] { ReadConstraints(write("constraint_axis"), 8); }), HasSubstr("c.vtu: point 5: "));
}

TEST_F(ControlFiles, ReadPointsOfTextAndOfAnyMesh) {
  const std::vector<Vector3d> expected = {{1, 2, 3}, {4, 5.5, -6}};
  EXPECT_EQ(ReadPoints(Write("p.csv", "x,y,z\n1,2,3\n4,5.5,-6\n")), expected);
  EXPECT_EQ(ReadPoints(Write("p.xyz", "1 2 3\n4 5.5 -6")), expected);
  EXPECT_EQ(ReadPoints(Write("p.csv", "\xEF\xBB\xBFx;y;z\n+1; 2; 3\n4; 5.5; -6\n")), expected);
  const TetMesh mesh = MakeBoxMesh({2, 1, 1}, {1, 2, 3});
  EXPECT_EQ(ReadPoints(Write("m.mesh", MeditText(mesh))), mesh.points);
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { ReadPoints(Write("p.csv", "1,2,3\n1,2\n")); }),
              EndsWith("p.csv:2: 2 numbers, where a point has 3"));
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { ReadPoints(Write("p.csv", "1,2,3\n1,2,inf\n")); }),
              HasSubstr("p.csv:2: inf where a finite number"));
}

// A unit cube, a prism and a pyramid on it, and a triangle that is no such cell.
TEST_F(ControlFiles, ReadCellCentersOfHexahedraPrismsAndPyramids) {
  const std::string points =
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"  // the cube
      "2 0 0\n2 0 1\n.5 .5 2\n";
  const std::vector<Vector3d> centers = {{.5, .5, .5}, {8. / 6, 2. / 6, .5}, {.5, .5, 6. / 5}};
  const auto expect_centers = [&](const std::filesystem::path& path) {
    const std::vector<Vector3d> read = ReadCellCenters(path);
    ASSERT_EQ(read.size(), 3u) << path;
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(read[c].isApprox(centers[c], 1e-12)) << path << ": " << read[c].transpose();
    EXPECT_EQ(ReadPoints(path).size(), 11u);
  };
  expect_centers(Write("h.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n" +
                                    points +
                                    "CELLS 4 26\n8 0 1 2 3 4 5 6 7\n6 1 8 2 5 9 6\n5 4 5 6 7 10\n3 0 1 2\n"
                                    "CELL_TYPES 4\n12 13 14 5\n"));
  expect_centers(Write("h.vtu",
                       "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n"
                       "<Piece NumberOfPoints=\"11\" NumberOfCells=\"3\"><Points>\n"
                       "<DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
                           points +
                           "</DataArray></Points><Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\">"
                           "0 1 2 3 4 5 6 7 1 8 2 5 9 6 4 5 6 7 10</DataArray>\n"
                           "<DataArray type=\"Int32\" Name=\"offsets\">8 14 19</DataArray>\n"
                           "<DataArray type=\"UInt8\" Name=\"types\">12 13 14</DataArray></Cells>\n"
                           "</Piece></UnstructuredGrid></VTKFile>\n"));
  std::string medit = "MeshVersionFormatted 2\nDimension 3\nHexahedra\n1\n1 2 3 4 5 6 7 8 0\nVertices\n11\n";
  std::string gmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n";
  std::istringstream lines(points);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    medit += line + " 0\n";
    gmsh += std::to_string(++number) + " " + line + "\n";
  }
  expect_centers(Write("h.mesh", medit + "Prisms\n1\n2 9 3 6 10 7 0\nPyramids\n1\n5 6 7 8 11 0\nEnd\n"));
  expect_centers(Write("h.msh", gmsh +
                                    "$EndNodes\n$Elements\n4\n1 5 0 1 2 3 4 5 6 7 8\n2 2 0 1 2 3\n3 6 0 2 9 3 6 10 7\n"
                                    "4 7 0 5 6 7 8 11\n$EndElements\n"));
  EXPECT_THAT(MessageOf<std::runtime_error>(
                  [&] { ReadCellCenters(Write("t.mesh", "MeshVersionFormatted 2\nVertices\n1\n0 0 0 0\nEnd\n")); }),
              HasSubstr("t.mesh: no tetrahedra, hexahedra, prisms or pyramids"));
}

TEST_F(ControlFiles, WriteSamplesAsTheExtensionSays) {
  const std::vector<Vector3d> points = {{0.1, 2, 3}, {1. / 3, 5, 6}};
  const Matrix3d turned = Eigen::AngleAxisd(0.5, Vector3d::UnitZ()).toRotationMatrix();
  const FieldSamples samples = {{Matrix3d::Identity(), turned}, {1, 0}};
  WriteSamples(folder_ / "s.csv", points, samples);
  EXPECT_THAT(
      ReadText(folder_ / "s.csv"),
      HasSubstr("x,y,z,frame_x_x,frame_x_y,frame_x_z,frame_y_x,frame_y_y,frame_y_z,frame_z_x,frame_z_y,frame_z_z,"
                "is_inside\n0.1,2,3,1,0,0,0,1,0,0,0,1,1\n0.3333333333333333,5,6,"));
  WriteSamples(folder_ / "s.vtu", points, samples);
  EXPECT_EQ(ReadPoints(folder_ / "s.vtu"), points);
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { WriteSamples(folder_ / "s.txt", points, samples); }),
              EndsWith("s.txt: the extension is neither .vtu nor .csv"));
  EXPECT_THROW(WriteSamples(folder_ / "s.csv", {}, samples), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
