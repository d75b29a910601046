#include "octupole/readers/tet_mesh_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tet_mesh_reader_fixture.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using MeshIo = MeshIoTest;

// ---------------------------------------------------------------------------------------- Medit

const char kMedit[] =
    "MeshVersionFormatted 2\n"
    "Dimension 3\n"
    "Vertices\n"
    "5\n"
    "0 0 0 1\n"
    "1 0 0 1\n"
    "0 2.5 0 1\n"
    "0 0 1 1\n"
    "1 1 -1e-3 1\n"
    "Triangles\n"
    "1\n"
    "1 2 3 7\n"
    "Tetrahedra\n"
    "2\n"
    "1 2 3 4 7\n"
    "5 3 2 1 -8\n"
    "End\n";

TEST_F(MeshIo, Medit) {
  const TetMesh mesh = Read("a.mesh", kMedit);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(7, -8));
  EXPECT_THAT(mesh.surface_triangles, ElementsAre(std::array<int, 3>{0, 1, 2}));
  EXPECT_THAT(mesh.surface_tags, ElementsAre(7));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MeshIo, MeditInOtherLayouts) {
  ExpectTwoTets(Read("a.mesh", WithCrLf(kMedit)));
  ExpectTwoTets(Read("A.MESH", "\xEF\xBB\xBF" + std::string(kMedit)));
  ExpectTwoTets(Read("a.mesh", Replaced(kMedit, "\nEnd\n", "")));
  ExpectTwoTets(Read("a.mesh", "# made by hand\n" + Replaced(kMedit, "\n1 0 0 1", " #x 9\n+1 0 0 1")));
  ExpectTwoTets(Read("a.mesh", Replaced(kMedit, "Dimension 3", "Dimension\n 3\nCorners 2 1 4")));
  ExpectTwoTets(Read("a.mesh",
                     "MeshVersionFormatted 1 Dimension 3 Tetrahedra 2 1 2 3 4 0 5 3 2 1 0 Vertices "
                     "5 0 0 0 0 1 0 0 0 0 2.5 0 0 0 0 1 0 1 1 -0.001 0"));
}

TEST_F(MeshIo, MeditIgnoresWrongCountsOfOtherSections) {
  ExpectTwoTets(Read("a.mesh", Replaced(kMedit, "Triangles\n1\n", "Triangles\n4000000\n")));
}

TEST_F(MeshIo, MeditSurfaceTagsThatAreWrongAreLeftOut) {
  for (const auto& [wrong, message] :
       {std::pair("Triangles\n2\n", ":13: 'Tetrahedra' where a vertex index was expected"),
        std::pair("Triangles\n0\n", ":12: more triangles than announced"),
        std::pair("Triangles\n2\n6 1 2 3\n", ":12: vertex index 6 is out of range 1..5")}) {
    const TetMesh mesh = Read("a.mesh", Replaced(kMedit, "Triangles\n1\n", wrong));
    ExpectTwoTets(mesh);
    EXPECT_THAT(mesh.surface_triangles, IsEmpty());
    EXPECT_THAT(mesh.surface_tags, IsEmpty());
    EXPECT_THAT(warnings_, ElementsAre("the surface tags are left out: " + (folder_ / "a.mesh").string() + message));
  }
  const TetMesh mesh = Read("a.mesh", Replaced(kMedit, "Triangles\n1\n", "Triangles\n2\n4 1 4 8\n"));
  EXPECT_THAT(mesh.surface_triangles, ElementsAre(std::array<int, 3>{0, 1, 2})) << "one is degenerate";
  EXPECT_THAT(mesh.surface_tags, ElementsAre(7));
}

const char kMeditFeatures[] =
    "Corners 2 5 1\n"
    "Edges 3\n"
    "4 1 9\n"
    "1 2 0\n"
    "2 1 7\n";

TEST_F(MeshIo, MeditFeaturesAreEdgesAndCorners) {
  for (const std::string& text : {Replaced(kMedit, "End\n", kMeditFeatures),
                                  Replaced(kMedit, "Vertices\n", std::string(kMeditFeatures) + "Vertices\n")}) {
    const TetMesh mesh = Read("a.mesh", text);
    ExpectTwoTets(mesh);
    EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{0, 1}, std::array<int, 2>{0, 3}));
    EXPECT_THAT(mesh.feature_points, ElementsAre(0, 4));
    EXPECT_THAT(warnings_, IsEmpty());
  }
  EXPECT_THAT(Read("a.mesh", kMedit).feature_edges, IsEmpty());
}

TEST_F(MeshIo, MeditRidgesAndRequiredEdgesNameTheEdgesThatAreFeatures) {
  const std::string text = Replaced(kMedit, "End\n", kMeditFeatures);
  EXPECT_THAT(Read("a.mesh", text + "Ridges 1 1\nRequiredVertices 1 2\n").feature_edges,
              ElementsAre(std::array<int, 2>{0, 3}));
  EXPECT_THAT(Read("a.mesh", text + "RequiredEdges 1 2\nRidges 1 1\n").feature_edges,
              ElementsAre(std::array<int, 2>{0, 1}, std::array<int, 2>{0, 3}));
  EXPECT_THAT(Read("a.mesh", text + "Ridges 0").feature_edges, IsEmpty());
  EXPECT_EQ(Error("a.mesh", text + "Ridges 1 4"), "a.mesh: Ridges or RequiredEdges name edge 4, out of range 1..3");
}

TEST_F(MeshIo, FeaturesThatAreNotInTheMeshAreLeftOut) {
  // Vertex 6 is in no tetrahedron, and 4 and 5 have no edge.
  const std::string text = Replaced(Replaced(kMedit, "5\n0 0", "6\n0 0"), "Triangles\n", "7 7 7 0\nTriangles\n");
  const TetMesh mesh = Read("a.mesh", Replaced(text, "End\n", "Corners 3 6 1 1 Edges 4 1 6 0 4 5 0 3 2 0 2 2 0\n"));
  EXPECT_EQ(mesh.points.size(), 6);
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{1, 2}));
  EXPECT_THAT(mesh.feature_points, ElementsAre(0));
  EXPECT_THAT(warnings_, ElementsAre("3 marked lines are no edges of the mesh and left out",
                                     "1 marked points are not in the mesh and left out"));
}

TEST_F(MeshIo, EdgesThatAreAllMarkNone) {
  const std::string all = "Edges 9 1 2 0 1 3 0 1 4 0 2 3 0 2 4 0 3 4 0 5 3 0 5 2 0 5 1 0\n";
  EXPECT_THAT(Read("a.mesh", Replaced(kMedit, "End\n", all)).feature_edges, IsEmpty());
  EXPECT_THAT(warnings_, ElementsAre("9 marked lines are all edges of the mesh and not heeded"));
  EXPECT_EQ(Read("a.mesh", Replaced(kMedit, "End\n", Replaced(all, "Edges 9 1 2 0", "Edges 8"))).feature_edges.size(),
            8);
}

TEST_F(MeshIo, MeditErrors) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.mesh", Replaced(kMedit, from, to));
  };
  EXPECT_EQ(error("Formatted 2", "Formatted 9"), "a.mesh:1: Medit version 9 is not 1..4");
  EXPECT_EQ(error("Dimension 3", "Dimension 2"), "a.mesh:2: a mesh of dimension 2, not 3");
  EXPECT_EQ(error("5\n0 0", "-5\n0 0"), "a.mesh:4: -5 as the number of vertices");
  EXPECT_EQ(error("5\n0 0", "1000000000000\n0 0"),
            "a.mesh:4: 1000000000000 vertices announced, but only 105 bytes follow");
  EXPECT_EQ(error("5\n0 0", "4\n0 0"), "a.mesh:9: more vertices than announced");
  EXPECT_EQ(error("5\n0 0", "6\n0 0"), "a.mesh:10: 'Triangles' where a coordinate was expected");
  EXPECT_EQ(error("2.5", "2,5"), "a.mesh:7: '2,5' where a coordinate was expected");
  EXPECT_EQ(error("2.5", "+-2.5"), "a.mesh:7: '+-2.5' where a coordinate was expected");
  EXPECT_EQ(error("2.5", "nan"), "a.mesh:7: nan where a finite number was expected for a coordinate");
  EXPECT_EQ(error("2.5", "-inf"), "a.mesh:7: -inf where a finite number was expected for a coordinate");
  EXPECT_EQ(error("2.5", "2e999"), "a.mesh:7: '2e999' where a coordinate was expected");
  EXPECT_EQ(error("5 3 2 1", "9 3 2 1"), "a.mesh:16: vertex index 9 is out of range 1..5");
  EXPECT_EQ(error("5 3 2 1", "0 3 2 1"), "a.mesh:16: vertex index 0 is out of range 1..5");
  EXPECT_EQ(error("5 3 2 1", "5 3 2 3"), "a.mesh:16: a tetrahedron has vertex 3 twice");
  EXPECT_EQ(error("5 3 2 1", "5 3 2.5 1"), "a.mesh:16: '2.5' where a vertex index was expected");
  EXPECT_EQ(error("1 -8", "1 99999999999"), "a.mesh:16: 99999999999 is too large for a region tag");
  EXPECT_EQ(error("5 3 2 1 -8\nEnd\n", ""), "a.mesh:14: 2 tetrahedra announced, but only 11 bytes follow");
  EXPECT_EQ(error("5 3 2 1 -8\nEnd\n", "5 000000003 2"), "a.mesh:16: the file ends before all 2 tetrahedra are read");
  EXPECT_EQ(error("End", "Vertices"), "a.mesh:17: a second section Vertices");
  EXPECT_EQ(error("End", "Edges 1 1 6 0"), "a.mesh:17: vertex index 6 is out of range 1..5");
  EXPECT_EQ(error("End", "Corners 1 1 2"), "a.mesh:17: more corners than announced");
  EXPECT_EQ(error("Vertices", "Points"), "a.mesh: the section Vertices is missing");
  EXPECT_EQ(error("Tetrahedra\n2", "Hexahedra\n2"), "a.mesh: no tetrahedra, only 2 hexahedra, 1 triangles");
}

// ------------------------------------------------------------------------------------------ VTK

const char kVtk[] =
    "# vtk DataFile Version 3.0\n"
    "a title\n"
    "ASCII\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "POINTS 5 double\n"
    "0 0 0 1 0 0\n"
    "0 2.5 0 0 0 1 1 1 -1e-3\n"
    "CELLS 3 14\n"
    "4 0 1 2 3\n"
    "3 0 1 2\n"
    "4 4 2 1 0\n"
    "CELL_TYPES 3\n"
    "10 5 10\n";

const char kVtkData[] =
    "POINT_DATA 5\n"
    "SCALARS id int 1\n"
    "LOOKUP_TABLE default\n"
    "1 2 3 4 5\n"
    "CELL_DATA 3\n"
    "SCALARS quality double\n"
    "LOOKUP_TABLE default\n"
    "0.5 1.5 2.5\n"
    "SCALARS CellEntityIds int\n"
    "LOOKUP_TABLE default\n"
    "6 7 8\n";

const char kVtk5[] =
    "# vtk DataFile Version 5.1\n"
    "vtk output\n"
    "ASCII\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "FIELD FieldData 1\n"
    "TIME 1 1 double\n"
    "0.5\n"
    "POINTS 5 float\n"
    "0 0 0 1 0 0\n"
    "0 2.5 0 0 0 1 1 1 -0.001\n"
    "METADATA\n"
    "INFORMATION 0\n"
    "\n"
    "CELLS 4 11\n"
    "OFFSETS vtktypeint64\n"
    "0 4 7 11\n"
    "CONNECTIVITY vtktypeint64\n"
    "0 1 2 3 0 1 2 4 2\n"
    "1 0\n"
    "CELL_TYPES 3\n"
    "10\n5\n10\n";

TEST_F(MeshIo, Vtk) {
  const TetMesh mesh = Read("a.vtk", kVtk);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MeshIo, VtkRegionsAreTheFirstIntegersOfCells) {
  const TetMesh mesh = Read("a.vtk", std::string(kVtk) + kVtkData);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(6, 8));
}

TEST_F(MeshIo, VtkInOtherLayouts) {
  ExpectTwoTets(Read("a.vtk", kVtk5));
  ExpectTwoTets(Read("a.vtk", WithCrLf(kVtk)));
  ExpectTwoTets(Read("a.vtk", WithCrLf(kVtk5)));
  ExpectTwoTets(Read("a.vtk", Replaced(kVtk, "a title\n", "\n")));
  ExpectTwoTets(Read("a.vtk", Replaced(kVtk, "a title\n", "ASCII export\n\n")));
}

TEST_F(MeshIo, VtkOtherCells) {
  const TetMesh mesh = Read("a.vtk",
                            "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                            "POINTS 10 double\n0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0\n"
                            "0 0 0 0 0 0 0 0 0\n"
                            "CELLS 5 38\n10 3 2 1 0 4 5 6 7 8 9\n8 0 1 2 3 4 5 6 7\n"
                            "6 0 1 2 3 4 5\n5 0 1 2 3 4\n4 0 1 2 3\n"
                            "CELL_TYPES 5\n24\n12\n13\n14\n10\n");
  EXPECT_EQ(mesh.points.size(), 10);
  EXPECT_THAT(mesh.tets, ElementsAre(std::array<int, 4>{3, 2, 1, 0}, std::array<int, 4>{0, 1, 2, 3}));
  EXPECT_THAT(mesh.mid_edge_nodes, ElementsAre(std::array{4, 2, 3}, std::array{5, 1, 2}, std::array{6, 1, 3},
                                               std::array{7, 0, 3}, std::array{8, 0, 2}, std::array{9, 0, 1}));
  EXPECT_THAT(warnings_, ElementsAre("1 hexahedra are left out", "1 prisms are left out", "1 pyramids are left out"));
}

TEST_F(MeshIo, VtkFeaturesAreLinesAndVertices) {
  const std::string cells = "1 4\n2 0 1\n3 4 2 0\n2 4 3\n3 1 2 3\n";  // a vertex, lines, a polyline, a quadratic line
  const TetMesh mesh = Read("a.vtk", Replaced(Replaced(kVtk, "CELLS 3 14\n", "CELLS 8 30\n" + cells), "CELL_TYPES 3\n",
                                              "CELL_TYPES 8\n1 3 4 3 21 "));
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{0, 1}, std::array<int, 2>{0, 2},
                                              std::array<int, 2>{1, 2}, std::array<int, 2>{2, 4}));
  EXPECT_THAT(mesh.feature_points, ElementsAre(4));
  EXPECT_THAT(warnings_, ElementsAre("1 marked lines are no edges of the mesh and left out"));
}

TEST_F(MeshIo, VtkRegionsMayBeAFieldOfTheCells) {
  const TetMesh mesh = Read("a.vtk", std::string(kVtk) +
                                         "FIELD FieldData 1\nids 1 3 int\n5 5 5\n"
                                         "CELL_DATA 3\nFIELD FieldData 3\nvolume 1 3 double\n0.5 0.5 0.5\n"
                                         "METADATA\nINFORMATION 0\n\nmaterial 1 3 int\n3 4 5\nother 1 3 int\n0 0 0\n");
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(3, 5));
}

TEST_F(MeshIo, VtkErrors) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.vtk", Replaced(kVtk, from, to));
  };
  EXPECT_EQ(error("Version 3.0", "Version 1.0"), "a.vtk:1: VTK versions 2.0 to 5.1 are read, not '1.0'");
  EXPECT_EQ(error("UNSTRUCTURED_GRID", "POLYDATA"),
            "a.vtk:4: a dataset of kind 'POLYDATA', only UNSTRUCTURED_GRID is read");
  EXPECT_EQ(error("POINTS 5", "POINTS 4000000000"), "a.vtk:5: 4000000000 points announced, but only 104 bytes follow");
  EXPECT_EQ(error("2.5", "inf"), "a.vtk:7: inf where a finite number was expected for a coordinate");
  EXPECT_EQ(error("CELLS 3 14", "CELLS 3 13"), "a.vtk:11: cell 2 does not fit the 13 entries announced");
  EXPECT_EQ(error("CELLS 3 14", "CELLS 3 15"), "a.vtk:12: 'CELL_TYPES' where a vertex index was expected");
  EXPECT_EQ(error("4 4 2 1 0", "4 5 2 1 0"), "a.vtk:11: vertex index 5 is out of range 0..4");
  EXPECT_EQ(error("4 4 2 1 0", "4 4 2 1 2"), "a.vtk:11: a tetrahedron has vertex 2 twice");
  EXPECT_EQ(error("10 5 10", "10 10 10"), "a.vtk:10: a tetrahedron of 3 vertices instead of 4");
  EXPECT_EQ(error("10 5 10", "10 5"), "a.vtk:13: the file ends before all 3 cell types are read");
  EXPECT_EQ(error("CELL_TYPES 3", "CELL_TYPES 2"), "a.vtk:12: 2 cell types for 3 cells");
  EXPECT_EQ(error("10 5 10", "22 5 12"), "a.vtk: no tetrahedra, only 1 hexahedra, 2 triangles");
  EXPECT_EQ(error("10 5 10", "10 5 5"), "a.vtk:11: a triangle of 4 vertices instead of 3");
  EXPECT_EQ(Error("a.vtk", Replaced(kVtk5, "0 4 7 11", "0 4 3 11")),
            "a.vtk:16: offset 3 does not fit behind 4 and before 11");
  EXPECT_EQ(Error("a.vtk", Replaced(kVtk5, "0 4 7 11", "0 4 7 10")),
            "a.vtk:16: the last offset is 10, but 11 entries were announced");
}

// ----------------------------------------------------------------------------------------- Gmsh

const char kGmsh2[] =
    "$MeshFormat\n"
    "2.2 0 8\n"
    "$EndMeshFormat\n"
    "$PhysicalNames\n"
    "1\n"
    "3 7 \"a $Nodes body\"\n"
    "$EndPhysicalNames\n"
    "$Nodes\n"
    "5\n"
    "1 0 0 0\n"
    "20 1 0 0\n"
    "3 0 2.5 0\n"
    "4000000000 0 0 1\n"
    "5 1 1 -1e-3\n"
    "$EndNodes\n"
    "$Elements\n"
    "4\n"
    "1 15 2 1 1 1\n"
    "2 4 2 7 1 1 20 3 4000000000\n"
    "3 2 2 1 1 1 20 3\n"
    "4 4 0 5 3 20 1\n"
    "$EndElements\n";

const char kGmsh4[] =
    "$MeshFormat\n"
    "4.1 0 8\n"
    "$EndMeshFormat\n"
    "$Entities\n"
    "1 0 1 2\n"
    "1 0 0 0 0\n"
    "2 0 0 0 1 1 1 1 9 0\n"
    "3 0 0 0 1 1 1 2 70 71 1 2\n"
    "4 0 0 0 1 1 1 0 1 2\n"
    "$EndEntities\n"
    "$Nodes\n"
    "2 5 1 9\n"
    "2 2 1 3\n"
    "1\n2\n9\n"
    "0 0 0 0.5 0.5\n"
    "1 0 0 0.5 0.5\n"
    "0 2.5 0 0.5 0.5\n"
    "3 3 0 2\n"
    "4\n5\n"
    "0 0 1\n"
    "1 1 -1e-3\n"
    "$EndNodes\n"
    "$Elements\n"
    "3 3 1 3\n"
    "2 2 2 1\n"
    "1 1 2 9\n"
    "3 3 4 1\n"
    "2 1 2 9 4\n"
    "3 4 4 1\n"
    "3 5 9 2 1\n"
    "$EndElements\n";

TEST_F(MeshIo, Gmsh2) {
  const TetMesh mesh = Read("a.msh", kGmsh2);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(7, 0));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MeshIo, GmshFeaturesAreLinesAndPoints) {
  const TetMesh mesh = Read("a.msh", Replaced(Replaced(kGmsh2, "\n4\n1 15", "\n6\n1 15"), "$EndElements",
                                              "5 1 1 0 3 1\n6 8 0 20 4000000000 5\n$EndElements"));
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{0, 2}, std::array<int, 2>{1, 3}));
  EXPECT_THAT(mesh.feature_points, ElementsAre(0));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MeshIo, GmshElementsMayStandBeforeTheNodes) {
  const std::string text = kGmsh2;
  const std::size_t nodes = text.find("$Nodes\n5");
  const std::size_t elements = text.find("$Elements");
  const TetMesh mesh =
      Read("a.msh", text.substr(0, nodes) + text.substr(elements) + text.substr(nodes, elements - nodes));
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(7, 0));
}

TEST_F(MeshIo, Gmsh4RegionsArePhysicalTagsOrVolumes) {
  const TetMesh mesh = Read("a.msh", kGmsh4);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(70, 4));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MeshIo, GmshInOtherLayouts) {
  ExpectTwoTets(Read("a.msh", WithCrLf(kGmsh2)));
  ExpectTwoTets(Read("a.msh", WithCrLf(kGmsh4)));
  ExpectTwoTets(Read("a.msh", Replaced(kGmsh2, "2.2 0 8", "2 0 8")));
  ExpectTwoTets(Read("a.msh", "$Comments\nanything\n$EndComments\n" + std::string(kGmsh2)));
}

TEST_F(MeshIo, GmshOtherElements) {
  std::string nodes;
  for (int i = 1; i <= 20; ++i) {
    nodes += " " + std::to_string(i);
  }
  const TetMesh mesh = Read(
      "a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n20\n" +
                   [] {
                     std::string lines;
                     for (int i = 1; i <= 20; ++i) {
                       lines += std::to_string(i) + " 0 0 " + std::to_string(i) + "\n";
                     }
                     return lines;
                   }() +
                   "$EndNodes\n$Elements\n6\n"
                   "1 11 1 3 9 8 7 6 1 2 3 4 5 10\n2 29 1 4" +
                   nodes +
                   "\n3 5 1 1 1 2 3 4 5 6 7 8\n4 6 1 1 1 2 3 4 5 6\n5 7 1 1 1 2 3 4 5\n"
                   "6 5 1 1 1 2 3 4 5 6 7 9\n$EndElements\n");
  EXPECT_THAT(mesh.tets, ElementsAre(std::array<int, 4>{8, 7, 6, 5}, std::array<int, 4>{0, 1, 2, 3}));
  EXPECT_THAT(mesh.regions, ElementsAre(3, 4));
  EXPECT_THAT(mesh.mid_edge_nodes, ElementsAre(std::array{4, 5, 6}, std::array{9, 5, 7}))
      << "without the corners of the other tetrahedron";
  EXPECT_THAT(warnings_, ElementsAre("2 hexahedra are left out", "1 prisms are left out", "1 pyramids are left out",
                                     "1 tetrahedra of higher order are read as their corners"));
}

TEST_F(MeshIo, GmshErrors) {
  const auto error2 = [this](const std::string& from, const std::string& to) {
    return Error("a.msh", Replaced(kGmsh2, from, to));
  };
  const auto error4 = [this](const std::string& from, const std::string& to) {
    return Error("a.msh", Replaced(kGmsh4, from, to));
  };
  EXPECT_EQ(Error("a.msh", "$NOD\n1\n1 0 0 0\n"),
            "a.msh:1: Gmsh format 1 is not read; save the mesh in format 2.2 or 4.1");
  EXPECT_EQ(error4("4.1 0", "4 0"), "a.msh:2: Gmsh format '4' is not read; save the mesh in format 2.2 or 4.1");
  EXPECT_EQ(error4("4.1 0", "4.1 2"), "a.msh:2: the file type 2, neither 0 for text nor 1 for binary");
  EXPECT_EQ(error2("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ""),
            "a.msh:1: '$PhysicalNames' where the section $MeshFormat was expected");
  EXPECT_EQ(error2("$EndPhysicalNames\n", ""), "a.msh:4: the file ends before $EndPhysicalNames");
  EXPECT_EQ(error2("5\n1 0", "4000000000\n1 0"), "a.msh:9: 4000000000 nodes announced, but only 165 bytes follow");
  EXPECT_EQ(error2("5\n1 0", "4\n1 0"), "a.msh:14: '5' where $EndNodes was expected");
  EXPECT_EQ(error2("20 1 0 0", "1 1 0 0"), "a.msh:11: a second node with the number 1");
  EXPECT_EQ(error2("2.5", "x"), "a.msh:12: 'x' where a coordinate was expected");
  EXPECT_EQ(error2("4 4 0 5", "4 4 -1 5"), "a.msh:21: -1 as a number of tags");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 21 1\n"), "a.msh:21: node 21 is not among the 5 nodes read");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 20 5\n"), "a.msh:21: a tetrahedron has vertex 5 twice");
  EXPECT_EQ(error2(" 3 4000000000\n", " 3\n"), "a.msh:20: a tetrahedron has vertex 3 twice");
  EXPECT_EQ(error2(" 3 4000000000\n", " 4000000000\n"), "a.msh:20: an element of type 4 with too few nodes");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 20 1 4\n"), "a.msh:21: an element of type 4 with too many nodes");
  EXPECT_EQ(error2("$EndElements\n", "$EndElements\n$Nodes\n0\n$EndNodes\n"), "a.msh:23: a second section $Nodes");
  EXPECT_EQ(error2("$EndElements\n", ""), "a.msh:21: the file ends before all 4 elements are read");
  EXPECT_EQ(error4("2 5 1 9", "2 6 1 9"), "a.msh:24: 6 nodes announced, but the blocks have 5");
  EXPECT_EQ(error4("3 3 1 3", "2 3 1 3"), "a.msh:31: 3 elements announced, but the blocks have 2");
}

// --------------------------------------------------------------------------------------- TetGen

const char kNodes[] =
    "# made by hand\n"
    "5 3 1 1\n"
    "1 0 0 0  0.5 0\n"
    "2 1 0 0  0.5 1\n"
    "3 0 2.5 0  0.5 0  # a comment\n"
    "4 0 0 1  0.5 0\n"
    "5 1 1 -1e-3  0.5 0\n"
    "# the end\n";

const char kElements[] =
    "2 4 1\n"
    "1 1 2 3 4  7\n"
    "2 5 3 2 1  -8.0\n";

class TetGen : public MeshIoTest {
 protected:
  TetMesh ReadPair(const std::string& nodes, const std::string& elements) {
    WriteText(folder_ / "a.node", nodes);
    return Read("a.ele", elements);
  }

  std::string ErrorOfPair(const std::string& nodes, const std::string& elements) {
    WriteText(folder_ / "a.node", nodes);
    return Error("a.ele", elements);
  }
};

TEST_F(TetGen, ReadsEitherFileWithTheOther) {
  const TetMesh mesh = ReadPair(kNodes, kElements);
  ExpectTwoTets(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre(7, -8));
  EXPECT_THAT(mesh.feature_edges, IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
  ExpectTwoTets(ReadTetMesh(folder_ / "a.node"));
  std::filesystem::remove(folder_ / "a.node");
  EXPECT_EQ(ErrorOf("a.ele"), "a.node: cannot be read: No such file or directory");
}

TEST_F(TetGen, CountsFromZeroOrOne) {
  ExpectTwoTets(ReadPair("5\n0 0 0 0\n1 1 0 0\n2 0 2.5 0\n3 0 0 1\n4 1 1 -0.001", "2\n0 0 1 2 3\n1 4 2 1 0"));
  ExpectTwoTets(ReadPair(WithCrLf(kNodes), WithCrLf(kElements)));
  // The elements need not count as the nodes do.
  ExpectTwoTets(ReadPair(kNodes, Replaced(Replaced(kElements, "1 1 2 3 4", "0 1 2 3 4"), "2 5 3", "1 5 3")));
}

TEST_F(TetGen, ReadsTenNodesAsCorners) {
  std::string nodes = "14 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 2.5 0\n3 0 0 1\n4 1 1 -0.001\n";
  for (int i = 5; i < 14; ++i) {
    nodes += std::to_string(i) + " 0 0 9\n";
  }
  const std::string elements = "2 10 0\n0 0 1 2 3 4 5 6 7 8 9\n1 4 2 1 0 5 6 7 8 9 10\n";
  WriteText(folder_ / "a.edge", "1 1\n0 1 2 13 4\n");
  const TetMesh mesh = ReadPair(nodes, elements);
  EXPECT_EQ(mesh.points.size(), 14);
  EXPECT_THAT(mesh.tets, ElementsAre(std::array<int, 4>{0, 1, 2, 3}, std::array<int, 4>{4, 2, 1, 0}));
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{1, 2}));
  // As TetGen 1.5 writes them, on the edges 3 4, 1 4, 1 2, 2 3, 2 4 and 1 3. Where the tetrahedra differ, one is kept.
  EXPECT_THAT(mesh.mid_edge_nodes, ElementsAre(std::array{5, 0, 1}, std::array{6, 0, 1}, std::array{7, 1, 2},
                                               std::array{8, 1, 2}, std::array{9, 0, 2}, std::array{10, 1, 4}));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(TetGen, MarkedEdgesAreFeatures) {
  WriteText(folder_ / "a.edge", "4 1\n1 1 2 3\n2 2 3 0\n3 5 1 -1\n4 4 5 1\n");
  EXPECT_THAT(ReadPair(kNodes, kElements).feature_edges,
              ElementsAre(std::array<int, 2>{0, 1}, std::array<int, 2>{0, 4}));
  EXPECT_THAT(warnings_, ElementsAre("1 marked lines are no edges of the mesh and left out"));
  WriteText(folder_ / "a.edge", "1 0\n1 1 2\n");
  EXPECT_THAT(ReadPair(kNodes, kElements).feature_edges, IsEmpty());
}

TEST_F(TetGen, AttributesThatAreNoIntegersAreNoRegions) {
  EXPECT_THAT(ReadPair(kNodes, Replaced(kElements, "-8.0", "0.5")).regions, IsEmpty());
  EXPECT_THAT(ReadPair(kNodes, Replaced(kElements, "-8.0", "1e300")).regions, IsEmpty());
}

TEST_F(TetGen, Errors) {
  const auto node_error = [this](const std::string& from, const std::string& to) {
    return ErrorOfPair(Replaced(kNodes, from, to), kElements);
  };
  const auto element_error = [this](const std::string& from, const std::string& to) {
    return ErrorOfPair(kNodes, Replaced(kElements, from, to));
  };
  EXPECT_EQ(node_error("5 3 1 1", "1000000000000 3"),
            "a.node:2: 1000000000000 nodes announced, but only 107 bytes follow");
  EXPECT_EQ(node_error("5 3 1 1", "5 2 1 1"), "a.node:2: 2 as the dimension");
  EXPECT_EQ(node_error("5 3 1 1", "5 3 1000000000 1"), "a.node:2: 1000000000 as the number of attributes");
  EXPECT_EQ(node_error("1 0 0 0", "2 0 0 0"), "a.node:3: node 2 where 0 or 1 is the first");
  EXPECT_EQ(node_error("5 1 1", "6 1 1"), "a.node:7: node 6 where 5 was expected");
  EXPECT_EQ(node_error("2.5", "nan"), "a.node:5: nan where a finite number was expected for a coordinate");
  EXPECT_EQ(node_error("5 3 1 1", "4 3 1 1"), "a.node:7: more nodes than announced");
  EXPECT_EQ(element_error("2 4 1", "2 8 1"), "a.ele:1: tetrahedra of 8 nodes, not 4 or 10");
  EXPECT_EQ(element_error("2 4 1", "2 4 1 5"), "a.ele:1: more on this line than the first line of the file announces");
  EXPECT_EQ(element_error("5 3 2 1", "6 3 2 1"), "a.ele:3: vertex index 6 is out of range 1..5");
  EXPECT_EQ(element_error("5 3 2 1", "5 3 2 3"), "a.ele:3: a tetrahedron has vertex 3 twice");
  EXPECT_EQ(element_error("2 5 3 2 1  -8.0\n", "2 5 3 2 1\n"),
            "a.ele:3: the file ends before all 2 tetrahedra are read");
  EXPECT_EQ(element_error("2 4 1", "0 4 1"), "a.ele:2: more tetrahedra than announced");
  EXPECT_EQ(ErrorOfPair("version https://git-lfs", kElements),
            "a.node: this is a Git LFS pointer (fetch the mesh with 'git lfs pull'), not a TetGen file as the "
            "extension says");
}

// ------------------------------------------------------------------------------- OpenVolumeMesh

const char kOvm[] =
    "OVM ASCII\n"
    "Vertices\n5\n"
    "0 0 0\n1 0 0\n0 2.5 0\n0 0 1\n1 1 -1e-3\n"
    "Edges\n9\n"
    "0 1\n1 2\n2 0\n0 3\n1 3\n2 3\n4 2\n4 1\n4 0\n"
    "Faces\n7\n"
    "3 0 2 4\n"    // 0 1 2
    "3 0 8 7\n"    // 0 1 3
    "3 2 10 9\n"   // 1 2 3
    "3 4 6 11\n"   // 2 0 3
    "3 12 3 15\n"  // 4 2 1
    "3 12 4 17\n"  // 4 2 0
    "3 14 1 17\n"  // 4 1 0
    "Polyhedra\n2\n"
    "4 0 2 4 6\n"
    "4 8 10 12 1\n";

/// The same tetrahedra from other first corners.
void ExpectTwoTetsInAnyOrder(const TetMesh& mesh) {
  ASSERT_EQ(mesh.points.size(), 5);
  EXPECT_EQ(mesh.points[4], Eigen::Vector3d(1, 1, -0.001));
  EXPECT_THAT(mesh.tets,
              ElementsAre(testing::UnorderedElementsAre(0, 1, 2, 3), testing::UnorderedElementsAre(4, 2, 1, 0)));
}

TEST_F(MeshIo, OpenVolumeMesh) {
  const TetMesh mesh = Read("a.ovm", kOvm);
  ExpectTwoTetsInAnyOrder(mesh);
  EXPECT_EQ(mesh.tets[0], (std::array<int, 4>{0, 1, 2, 3}));  // the first half-face as it is turned, then the rest
  EXPECT_THAT(mesh.regions, IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(Read("a.ovm", Replaced(kOvm, "4 0 2 4 6", "4 1 2 4 6")).tets[0], (std::array<int, 4>{1, 0, 2, 3}));
  ExpectTwoTetsInAnyOrder(Read("a.ovm", WithCrLf(kOvm)));
  ExpectTwoTetsInAnyOrder(
      Read("a.ovm", Replaced(Replaced(kOvm, "Vertices", "VERTICES"), "Faces", "EProp int \"x\"\n1 2\nfaces")));
  ExpectTwoTetsInAnyOrder(Read("a.ovm", std::string(kOvm) + "VProp int \"Vertices\"\n1\n2\n"));
}

TEST_F(MeshIo, OpenVolumeMeshOtherCells) {
  // A pyramid over 0 1 2 3 with its tip at 4, and something of five triangles.
  const std::string text =
      "OVM ASCII\nVertices\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\nEdges\n9\n"
      "0 1\n1 2\n2 3\n3 0\n0 4\n1 4\n2 4\n3 4\n0 2\n"
      "Faces\n9\n4 0 2 4 6\n3 0 10 9\n3 2 12 11\n3 4 14 13\n3 6 8 15\n"
      "3 0 2 17\n3 16 12 9\n3 4 6 16\n3 0 10 9\nPolyhedra\n3\n5 0 2 4 6 8\n4 2 4 10 12\n5 2 4 10 12 14\n";
  EXPECT_THAT(Read("a.ovm", text).tets, ElementsAre(testing::UnorderedElementsAre(0, 1, 2, 4)));
  EXPECT_THAT(warnings_, ElementsAre("1 polyhedra are left out", "1 pyramids are left out"));
}

TEST_F(MeshIo, OpenVolumeMeshErrors) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.ovm", Replaced(kOvm, from, to));
  };
  EXPECT_EQ(error("ASCII", "BINARY"), "a.ovm:1: an OpenVolumeMesh file of kind 'BINARY' is not read, only 'ASCII'");
  EXPECT_EQ(error("Vertices\n5", "Vertices\n999999999999"),
            "a.ovm:3: 999999999999 vertices announced, but only 187 bytes follow");
  EXPECT_EQ(error("0 1\n1 2", "0 5\n1 2"), "a.ovm:11: 5 as a vertex index is out of range 0..4");
  EXPECT_EQ(error("3 0 2 4", "3 0 18 4"), "a.ovm:22: 18 as a half-edge is out of range 0..17");
  EXPECT_EQ(error("3 0 2 4", "3 0 3 4"), "a.ovm:22: half-edge 3 does not begin where the one before it ends");
  EXPECT_EQ(error("3 0 2 4", "3 0 2 5"), "a.ovm:22: half-edge 5 does not begin where the one before it ends");
  EXPECT_EQ(error("3 0 2 4", "3 0 2 10"), "a.ovm:22: a face that is not closed");
  EXPECT_EQ(error("3 0 2 4", "2 0 1"), "a.ovm:22: a face of 2 half-edges");
  EXPECT_EQ(error("4 0 2 4 6", "4 0 2 4 14"), "a.ovm:31: 14 as a half-face is out of range 0..13");
  EXPECT_EQ(error("4 0 2 4 6", "3 0 2 4"), "a.ovm:31: a cell of 3 half-faces");
  EXPECT_EQ(error("4 0 2 4 6", "4 0 2 4 4"), "a.ovm:31: a cell of four triangles that is no tetrahedron");
  EXPECT_EQ(error("4 0 2 4 6", "4 0 2 4 8"), "a.ovm:31: a cell of four triangles that is no tetrahedron");
  EXPECT_EQ(error("Polyhedra", "Cells"), "a.ovm:32: the section Polyhedra is missing");
}

// ----------------------------------------------------------------------------------------- .tet

const char kTet[] =
    "5 vertices\n"
    "2 tets\n"
    "0 0 0\n1 0 0\n0 2.5 0\n0 0 1\n1 1 -1e-3\n"
    "4 0 1 2 3\n"
    "4 4 2 1 0\n";

TEST_F(MeshIo, Tet) {
  ExpectTwoTets(Read("a.tet", kTet));
  ExpectTwoTets(Read("a.tet", WithCrLf(kTet)));
  ExpectTwoTets(Read("a.tet", Replaced(kTet, "2 tets", "4 cells") + "8 0 1 2 3 4 0 1 2\n# a comment\n5 0 1 2 3 4"));
  EXPECT_THAT(warnings_, ElementsAre("1 hexahedra are left out", "1 pyramids are left out"));
}

TEST_F(MeshIo, TetErrors) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.tet", Replaced(kTet, from, to));
  };
  EXPECT_EQ(error("vertices", "nodes"), "a.tet:1: 'nodes' where 'vertices' was expected");
  EXPECT_EQ(error("2 tets", "20 tets"), "a.tet:2: 20 cells announced, but only 62 bytes follow");
  EXPECT_EQ(error("2.5", "inf"), "a.tet:5: inf where a finite number was expected for a coordinate");
  EXPECT_EQ(error("4 4 2 1 0", "4 5 2 1 0"), "a.tet:9: vertex index 5 is out of range 0..4");
  EXPECT_EQ(error("4 4 2 1 0", "3 4 2 1"), "a.tet:9: a cell of 3 vertices");
  EXPECT_EQ(error("2 tets", "1 tets"), "a.tet:9: more cells than announced");
}

// --------------------------------------------------------------------------------- any format

TEST_F(MeshIo, SaysWhatTheFileReallyIs) {
  EXPECT_EQ(Error("a.mesh", ""), "a.mesh: the file is empty");
  EXPECT_EQ(Error("a.vtk", " \n\n"), "a.vtk: the file is empty");
  EXPECT_EQ(Error("a.mesh", "version https://git-lfs.github.com/spec/v1\noid"),
            "a.mesh: this is a Git LFS pointer (fetch the mesh with 'git lfs pull'), not a Medit "
            "mesh as the extension says");
  EXPECT_EQ(Error("a.mesh", "MFEM mesh v1.0\n"),
            "a.mesh: this is an MFEM mesh, not a Medit mesh as the extension says");
  EXPECT_EQ(Error("a.msh", "(1 \"fluent\")\n"),
            "a.msh: this is an ANSYS Fluent mesh, not a Gmsh mesh as the extension says");
  EXPECT_EQ(Error("a.vtk", kMedit), "a.vtk: this is a Medit mesh, not a legacy VTK file as the extension says");
  EXPECT_EQ(Error("a.mesh", std::string("\1\0\0\0\2\0\0\0", 8)),
            "a.mesh: this is binary data, not a Medit mesh as the extension says");
  EXPECT_EQ(Error("a.mesh", "hello\tworld\n"), "a.mesh:1: 'hello' where a Medit mesh has MeshVersionFormatted");
  EXPECT_EQ(Error("a.stl", kMedit),
            "a.stl: the extension '.stl' is not one of .mesh (Medit), .vtk (legacy VTK), .vtu (VTK XML), .msh (Gmsh), "
            ".ovm (OpenVolumeMesh), .tet (vertices and tets), .node (TetGen), .ele (TetGen)");
  EXPECT_EQ(Error("a.tet", "OVM ASCII\n"),
            "a.tet: this is an OpenVolumeMesh file, not a .tet file as the extension says");
  EXPECT_EQ(Error("a.vtk", "<?xml version=\"1.0\"?>"),
            "a.vtk: this is an XML file, not a legacy VTK file as the extension says");
}

TEST_F(MeshIo, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(ErrorOf("missing.mesh"), "missing.mesh: cannot be read: No such file or directory");
  std::filesystem::create_directory(folder_ / "folder.mesh");
  EXPECT_EQ(ErrorOf("folder.mesh"), "folder.mesh: cannot be read: Is a directory");
}

TEST_F(MeshIo, MessagesQuoteDamagedTextSafely) {
  EXPECT_EQ(Error("a.mesh", "MeshVersionFormatted \x1B[31m\xFF" + std::string(100, 'x')),
            "a.mesh:1: '?[31m?xxxxxxxxxxxxxxxxxxxxxxxxxx...' where the format version was expected");
}

TEST_F(MeshIo, NumbersBelowTheSmallestDoubleAreZero) {
  EXPECT_EQ(Read("a.mesh", Replaced(kMedit, "-1e-3", "-1e-999")).points[4].z(), 0.0);
  EXPECT_EQ(Read("a.mesh", Replaced(kMedit, "-1e-3", "+1e-999")).points[4].z(), 0.0);
  EXPECT_EQ(Read("a.mesh", Replaced(kMedit, "-1e-3", "4.9e-324")).points[4].z(), 4.9e-324);
}

TEST_F(MeshIo, ReadsNumbersAlikeInAnyLocale) {
  const ScopedCommaLocale locale;
  ExpectTwoTets(Read("a.mesh", kMedit));
}

}  // namespace
}  // namespace octupole
