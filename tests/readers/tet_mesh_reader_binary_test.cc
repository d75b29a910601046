// The readers of mesh_io.h for VTU files and for binary Gmsh and legacy VTK. What mesh_writers.h writes is read back,
// and two files that VTK and meshio made.

#include <zlib.h>

#include "mesh_writers.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "tet_mesh_reader_fixture.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A mesh of three regions, with features, of numbers that are hard to round.
TetMesh MakeMarkedMesh() {
  TetMesh mesh = MakeBoxMesh({2, 3, 1}, {1.0 / 3.0, 1e-300, 2e8});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.regions.push_back(static_cast<int>(3 * t / mesh.tets.size()) - 1);
  }
  mesh.feature_edges = {{mesh.tets[0][0], mesh.tets[0][1]}, {mesh.tets[5][2], mesh.tets[5][3]}};
  for (auto& edge : mesh.feature_edges) {
    std::sort(edge.begin(), edge.end());
  }
  std::sort(mesh.feature_edges.begin(), mesh.feature_edges.end());
  mesh.feature_points = {0, 5, 11};
  mesh.surface_triangles = {{mesh.tets[7][3], mesh.tets[7][0], mesh.tets[7][1]},
                            {mesh.tets[0][0], mesh.tets[0][1], mesh.tets[0][2]}};
  mesh.surface_tags = {5, -3};
  return mesh;
}

void ExpectSame(const TetMesh& mesh, const TetMesh& expected) {
  EXPECT_EQ(mesh.points, expected.points);
  EXPECT_EQ(mesh.tets, expected.tets);
  EXPECT_EQ(mesh.regions, expected.regions);
  EXPECT_EQ(mesh.feature_edges, expected.feature_edges);
  EXPECT_EQ(mesh.feature_points, expected.feature_points);
  EXPECT_EQ(mesh.surface_triangles, expected.surface_triangles);
  EXPECT_EQ(mesh.surface_tags, expected.surface_tags);
}

TetMesh MakeTet() {
  return {{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
          {{0, 1, 2, 3}},
          {}};
}

constexpr Encoding kEncodings[] = {Encoding::kText, Encoding::kLittleEndian, Encoding::kBigEndian};

/// Cutting a file anywhere must be noticed, except within the last bytes, which say nothing.
class CutOff : public MeshIoTest {
 protected:
  void ExpectRefusedWhereverCut(const std::string& name, const std::string& text, std::size_t unimportant_end) {
    for (std::size_t size = 0; size < text.size() - unimportant_end; ++size) {
      EXPECT_NE(Error(name, text.substr(0, size)), "") << "cut to " << size << " bytes";
    }
  }
};

using BinaryGmsh = CutOff;

TEST_F(BinaryGmsh, IsReadInEitherByteOrder) {
  const TetMesh mesh = MakeMarkedMesh();
  for (const Encoding encoding : kEncodings) {
    for (const bool is_version_4 : {false, true}) {
      ExpectSame(Read("a.msh", GmshFile(mesh, is_version_4, encoding)), mesh);
      EXPECT_THAT(warnings_, IsEmpty());
    }
  }
}

TEST_F(BinaryGmsh, CutOffIsRefused) {
  for (const bool is_version_4 : {false, true}) {
    const std::string text = GmshFile(MakeTet(), is_version_4, Encoding::kLittleEndian);
    ExpectRefusedWhereverCut("a.msh", text, 1);
  }
}

TEST_F(BinaryGmsh, Errors) {
  const std::string text = GmshFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), true, Encoding::kLittleEndian);
  EXPECT_EQ(Error("a.msh", Replaced(text, "4.1 1 8", "4.1 1 4")), "a.msh:2: binary numbers of 4 bytes, not 8");
  EXPECT_EQ(Error("a.msh", Replaced(text, std::string("\1\0\0\0\n$End", 9), std::string("\1\0\1\0\n$End", 9))),
            "a.msh:byte 24: the number 65537 in binary where 1 was expected");
  // 2^56 nodes more than there are.
  std::string huge = text;
  huge[huge.find("$Nodes\n") + 7 + 15] = '\1';
  EXPECT_EQ(Error("a.msh", huge), "a.msh:byte 227: 72057594037927944 nodes announced, but only " +
                                      std::to_string(text.size() - 227) + " bytes follow");
  std::string version_2 = GmshFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), false, Encoding::kLittleEndian);
  version_2[version_2.find("$Elements\n6\n") + 12] = 99;  // the type
  EXPECT_EQ(Error("a.msh", version_2), "a.msh:byte 320: elements of type 99 are not known");
  // Found by fuzzing: the number of tags less one overflowed.
  std::string tags = GmshFile(MakeTet(), false, Encoding::kLittleEndian);
  tags.replace(tags.find("$Elements\n1\n") + 20, 4, std::string("\0\0\0\x80", 4));
  EXPECT_EQ(Error("a.msh", tags), "a.msh:byte 196: -2147483648 as a number of tags");
}

using BinaryVtk = CutOff;

TEST_F(BinaryVtk, IsRead) {
  const TetMesh mesh = MakeMarkedMesh();
  for (const Encoding encoding : {Encoding::kText, Encoding::kBigEndian}) {
    for (const bool is_version_5 : {false, true}) {
      ExpectSame(Read("a.vtk", VtkFile(mesh, is_version_5, encoding)), mesh);
      EXPECT_THAT(warnings_, IsEmpty());
    }
  }
}

TEST_F(BinaryVtk, CutOffIsRefused) {
  for (const bool is_version_5 : {false, true}) {
    ExpectRefusedWhereverCut("a.vtk", VtkFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), is_version_5, Encoding::kBigEndian),
                             1);
  }
}

TEST_F(BinaryVtk, SkipsOtherAttributesAndTypes) {
  TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  mesh.regions = {1, 2, 3, 4, 5, 6};
  const std::string bytes(6 * 12, '\n');
  const std::string text =
      Replaced(VtkFile(mesh, false, Encoding::kBigEndian), "SCALARS",
               "VECTORS v float\n" + bytes + "\nCOLOR_SCALARS c 2\n" + bytes.substr(0, 12) + "\nTENSORS6 t char\n" +
                   bytes.substr(0, 36) +
                   "\nMETADATA\nINFORMATION 1\nNAME x\n\nLOOKUP_TABLE l 1\n1234\nTEXTURE_COORDINATES x 2 bit\n" +
                   bytes.substr(0, 2) + "\nFIELD f 2\na 2 6 double\n" + bytes + bytes.substr(0, 24) +
                   "\nMETADATA\nCOMPONENT_NAMES\n\nb 1 5 unsigned_int\n" + bytes.substr(0, 20) + "\nSCALARS");
  ExpectSame(Read("a.vtk", text), mesh);
  EXPECT_EQ(Error("a.vtk", Replaced(text, "v float", "v string")).substr(0, 11), "a.vtk:byte ");
  EXPECT_NE(Error("a.vtk", Replaced(text, "VECTORS", "VIKTORS")).find("'VIKTORS' where a section was expected"),
            std::string::npos);
}

using Vtu = MeshIoTest;

// As meshio 5.0.0 writes it, its comment left out.
const char kMeshioVtu[] = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="3">
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="binary">
AQAAAACAAAB4AAAAIQAAAA==eJxjYMAHPtjjlWZgccAvD9OPoP+s/HjJNylgPwDTDAon
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="binary">
AQAAAACAAABQAAAAGwAAAA==eJxjYIAARgZUAOMzQWlmKM2CJo6uDwACaAAP
</DataArray>
<DataArray type="Int64" Name="offsets" format="binary">
AQAAAACAAAAYAAAAEAAAAA==eJxjYoAANijNBaUBAPgAEw==
</DataArray>
<DataArray type="Int64" Name="types" format="binary">
AQAAAACAAAAYAAAADgAAAA==eJxjZoAALjQaAAFQABg=
</DataArray>
</Cells>
<CellData>
<DataArray type="Int64" Name="region" format="binary">
AQAAAACAAAAYAAAAEgAAAA==eJxjYIAAdij94z8EAAAkLAf5
</DataArray>
</CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

// As VTK 9.1 writes it, big-endian and in blocks of 64 bytes, without spaces and ranges.
const char kVtkVtu[] = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="BigEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="3">
<PointData>
</PointData>
<CellData>
<DataArray type="Int64" Name="region" format="appended" offset="0"/>
</CellData>
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="48"/>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="appended" offset="136"/>
<DataArray type="Int64" Name="offsets" format="appended" offset="216"/>
<DataArray type="UInt8" Name="types" format="appended" offset="264"/>
</Cells>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="base64">
_AAAAAQAAAEAAAAAYAAAAEA==eJxjYEAB7P8h4AcAJCwH+Q==AAAAAgAAAEAAAAA4AAAAFQAAABg=eJxjYMAO7D/gkIACBxYIDQAwxAF0eJxjYMAO7D9gp/cHJPle+rjyDwBm/gi0AAAAAgAAAEAAAAAQAAAAFwAAAA8=eJxjYEABjAzY+UxQmhlKs8DEAQEdAA54nGNgAANGBigAAAAZAAI=AAAAAQAAAEAAAAAYAAAAEg==eJxjYAADJgjFwAaluQAAegATAAAAAQAAAEAAAAADAAAACw==eJxj5uICAAAqABg=
</AppendedData>
</VTKFile>
)";

TEST_F(Vtu, FilesOfMeshioAndVtk) {
  for (const char* text : {kMeshioVtu, kVtkVtu}) {
    const TetMesh mesh = Read("a.vtu", text);
    ExpectTwoTets(mesh);
    EXPECT_THAT(mesh.regions, ElementsAre(7, -8));
    EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{0, 1}));
    EXPECT_THAT(warnings_, IsEmpty());
  }
}

TEST_F(Vtu, Base64MayBeBrokenIntoLines) {
  ExpectTwoTets(Read("a.vtu", Replaced(kMeshioVtu, "HPtjjlWZgccAvD9OP", "H\nPtjj\r\nlWZ gccAvD9OP")));
}

TEST_F(Vtu, IsReadInAnyEncoding) {
  const TetMesh mesh = MakeMarkedMesh();
  for (const Encoding encoding : kEncodings) {
    ExpectSame(Read("a.vtu", VtuFile(mesh, encoding)), mesh);
  }
  ExpectSame(Read("a.vtu", WithCrLf(VtuFile(mesh, Encoding::kText))), mesh);
}

TEST_F(Vtu, OurOwnFilesAreReadBack) {
  TetMesh mesh = MakeBoxMesh({20, 20, 20}, {1, 2, 3});  // more than one block of compressed data
  mesh.regions.resize(mesh.tets.size(), 4);
  const std::vector<double> values(mesh.points.size(), 1.5);
  WriteVtu(folder_ / "a.vtu", mesh, {{"values", 1, values.data()}});
  ExpectSame(ReadTetMesh(folder_ / "a.vtu"), mesh);
}

TEST_F(Vtu, PiecesComeOneBehindTheOther) {
  std::string text = VtuFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), Encoding::kText);
  const std::size_t begin = text.find("<Piece"), end = text.find("</UnstructuredGrid>");
  text.insert(begin, text.substr(begin, end - begin));
  const TetMesh one = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  const TetMesh mesh = Read("a.vtu", text);
  ASSERT_EQ(mesh.points.size(), 16);
  ASSERT_EQ(mesh.tets.size(), 12);
  EXPECT_EQ(mesh.points[8], one.points[0]);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.tets[6][i], one.tets[0][i] + 8);
  }
}

TEST_F(Vtu, OtherCells) {
  const TetMesh mesh =
      Read("a.vtu", R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="10" NumberOfCells="5">
<Points><DataArray type="Float32">0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity">3 2 1 0 4 5 6 7 8 9 0 1 2 3 4 5 6 7 0 1 2 3 0 1 2 3 3 2 1</DataArray>
<DataArray type="Int32" Name="offsets">10 18 22 26 29</DataArray><DataArray type="UInt8" Name="types">24 12 42 10 21</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>)");
  EXPECT_THAT(mesh.tets, ElementsAre(std::array<int, 4>{3, 2, 1, 0}, std::array<int, 4>{0, 1, 2, 3}));
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array<int, 2>{2, 3}));
  EXPECT_THAT(mesh.mid_edge_nodes, ElementsAre(std::array{4, 2, 3}, std::array{5, 1, 2}, std::array{6, 1, 3},
                                               std::array{7, 0, 3}, std::array{8, 0, 2}, std::array{9, 0, 1}));
  EXPECT_THAT(warnings_, ElementsAre("1 hexahedra are left out", "1 polyhedra are left out"));
}

TEST_F(Vtu, Errors) {
  const std::string text = VtuFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), Encoding::kText);
  const auto error = [this](const std::string& text, const std::string& from, const std::string& to) {
    return Error("a.vtu", Replaced(text, from, to));
  };
  EXPECT_EQ(error(text, "</Points>", ""), "a.vtu:29: this is no XML: Start-end tags mismatch");
  EXPECT_EQ(error(text, "UnstructuredGrid", "PolyData"),
            "a.vtu:2: a VTK file of type 'PolyData', only UnstructuredGrid is read");
  EXPECT_EQ(error(text, "<UnstructuredGrid>", "<Grid/><UnstructuredGrids>").substr(0, 27),
            "a.vtu:30: this is no XML: S");
  EXPECT_EQ(error(text, "\"8\"", "\"-8\""), "a.vtu:4: '-8' as NumberOfPoints");
  EXPECT_EQ(error(text, "\"8\"", "\"2000000000\""), "a.vtu:6: 6000000000 numbers announced, but only 58 bytes follow");
  EXPECT_EQ(error(text, "\"8\"", "\"7\""), "a.vtu:14: more than 21 numbers");
  EXPECT_EQ(error(text, "\"8\"", "\"9\""), "a.vtu:14: the file ends before all 27 numbers are read");
  EXPECT_EQ(error(text, "\"Float64\"", "\"Real\""), "a.vtu:6: the type 'Real' of a DataArray is not known");
  EXPECT_EQ(error(text, "\"ascii\"", "\"text\""),
            "a.vtu:6: the format 'text' of a DataArray is none of ascii, binary and appended");
  EXPECT_EQ(error(text, "\"3\"", "\"2\""), "a.vtu:6: points of 2 coordinates");
  EXPECT_EQ(error(text, "Name=\"offsets\"", "Name=\"ends\""), "a.vtu:18: the DataArray offsets is missing");
  EXPECT_EQ(error(text, "0 0 0", "0 nan 0"), "a.vtu:7: nan where a finite number was expected for a number");
  EXPECT_EQ(error(text, "0 1 3 7", "0 1 8 7"), "a.vtu:20: vertex index 8 is out of range 0..7");
  EXPECT_EQ(error(text, "0 1 3 7", "0 1 3 3"), "a.vtu:20: a tetrahedron has vertex 3 twice");
  EXPECT_EQ(error(text, "4 8 12", "4 12 8"), "a.vtu:22: offset 8 does not fit behind 12");
  EXPECT_EQ(error(text, "4 8 12", "4 7 12"), "a.vtu:20: a tetrahedron of 3 vertices instead of 4");
  EXPECT_EQ(error(text, "4 8 12 16 20 24", "4 8 12 16 20 9000000000000000000"),
            "a.vtu:19: 9000000000000000000 numbers announced, but only 50 bytes follow");
}

TEST_F(Vtu, ErrorsOfCompressedData) {
  const auto error = [this](const std::string& from, const std::string& to) {
    return Error("a.vtu", Replaced(kMeshioVtu, from, to));
  };
  EXPECT_EQ(error("vtkZLib", "vtkLZMA"),
            "a.vtu:6: data compressed by 'vtkLZMADataCompressor' are not read, only by 'vtkZLibDataCompressor'");
  EXPECT_EQ(error("eJxjYMAHPtjj", "eJxjYMAHPtjk"), "a.vtu:6: the compressed data are damaged");
  EXPECT_EQ(error("eJxjYMAHPtjjlWZgccAv", ""), "a.vtu:6: the data end too early");
  EXPECT_EQ(error("\"5\"", "\"6\""), "a.vtu:6: 120 bytes of data where 144 were expected");
  EXPECT_EQ(error("\"5\"", "\"2000000000\""), "a.vtu:6: 6000000000 numbers announced, but only 51 bytes follow");
  EXPECT_EQ(error("AQAAAACAAAB4AAAAIQAAAA==", "/////wCAAAB4AAAAIQAAAA=="),
            "a.vtu:6: 4294967295 blocks of 32768 bytes, the last of 120, where 120 bytes were expected");
  EXPECT_EQ(error("UnstructuredGrid\" ", "UnstructuredGrid\" header_type=\"UInt16\" "),
            "a.vtu:2: the header type 'UInt16' is neither UInt32 nor UInt64");
}

// A few bytes that inflate to a gigabyte must not do so.
TEST_F(Vtu, CompressedDataGrowToTheirAnnouncedSizeOnly) {
  const std::string zeros(1 << 20, '\0');
  uLongf size = compressBound(zeros.size());
  std::string compressed(size, '\0');
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()),
                     zeros.size()),
            Z_OK);
  compressed.resize(size);
  std::string text = Replaced(VtuFile(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), Encoding::kLittleEndian), "<VTKFile",
                              "<VTKFile compressor=\"vtkZLibDataCompressor\"");
  const std::uint64_t header[] = {1, 192, 0, compressed.size()};  // 8 points
  const std::size_t begin = text.find("\n_") + 2;
  text.replace(begin, 200, std::string(reinterpret_cast<const char*>(header), sizeof(header)) + compressed);
  EXPECT_EQ(Error("a.vtu", text), "a.vtu:6: the compressed data are damaged");
}

// A recursive parser or destructor would overflow the stack.
TEST_F(Vtu, DeeplyNestedElementsAreRefused) {
  std::string text = "<VTKFile>";
  for (int i = 0; i < 1000000; ++i) {
    text += "<a>";
  }
  EXPECT_EQ(Error("a.vtu", text), "a.vtu:1: this is no XML: Start-end tags mismatch");
}

TEST_F(MeshIoTest, AllTextFormatsAreReadAlikeInAnyLocale) {
  const TetMesh marked = MakeMarkedMesh();
  const ScopedCommaLocale locale;
  for (const bool is_new : {false, true}) {
    ExpectSame(Read("a.msh", GmshFile(marked, is_new, Encoding::kText)), marked);
    ExpectSame(Read("a.vtk", VtkFile(marked, is_new, Encoding::kText)), marked);
  }
  ExpectSame(Read("a.vtu", VtuFile(marked, Encoding::kText)), marked);
  TetMesh mesh = marked;
  ExpectSame(Read("a.mesh", MeditText(mesh)), mesh);
  mesh.feature_points.clear();
  mesh.surface_triangles.clear();
  mesh.surface_tags.clear();
  const TetGenTexts texts = MakeTetGenTexts(mesh);
  WriteText(folder_ / "a.node", texts.nodes);
  WriteText(folder_ / "a.edge", texts.edges);
  ExpectSame(Read("a.ele", texts.elements), mesh);
  mesh.regions.clear();
  mesh.feature_edges.clear();
  ExpectSame(Read("a.tet", TetText(mesh)), mesh);
  const TetMesh from_ovm = Read("a.ovm", OpenVolumeMeshText(mesh));
  EXPECT_EQ(from_ovm.points, mesh.points);
  ASSERT_EQ(from_ovm.tets.size(), mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    EXPECT_THAT(from_ovm.tets[t], testing::UnorderedElementsAreArray(mesh.tets[t]));
  }
}

}  // namespace
}  // namespace octupole
