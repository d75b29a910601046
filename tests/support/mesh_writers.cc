#include "mesh_writers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <vector>

namespace octupole {
namespace {

/// Collects numbers and words, as text or as bytes.
class File {
 public:
  explicit File(Encoding encoding = Encoding::kText) : encoding_(encoding) {}

  bool is_text() const { return encoding_ == Encoding::kText; }

  File& Line(const std::string& text) {
    content_ += text + "\n";
    return *this;
  }

  /// A number of the given type, in text followed by a space.
  template <typename Number>
  File& Put(Number number) {
    if (is_text()) {
      char text[32];
      *std::to_chars(text, text + sizeof(text) - 1, number).ptr = '\0';
      content_ += text;
      content_ += ' ';
      return *this;
    }
    const auto* bytes = reinterpret_cast<const char*>(&number);
    content_.append(bytes, sizeof(number));
    if ((encoding_ == Encoding::kBigEndian) == IsLittleEndian()) {
      std::reverse(content_.end() - sizeof(number), content_.end());
    }
    return *this;
  }

  template <typename Number, typename Numbers>
  File& PutAll(const Numbers& numbers) {
    for (const auto number : numbers) {
      Put(static_cast<Number>(number));
    }
    return *this;
  }

  File& EndLine() {
    content_ += '\n';
    return *this;
  }

  /// Ends a line in text only.
  File& EndTextLine() { return is_text() ? EndLine() : *this; }

  std::string Take() { return std::move(content_); }

  static bool IsLittleEndian() {
    const std::uint16_t one = 1;
    return *reinterpret_cast<const char*>(&one) == 1;
  }

 private:
  Encoding encoding_;
  std::string content_;
};

int RegionOf(const TetMesh& mesh, std::size_t t) { return mesh.regions.empty() ? 0 : mesh.regions[t]; }

/// The cells of VTK: points, lines, triangles, then tetrahedra.
struct Cells {
  std::vector<int> types;
  std::vector<std::int64_t> offsets = {0};
  std::vector<std::int64_t> connectivity;
  std::vector<int> regions;

  explicit Cells(const TetMesh& mesh) {
    for (const int v : mesh.feature_points) {
      Add(1, std::array{v}, 0);
    }
    for (const auto& edge : mesh.feature_edges) {
      Add(3, edge, 0);
    }
    for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
      Add(5, mesh.surface_triangles[t], mesh.surface_tags[t]);
    }
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Add(10, mesh.tets[t], RegionOf(mesh, t));
    }
  }

  template <std::size_t N>
  void Add(int type, const std::array<int, N>& vertices, int region) {
    types.push_back(type);
    connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    regions.push_back(region);
  }
};

}  // namespace

std::string MeditText(const TetMesh& mesh) {
  File file;
  file.Line("MeshVersionFormatted 2\nDimension 3\nVertices").Put(mesh.points.size()).EndLine();
  for (const auto& point : mesh.points) {
    file.PutAll<double>(point).Line("0");
  }
  if (!mesh.feature_edges.empty()) {
    file.Line("Edges").Put(mesh.feature_edges.size()).EndLine();
    for (const auto& [a, b] : mesh.feature_edges) {
      file.Put(a + 1).Put(b + 1).Line("1");
    }
  }
  if (!mesh.surface_triangles.empty()) {
    file.Line("Triangles").Put(mesh.surface_triangles.size()).EndLine();
    for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
      for (const int v : mesh.surface_triangles[t]) {
        file.Put(v + 1);
      }
      file.Put(mesh.surface_tags[t]).EndLine();
    }
  }
  if (!mesh.feature_points.empty()) {
    file.Line("Corners").Put(mesh.feature_points.size()).EndLine();
    for (const int v : mesh.feature_points) {
      file.Put(v + 1).EndLine();
    }
  }
  file.Line("Tetrahedra").Put(mesh.tets.size()).EndLine();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const int v : mesh.tets[t]) {
      file.Put(v + 1);
    }
    file.Put(RegionOf(mesh, t)).EndLine();
  }
  return file.Line("End").Take();
}

std::string TetText(const TetMesh& mesh) {
  File file;
  file.Put(mesh.points.size()).Line("vertices").Put(mesh.tets.size()).Line("tets");
  for (const auto& point : mesh.points) {
    file.PutAll<double>(point).EndLine();
  }
  for (const auto& tet : mesh.tets) {
    file.Put(4).PutAll<int>(tet).EndLine();
  }
  return file.Take();
}

TetGenTexts MakeTetGenTexts(const TetMesh& mesh) {
  File nodes, elements, edges;
  nodes.Put(mesh.points.size()).Line("3 0 0");
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    nodes.Put(v).PutAll<double>(mesh.points[v]).EndLine();
  }
  const bool has_regions = !mesh.regions.empty();
  elements.Put(mesh.tets.size()).Line(has_regions ? "4 1" : "4 0");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    elements.Put(t).PutAll<int>(mesh.tets[t]).Line(has_regions ? std::to_string(mesh.regions[t]) : "");
  }
  edges.Put(mesh.feature_edges.size()).Line("1");
  for (std::size_t e = 0; e < mesh.feature_edges.size(); ++e) {
    edges.Put(e).PutAll<int>(mesh.feature_edges[e]).Line("1");
  }
  return {nodes.Take(), elements.Take(), edges.Take()};
}

std::string OpenVolumeMeshText(const TetMesh& mesh) {
  File vertices, edges, faces, cells;
  for (const auto& point : mesh.points) {
    vertices.PutAll<double>(point).EndLine();
  }
  std::map<std::array<int, 2>, int> edge_numbers;
  const auto half_edge = [&](int from, int to) {
    const auto [edge, is_new] =
        edge_numbers.emplace(std::array{std::min(from, to), std::max(from, to)}, static_cast<int>(edge_numbers.size()));
    if (is_new) {
      edges.PutAll<int>(edge->first).EndLine();
    }
    return 2 * edge->second + (from < to ? 0 : 1);
  };
  std::map<std::array<int, 3>, int> face_numbers;
  for (const auto& tet : mesh.tets) {
    cells.Put(4);
    for (std::array<int, 3> corners : {std::array{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}) {
      std::array<int, 3> face = {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      const bool is_turned = face[2] < face[1];
      if (is_turned) {
        std::swap(face[1], face[2]);
      }
      const auto [number, is_new] = face_numbers.emplace(face, static_cast<int>(face_numbers.size()));
      if (is_new) {
        faces.Put(3).Put(half_edge(face[0], face[1])).Put(half_edge(face[1], face[2])).Put(half_edge(face[2], face[0]));
        faces.EndLine();
      }
      cells.Put(2 * number->second + (is_turned ? 1 : 0));
    }
    cells.EndLine();
  }
  File file;
  file.Line("OVM ASCII\nVertices").Put(mesh.points.size()).Line("\n" + vertices.Take() + "Edges");
  file.Put(edge_numbers.size()).Line("\n" + edges.Take() + "Faces");
  file.Put(face_numbers.size()).Line("\n" + faces.Take() + "Polyhedra");
  return file.Put(mesh.tets.size()).Line("\n" + cells.Take()).Take();
}

namespace {

std::string GmshFile2(const TetMesh& mesh, Encoding encoding) {
  File file(encoding);
  file.Line(file.is_text() ? "$MeshFormat\n2.2 0 8" : "$MeshFormat\n2.2 1 8");
  if (!file.is_text()) {
    file.Put(std::int32_t(1)).EndLine();
  }
  file.Line("$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.points.size()));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    file.Put(static_cast<std::int32_t>(v + 1)).PutAll<double>(mesh.points[v]).EndTextLine();
  }
  const std::size_t num_features = mesh.feature_points.size() + mesh.feature_edges.size();
  file.Line((file.is_text() ? "" : "\n") + std::string("$EndNodes\n$Elements\n") +
            std::to_string(num_features + mesh.surface_triangles.size() + mesh.tets.size()));
  std::int32_t number = 0;
  const auto put = [&](std::int32_t type, std::size_t count, int region, const auto& vertices, bool is_first,
                       int entity = 1) {
    if (file.is_text()) {
      file.Put(++number).Put(type).Put(2);
    } else {
      if (is_first) {
        file.Put(type).Put(static_cast<std::int32_t>(count)).Put(std::int32_t(2));
      }
      file.Put(++number);
    }
    file.Put(static_cast<std::int32_t>(region)).Put(static_cast<std::int32_t>(entity));
    for (const int v : vertices) {
      file.Put(static_cast<std::int32_t>(v + 1));
    }
    file.EndTextLine();
  };
  for (std::size_t i = 0; i < mesh.feature_points.size(); ++i) {
    put(15, mesh.feature_points.size(), 0, std::array{mesh.feature_points[i]}, i == 0);
  }
  for (std::size_t i = 0; i < mesh.feature_edges.size(); ++i) {
    put(1, mesh.feature_edges.size(), 0, mesh.feature_edges[i], i == 0);
  }
  for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
    put(2, mesh.surface_triangles.size(), 99, mesh.surface_triangles[t], t == 0, mesh.surface_tags[t]);
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    put(4, mesh.tets.size(), RegionOf(mesh, t), mesh.tets[t], t == 0, RegionOf(mesh, t));
  }
  return file.Line((file.is_text() ? "" : "\n") + std::string("$EndElements")).Take();
}

/// Each region is a volume with itself as physical tag, each in a block of its tetrahedra.
std::string GmshFile4(const TetMesh& mesh, Encoding encoding) {
  using Size = std::uint64_t;
  File file(encoding);
  file.Line(file.is_text() ? "$MeshFormat\n4.1 0 8" : "$MeshFormat\n4.1 1 8");
  if (!file.is_text()) {
    file.Put(std::int32_t(1)).EndLine();
  }
  std::map<int, std::vector<std::size_t>> tets_of_region;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    tets_of_region[RegionOf(mesh, t)].push_back(t);
  }
  file.Line("$EndMeshFormat\n$Entities");
  file.Put(Size(1)).Put(Size(0)).Put(Size(0)).Put(static_cast<Size>(tets_of_region.size())).EndTextLine();
  file.Put(std::int32_t(1)).PutAll<double>(std::array{0, 0, 0}).Put(Size(0)).EndTextLine();
  std::int32_t volume = 0;
  for (const auto& [region, tets] : tets_of_region) {
    file.Put(++volume).PutAll<double>(std::array{0, 0, 0, 1, 1, 1});
    file.Put(Size(1)).Put(static_cast<std::int32_t>(region)).Put(Size(0)).EndTextLine();
  }
  const auto num_points = static_cast<Size>(mesh.points.size());
  file.Line((file.is_text() ? "" : "\n") + std::string("$EndEntities\n$Nodes"));
  file.Put(Size(1)).Put(num_points).Put(Size(1)).Put(num_points).EndTextLine();
  file.Put(std::int32_t(3)).Put(std::int32_t(1)).Put(std::int32_t(0)).Put(num_points).EndTextLine();
  for (Size v = 1; v <= num_points; ++v) {
    file.Put(v).EndTextLine();
  }
  for (const auto& point : mesh.points) {
    file.PutAll<double>(point).EndTextLine();
  }
  file.Line((file.is_text() ? "" : "\n") + std::string("$EndNodes\n$Elements"));
  const Size num_features = mesh.feature_points.size() + mesh.feature_edges.size();
  const Size num_elements = num_features + mesh.surface_triangles.size() + mesh.tets.size();
  const Size num_blocks = !mesh.feature_points.empty() + !mesh.feature_edges.empty() + mesh.surface_triangles.size() +
                          tets_of_region.size();
  file.Put(num_blocks).Put(num_elements).Put(Size(1)).Put(num_elements).EndTextLine();
  Size number = 0;
  const auto begin_block = [&](int dimension, std::int32_t entity, int type, std::size_t size) {
    file.Put(std::int32_t(dimension)).Put(entity).Put(std::int32_t(type)).Put(static_cast<Size>(size)).EndTextLine();
  };
  const auto put = [&](const auto& vertices) {
    file.Put(++number);
    for (const int v : vertices) {
      file.Put(static_cast<Size>(v) + 1);
    }
    file.EndTextLine();
  };
  if (!mesh.feature_points.empty()) {
    begin_block(0, 1, 15, mesh.feature_points.size());
    for (const int v : mesh.feature_points) {
      put(std::array{v});
    }
  }
  if (!mesh.feature_edges.empty()) {
    begin_block(1, 1, 1, mesh.feature_edges.size());
    for (const auto& edge : mesh.feature_edges) {
      put(edge);
    }
  }
  // A block each, so that they keep their order.
  for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
    begin_block(2, mesh.surface_tags[t], 2, 1);
    put(mesh.surface_triangles[t]);
  }
  volume = 0;
  for (const auto& [region, tets] : tets_of_region) {
    begin_block(3, ++volume, 4, tets.size());
    for (const std::size_t t : tets) {
      put(mesh.tets[t]);
    }
  }
  return file.Line((file.is_text() ? "" : "\n") + std::string("$EndElements")).Take();
}

}  // namespace

std::string GmshFile(const TetMesh& mesh, bool is_version_4, Encoding encoding) {
  return is_version_4 ? GmshFile4(mesh, encoding) : GmshFile2(mesh, encoding);
}

std::string VtkFile(const TetMesh& mesh, bool is_version_5, Encoding encoding) {
  const Cells cells(mesh);
  const std::string num_cells = std::to_string(cells.types.size());
  File file(encoding);
  file.Line("# vtk DataFile Version " + std::string(is_version_5 ? "5.1" : "3.0") + "\nby octupole");
  file.Line(std::string(file.is_text() ? "ASCII" : "BINARY") + "\nDATASET UNSTRUCTURED_GRID");
  file.Line("POINTS " + std::to_string(mesh.points.size()) + " double");
  for (const auto& point : mesh.points) {
    file.PutAll<double>(point).EndTextLine();
  }
  if (is_version_5) {
    file.Line("\nCELLS " + std::to_string(cells.offsets.size()) + " " + std::to_string(cells.connectivity.size()));
    file.Line("OFFSETS vtktypeint64").PutAll<std::int64_t>(cells.offsets);
    file.Line("\nCONNECTIVITY vtktypeint64").PutAll<std::int64_t>(cells.connectivity);
  } else {
    file.Line("\nCELLS " + num_cells + " " + std::to_string(cells.connectivity.size() + cells.types.size()));
    for (std::size_t c = 0; c < cells.types.size(); ++c) {
      file.Put(static_cast<std::int32_t>(cells.offsets[c + 1] - cells.offsets[c]));
      for (auto i = cells.offsets[c]; i < cells.offsets[c + 1]; ++i) {
        file.Put(static_cast<std::int32_t>(cells.connectivity[i]));
      }
      file.EndTextLine();
    }
  }
  file.Line("\nCELL_TYPES " + num_cells).PutAll<std::int32_t>(cells.types);
  if (!mesh.regions.empty()) {
    file.Line("\nCELL_DATA " + num_cells + "\nSCALARS region int 1\nLOOKUP_TABLE default");
    file.PutAll<std::int32_t>(cells.regions);
  }
  return file.EndLine().Take();
}

std::string VtuFile(const TetMesh& mesh, Encoding encoding) {
  const Cells cells(mesh);
  File appended(encoding);
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" +
                    std::string(encoding == Encoding::kBigEndian ? "BigEndian" : "LittleEndian") +
                    "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                    std::to_string(mesh.points.size()) + "\" NumberOfCells=\"" + std::to_string(cells.types.size()) +
                    "\">\n";
  std::string bytes;
  const auto array = [&](const std::string& attributes, const File& values) {
    std::string content = File(values).Take();
    xml += "<DataArray " + attributes + " format=\"";
    if (values.is_text()) {
      xml += "ascii\">\n" + content + "\n</DataArray>\n";
    } else {
      xml += "appended\" offset=\"" + std::to_string(bytes.size()) + "\"/>\n";
      bytes += File(encoding).Put(static_cast<std::uint64_t>(content.size())).Take() + content;
    }
  };
  File points(encoding);
  for (const auto& point : mesh.points) {
    points.PutAll<double>(point).EndTextLine();
  }
  xml += "<Points>\n";
  array("type=\"Float64\" NumberOfComponents=\"3\"", points);
  xml += "</Points>\n<Cells>\n";
  array("type=\"Int64\" Name=\"connectivity\"", File(encoding).PutAll<std::int64_t>(cells.connectivity));
  const std::vector<std::int64_t> ends(cells.offsets.begin() + 1, cells.offsets.end());
  array("type=\"Int64\" Name=\"offsets\"", File(encoding).PutAll<std::int64_t>(ends));
  array("type=\"Int32\" Name=\"types\"", File(encoding).PutAll<std::int32_t>(cells.types));
  xml += "</Cells>\n";
  if (!mesh.regions.empty()) {
    xml += "<CellData>\n";
    array("type=\"Int32\" Name=\"region\"", File(encoding).PutAll<std::int32_t>(cells.regions));
    xml += "</CellData>\n";
  }
  xml += "</Piece>\n</UnstructuredGrid>\n";
  if (encoding != Encoding::kText) {
    xml += "<AppendedData encoding=\"raw\">\n_" + bytes + "\n</AppendedData>\n";
  }
  return xml + "</VTKFile>\n";
}

}  // namespace octupole
