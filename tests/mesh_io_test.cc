#include "octupole/mesh_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "test_files.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

class MeshIo : public testing::Test {
 protected:
  TetMesh Read(const std::string& name, const std::string& text) {
    WriteText(folder_ / name, text);
    warnings_.clear();
    return ReadTetMesh(folder_ / name, &warnings_);
  }

  /// The message of the error, without the folder.
  std::string Error(const std::string& name, const std::string& text) {
    WriteText(folder_ / name, text);
    return ErrorOf(name);
  }

  std::string ErrorOf(const std::string& name) {
    const std::string message = MessageOf<std::runtime_error>([&] { ReadTetMesh(folder_ / name); });
    const std::string prefix = folder_.path().string() + "/";
    EXPECT_THAT(message, StartsWith(prefix));
    return message.substr(std::min(prefix.size(), message.size()));
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

/// Every good text of these tests holds the points (0, 0, 0), (1, 0, 0), (0, 2.5, 0), (0, 0, 1),
/// (1, 1, -0.001) and two tetrahedra.
void ExpectTwoTets(const TetMesh& mesh) {
  EXPECT_THAT(mesh.points, ElementsAre(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2.5, 0),
                                       Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 1, -0.001)));
  EXPECT_THAT(mesh.tets, ElementsAre(std::array<int, 4>{0, 1, 2, 3}, std::array<int, 4>{4, 2, 1, 0}));
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  if (position == std::string::npos) {
    ADD_FAILURE() << "'" << from << "' is not in the text";
    return text;
  }
  return text.replace(position, from.size(), to);
}

std::string WithCrLf(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '\n' ? "\r\n" : std::string(1, c);
  }
  return result;
}

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
  EXPECT_THAT(warnings_, ElementsAre("1 hexahedra are left out", "1 prisms are left out", "1 pyramids are left out",
                                     "1 tetrahedra of higher order are read as their corners"));
}

TEST_F(MeshIo, VtkErrors) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.vtk", Replaced(kVtk, from, to));
  };
  EXPECT_EQ(error("Version 3.0", "Version 1.0"), "a.vtk:1: VTK versions 2.0 to 5.1 are read, not '1.0'");
  EXPECT_EQ(error("ASCII", "BINARY"), "a.vtk:3: binary VTK is not read; save the mesh as ASCII");
  EXPECT_EQ(error("UNSTRUCTURED_GRID", "POLYDATA"),
            "a.vtk:4: a dataset of kind 'POLYDATA', only UNSTRUCTURED_GRID is read");
  EXPECT_EQ(error("POINTS 5", "POINTS 4000000000"), "a.vtk:5: 4000000000 points announced, but only 104 bytes follow");
  EXPECT_EQ(error("2.5", "inf"), "a.vtk:7: inf where a finite number was expected for a coordinate");
  EXPECT_EQ(error("CELLS 3 14", "CELLS 3 13"), "a.vtk:11: a cell of 4 vertices does not fit the 13 entries announced");
  EXPECT_EQ(error("CELLS 3 14", "CELLS 3 15"), "a.vtk: the section CELL_TYPES is missing or empty");
  EXPECT_EQ(error("4 4 2 1 0", "4 5 2 1 0"), "a.vtk:11: vertex index 5 is out of range 0..4");
  EXPECT_EQ(error("4 4 2 1 0", "4 4 2 1 2"), "a.vtk:11: a tetrahedron has vertex 2 twice");
  EXPECT_EQ(error("10 5 10", "10 10 10"), "a.vtk:10: a tetrahedron of 3 vertices instead of 4");
  EXPECT_EQ(error("10 5 10", "10 5"), "a.vtk:13: the file ends before all 3 cell types are read");
  EXPECT_EQ(error("CELL_TYPES 3", "CELL_TYPES 2"), "a.vtk:12: 2 cell types for 3 cells");
  EXPECT_EQ(error("10 5 10", "5 5 12"), "a.vtk: no tetrahedra, only 1 hexahedra, 2 triangles");
  EXPECT_EQ(Error("a.vtk", Replaced(kVtk5, "0 4 7 11", "0 4 3 11")), "a.vtk:16: offset 3 does not fit behind 4");
  EXPECT_EQ(Error("a.vtk", Replaced(kVtk5, "0 4 7 11", "0 4 7 10")),
            "a.vtk:18: a tetrahedron of 3 vertices instead of 4");
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
  EXPECT_THAT(warnings_, ElementsAre("2 hexahedra are left out", "1 prisms are left out", "1 pyramids are left out",
                                     "2 tetrahedra of higher order are read as their corners"));
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
  EXPECT_EQ(error4("4.1 0", "4.1 1"), "a.msh:2: binary Gmsh 4.1 is not read; save the mesh as ASCII");
  EXPECT_EQ(error2("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ""),
            "a.msh:1: '$PhysicalNames' where the section $MeshFormat was expected");
  EXPECT_EQ(error2("$EndPhysicalNames\n", ""), "a.msh:21: the file ends before $EndPhysicalNames");
  EXPECT_EQ(error2("5\n1 0", "4000000000\n1 0"), "a.msh:9: 4000000000 nodes announced, but only 165 bytes follow");
  EXPECT_EQ(error2("5\n1 0", "4\n1 0"), "a.msh:14: '5' where $EndNodes was expected");
  EXPECT_EQ(error2("20 1 0 0", "1 1 0 0"), "a.msh:11: a second node with the number 1");
  EXPECT_EQ(error2("2.5", "x"), "a.msh:12: 'x' where a coordinate was expected");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 21 1\n"), "a.msh:21: node 21 is not among the 5 nodes read");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 20 5\n"), "a.msh:21: a tetrahedron has vertex 5 twice");
  EXPECT_EQ(error2(" 3 4000000000\n", " 3\n"), "a.msh:20: a tetrahedron has vertex 3 twice");
  EXPECT_EQ(error2(" 3 4000000000\n", " 4000000000\n"), "a.msh:20: an element of type 4 with too few nodes");
  EXPECT_EQ(error2("5 3 20 1\n", "5 3 20 1 4\n"), "a.msh:21: an element of type 4 with too many nodes");
  EXPECT_EQ(error2("$EndElements\n", ""), "a.msh:21: the file ends before all 4 elements are read");
  EXPECT_EQ(error4("2 5 1 9", "2 6 1 9"), "a.msh:24: 6 nodes announced, but the blocks have 5");
  EXPECT_EQ(error4("3 3 1 3", "2 3 1 3"), "a.msh:31: 3 elements announced, but the blocks have 2");
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
            "a.stl: the extension '.stl' is not one of .mesh (Medit), .vtk (legacy VTK), .msh "
            "(Gmsh)");
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
  EXPECT_EQ(Read("a.mesh", Replaced(kMedit, "-1e-3", "4.9e-324")).points[4].z(), 4.9e-324);
}

TEST_F(MeshIo, ReadsNumbersAlikeInAnyLocale) {
  const ScopedCommaLocale locale;
  ExpectTwoTets(Read("a.mesh", kMedit));
}

}  // namespace
}  // namespace octupole
