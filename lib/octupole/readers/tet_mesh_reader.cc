#include "octupole/readers/tet_mesh_reader.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/readers/internal/lower_case.h"
#include "octupole/readers/internal/mesh_readers.h"

namespace octupole {
namespace {

using internal::FileContent;
using internal::NamedText;
using internal::ParsedMesh;

struct Format {
  std::string_view extension;
  std::string_view name;
  std::string_view name_with_article;
  /// How such a file begins, if all do alike.
  std::string_view signature;
  /// Null for those that take more than one file.
  ParsedMesh (*read)(const NamedText& file);
};

constexpr Format kFormats[] = {
    {".mesh", "Medit", "a Medit mesh", "MeshVersionFormatted", internal::ReadMedit},
    {".vtk", "legacy VTK", "a legacy VTK file", "# vtk DataFile", internal::ReadVtk},
    {".vtu", "VTK XML", "a VTU file", "<", internal::ReadVtu},
    {".msh", "Gmsh", "a Gmsh mesh", "$", internal::ReadGmsh},
    {".ovm", "OpenVolumeMesh", "an OpenVolumeMesh file", "OVM", internal::ReadOpenVolumeMesh},
    {".tet", "vertices and tets", "a .tet file", "", internal::ReadTet},
    {".node", "TetGen", "a TetGen file", "", nullptr},
    {".ele", "TetGen", "a TetGen file", "", nullptr},
};

/// Files that are seen under these extensions but hold something else.
constexpr std::pair<std::string_view, std::string_view> kOtherContents[] = {
    {"version https://git-lfs", "a Git LFS pointer (fetch the mesh with 'git lfs pull')"},
    {"MFEM mesh", "an MFEM mesh"},
    {"(", "an ANSYS Fluent mesh"},
    {"<", "an XML file"},
};

bool StartsWith(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

const Format& FormatOfExtension(const std::filesystem::path& path) {
  const std::string extension = internal::LowerCase(path.extension().string());
  for (const Format& format : kFormats) {
    if (format.extension == extension) {
      return format;
    }
  }
  std::string extensions;
  for (const Format& format : kFormats) {
    extensions +=
        (extensions.empty() ? "" : ", ") + std::string(format.extension) + " (" + std::string(format.name) + ")";
  }
  throw std::runtime_error(path.string() + ": the extension '" + extension + "' is not one of " + extensions);
}

void CheckContent(const std::string& path, std::string_view text, const Format& format) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) {
    throw std::runtime_error(path + ": the file is empty");
  }
  text.remove_prefix(begin);
  if (!format.signature.empty() && StartsWith(text, format.signature)) {
    return;
  }
  const auto fail = [&](std::string_view content) {
    throw std::runtime_error(path + ": this is " + std::string(content) + ", not " +
                             std::string(format.name_with_article) + " as the extension says");
  };
  for (const auto& [signature, content] : kOtherContents) {
    if (StartsWith(text, signature)) {
      fail(content);
    }
  }
  for (const Format& other : kFormats) {
    if (!other.signature.empty() && StartsWith(text, other.signature)) {
      fail(other.name_with_article);
    }
  }
  constexpr std::size_t kSample = 4096;
  if (text.substr(0, kSample).find('\0') != std::string_view::npos) {
    fail("binary data");
  }
}

/// The text of a file, checked to be of the format as far as that shows.
std::string_view TextOf(const std::filesystem::path& path, const FileContent& content, const Format& format) {
  std::string_view text = content.text();
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; StartsWith(text, kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  CheckContent(path.string(), text, format);
  return text;
}

/// The .node, the .ele and the .edge file of which one is given.
std::array<std::filesystem::path, 3> TetGenFiles(const std::filesystem::path& path) {
  const auto beside = [&](const char* extension) {
    return path.extension() == extension ? path : std::filesystem::path(path).replace_extension(extension);
  };
  const bool is_upper_case = path.extension() == ".NODE" || path.extension() == ".ELE";
  return {beside(is_upper_case ? ".NODE" : ".node"), beside(is_upper_case ? ".ELE" : ".ele"),
          beside(is_upper_case ? ".EDGE" : ".edge")};
}

/// Reads the .node and the .ele file, of which either may be given, and the .edge file if there is one.
ParsedMesh ReadTetGenFiles(const std::filesystem::path& path, const Format& format) {
  const auto [nodes, elements, edges] = TetGenFiles(path);
  const FileContent node_content(nodes);
  const FileContent element_content(elements);
  const NamedText node_file{nodes.string(), TextOf(nodes, node_content, format)};
  const NamedText element_file{elements.string(), TextOf(elements, element_content, format)};
  if (!std::filesystem::exists(edges)) {
    return internal::ReadTetGen(node_file, element_file, nullptr);
  }
  const FileContent edge_content(edges);
  const NamedText edge_file{edges.string(), TextOf(edges, edge_content, format)};
  return internal::ReadTetGen(node_file, element_file, &edge_file);
}

/// For each feature edge, in ascending order, whether it is an edge of a tetrahedron.
std::vector<bool> FindInMesh(const TetMesh& mesh, const std::vector<std::array<int, 2>>& edges) {
  // The edges of smaller vertex v are those from begin[v] to begin[v + 1].
  std::vector<std::size_t> begin(mesh.points.size() + 1, 0);
  for (const auto& edge : edges) {
    ++begin[edge[0] + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<bool> is_found(edges.size(), false);
  for (const std::array<int, 4>& tet : mesh.tets) {
    for (const auto& [i, j] : internal::kTetEdges) {
      const auto [a, b] = std::minmax(tet[i], tet[j]);
      const auto last = edges.begin() + static_cast<std::ptrdiff_t>(begin[a + 1]);
      const auto edge = std::lower_bound(edges.begin() + static_cast<std::ptrdiff_t>(begin[a]), last, std::array{a, b});
      if (edge != last && (*edge)[1] == b) {
        is_found[edge - edges.begin()] = true;
      }
    }
  }
  return is_found;
}

/// Whether these different edges of the mesh are all that it has.
bool AreAllEdges(const TetMesh& mesh, const std::vector<std::array<int, 2>>& edges) {
  // The cheap test first: there are more edges than tetrahedra.
  if (edges.size() < mesh.tets.size()) {
    return false;
  }
  std::size_t num_edges = 0;
  const auto sorted = internal::SortedSimplices(mesh.tets, internal::kTetEdges, mesh.points.size());
  internal::ForEachDistinct(sorted, [&](const auto&, int) { ++num_edges; });
  return num_edges == edges.size();
}

template <typename Feature>
void SortWithoutCopies(std::vector<Feature>* features) {
  std::sort(features->begin(), features->end());
  features->erase(std::unique(features->begin(), features->end()), features->end());
}

/// Sorts the features, keeps each once, and drops what is not in the mesh.
void TidyFeatures(TetMesh* mesh, std::vector<std::string>* warnings) {
  for (std::array<int, 2>& edge : mesh->feature_edges) {
    std::sort(edge.begin(), edge.end());
  }
  SortWithoutCopies(&mesh->feature_edges);
  SortWithoutCopies(&mesh->feature_points);

  std::vector<std::array<int, 2>> edges;
  if (!mesh->feature_edges.empty()) {
    const std::vector<bool> is_in_mesh = FindInMesh(*mesh, mesh->feature_edges);
    for (std::size_t e = 0; e < is_in_mesh.size(); ++e) {
      if (is_in_mesh[e]) {
        edges.push_back(mesh->feature_edges[e]);
      }
    }
  }
  std::vector<int> points;
  if (!mesh->feature_points.empty()) {
    const std::vector<bool> is_used = CornersOfTets(*mesh);
    std::copy_if(mesh->feature_points.begin(), mesh->feature_points.end(), std::back_inserter(points),
                 [&](int v) { return is_used[v]; });
  }
  const auto warn = [&](std::size_t before, std::size_t after, const char* what) {
    if (before > after && warnings != nullptr) {
      warnings->push_back(std::to_string(before - after) + what);
    }
  };
  warn(mesh->feature_edges.size(), edges.size(), " marked lines are no edges of the mesh and left out");
  warn(mesh->feature_points.size(), points.size(), " marked points are not in the mesh and left out");
  if (AreAllEdges(*mesh, edges)) {
    // Some programs list every edge of a mesh, which marks none.
    warn(edges.size(), 0, " marked lines are all edges of the mesh and not heeded");
    edges.clear();
  }
  mesh->feature_edges = std::move(edges);
  mesh->feature_points = std::move(points);
}

/// Drops degenerate triangles; keeps each mid-edge node once, if it is no corner of a tetrahedron.
void TidySurfaceAndNodes(TetMesh* mesh) {
  std::size_t num_kept = 0;
  for (std::size_t t = 0; t < mesh->surface_triangles.size(); ++t) {
    const auto [a, b, c] = mesh->surface_triangles[t];
    if (a == b || b == c || c == a) continue;
    mesh->surface_triangles[num_kept] = {a, b, c};
    mesh->surface_tags[num_kept++] = mesh->surface_tags[t];
  }
  mesh->surface_triangles.resize(num_kept);
  mesh->surface_tags.resize(num_kept);

  std::vector<std::array<int, 3>>& nodes = mesh->mid_edge_nodes;
  if (nodes.empty()) return;
  for (auto& [node, a, b] : nodes) {
    if (b < a) std::swap(a, b);
  }
  std::sort(nodes.begin(), nodes.end());
  const auto is_same = [](const auto& one, const auto& other) { return one[0] == other[0]; };
  nodes.erase(std::unique(nodes.begin(), nodes.end(), is_same), nodes.end());
  const std::vector<bool> is_corner = CornersOfTets(*mesh);
  const auto is_corner_too = [&](const std::array<int, 3>& node) { return is_corner[node[0]]; };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), is_corner_too), nodes.end());
}

}  // namespace

namespace internal {

int NumVolumeCorners(std::string_view kind) {
  return kind == kHexahedra ? 8 : kind == kPrisms ? 6 : kind == kPyramids ? 5 : 0;
}

ParsedMesh ReadAnyMesh(const std::filesystem::path& path, bool with_other_volumes) {
  const Format& format = FormatOfExtension(path);
  if (format.read == nullptr) return ReadTetGenFiles(path, format);
  const FileContent content(path);
  return format.read({path.string(), TextOf(path, content, format), with_other_volumes});
}

TetMesh FinishMesh(const std::string& path, ParsedMesh parsed, std::vector<std::string>* warnings) {
  if (parsed.mesh.tets.empty()) {
    std::string others;
    for (const auto& [kind, count] : parsed.other_cells) {
      others += (others.empty() ? ", only " : ", ") + std::to_string(count) + " " + kind;
    }
    throw std::runtime_error(path + ": no tetrahedra" + others);
  }
  if (warnings != nullptr) {
    for (const auto& [kind, count] : parsed.other_cells) {
      if (kind != kTriangles && kind != kQuadrilaterals && count > 0) {
        warnings->push_back(std::to_string(count) + " " + kind + " are left out");
      }
    }
    warnings->insert(warnings->end(), parsed.warnings.begin(), parsed.warnings.end());
    if (parsed.curved_tets > 0) {
      warnings->push_back(std::to_string(parsed.curved_tets) + " tetrahedra of higher order are read as their corners");
    }
  }
  TidyFeatures(&parsed.mesh, warnings);
  TidySurfaceAndNodes(&parsed.mesh);
  return std::move(parsed.mesh);
}

}  // namespace internal

TetMesh ReadTetMesh(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  return internal::FinishMesh(path.string(), internal::ReadAnyMesh(path), warnings);
}

std::vector<std::filesystem::path> TetMeshFiles(const std::filesystem::path& path) {
  const std::string extension = internal::LowerCase(path.extension().string());
  if (extension != ".node" && extension != ".ele") return {path};
  const auto files = TetGenFiles(path);
  return {files.begin(), files.end()};
}

}  // namespace octupole
