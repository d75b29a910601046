// Writes what the fuzzers start from: make_seeds FOLDER makes FOLDER/<reader>/<name> for each reader.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "mesh_writers.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

/// A cube of six tetrahedra of three regions, with some features.
TetMesh MakeMesh() {
  TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1.0, 2.5, 1e-3});
  mesh.regions = {0, 7, 7, -8, -8, -8};
  for (int i = 0; i < 3; ++i) {
    mesh.feature_edges.push_back({mesh.tets[0][0], mesh.tets[0][i + 1]});
  }
  mesh.feature_points = {0, 7};
  for (const auto& [a, b, c, d] : mesh.tets) mesh.surface_triangles.push_back({a, b, c});
  mesh.surface_tags = {1, 1, 2, 3, -1, 0};
  return mesh;
}

void WriteSeeds(const std::filesystem::path& folder) {
  const auto write = [&](const char* reader, const char* name, const std::string& text) {
    std::filesystem::create_directories(folder / reader);
    WriteText(folder / reader / name, text);
  };
  const TetMesh mesh = MakeMesh();
  write("medit", "features", MeditText(mesh));
  write("medit", "sections",
        "MeshVersionFormatted 1 Dimension 3 Tetrahedra 1 1 2 3 4 5\n# a comment\nRidges 1 1 Triangles 9 1 2 3 0\n"
        "Vertices 4 0 0 0 0 +1 0 0 0 0 1e-400 .5 0 0 0 1 0\nRequiredEdges 1 2 Edges 2 1 2 0 2 3 0 Hexahedra 0 Corners "
        "1 4 End");
  write("tet", "tets", TetText(mesh));
  write("tet", "cells",
        "4 vertices\r\n2 cells\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n# x\r\n6 0 1 2 0 1 2\r\n4 0 1 2 3");
  write("ovm", "box", OpenVolumeMeshText(mesh));
  const TetGenTexts texts = MakeTetGenTexts(mesh);
  const std::string zero(1, '\0');
  write("tetgen", "all", texts.nodes + zero + texts.elements + zero + texts.edges);
  write("tetgen", "second_order",
        "10 3 1 1\n1 0 0 0 .5 1\n2 1 0 0 .5 1\n3 0 1 0 .5 1\n4 0 0 1 .5 1\n5 0 0 0 .5 1\n6 0 0 0 .5 1\n7 0 0 0 .5 1\n"
        "8 0 0 0 .5 1\n9 0 0 0 .5 1\n10 0 0 0 .5 1\n" +
            zero + "1 10 1 # x\n1 1 2 3 4 5 6 7 8 9 10 2.0" + zero + "1 1\n1 1 2 5 1\n");
  for (const auto& [name, encoding] : {std::pair("text", Encoding::kText), std::pair("little", Encoding::kLittleEndian),
                                       std::pair("big", Encoding::kBigEndian)}) {
    write("gmsh", (std::string("2_") + name).c_str(), GmshFile(mesh, false, encoding));
    write("gmsh", (std::string("4_") + name).c_str(), GmshFile(mesh, true, encoding));
    write("vtu", name, VtuFile(mesh, encoding));
  }
  for (const auto& [name, encoding] : {std::pair("text", Encoding::kText), std::pair("binary", Encoding::kBigEndian)}) {
    write("vtk", (std::string("3_") + name).c_str(), VtkFile(mesh, false, encoding));
    write("vtk", (std::string("5_") + name).c_str(), VtkFile(mesh, true, encoding));
  }
  write("vtk", "field",
        "# vtk DataFile Version 4.2\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
        "METADATA\nINFORMATION 0\n\nCELLS 2 9\n4 0 1 2 3\n3 2 1 0\nCELL_TYPES 2\n10 4\nCELL_DATA 2\n"
        "VECTORS v float\n0 0 0 1 1 1\nFIELD f 2\na 2 2 double\n0 1 2 3\nb 1 2 long\n4 5\n");
  write("gmsh", "other",
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"x\"\n$EndPhysicalNames\n$Nodes\n2 4 1 9\n"
        "2 2 1 1\n9\n.5 0 0 .5 .5\n3 1 0 3\n1\n2\n3000000000\n0 0 0\n1 0 0\n0 1 1\n$EndNodes\n$Elements\n2 2 1 2\n"
        "2 2 2 1\n1 1 2 9\n3 1 4 1\n2 1 2 9 3000000000\n$EndElements\n");
  write("gmsh", "second_order",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n"
        "7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n2\n1 9 2 0 3 1 2 3 5 6 7\n"
        "2 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n");
  std::filesystem::create_directories(folder / "vtu");
  WriteVtu(folder / "vtu/compressed", mesh, {});

  write("obj", "polygons",
        "# x\no part\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 2e-3\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3 4/1\nf -4 -3 -1\n");
  write("off", "text", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n");
  write("off", "coloured", "COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 .1 .2 .3\n0 1 0 1 2 3 4\n3 0 1 2 7\n");
  const std::string ply_header =
      " 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  write("ply", "text", "ply\nformat ascii" + ply_header + "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n");
  write("ply", "binary",
        "ply\nformat binary_little_endian" + ply_header + std::string(39, '\0') + "\3" + std::string(4, '\0') + "\1" +
            std::string(3, '\0') + "\2" + std::string(3, '\0'));
  write("stl", "text",
        "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\nendloop\nendfacet\n"
        "endsolid x\n");
  write("stl", "binary",
        std::string(80, ' ') + "\1" + std::string(3, '\0') + std::string(26, '\0') + "\x80\x3f" +
            std::string(14, '\0') + "\x80\x3f" + std::string(6, '\0'));
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 2;
  }
  try {
    octupole::WriteSeeds(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_seeds: %s\n", error.what());
    return 1;
  }
}
