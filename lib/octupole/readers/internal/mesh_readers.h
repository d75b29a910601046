#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "octupole/mesh/tet_mesh.h"
#include "octupole/readers/internal/text_tokenizer.h"

namespace octupole::internal {

/// What a file holds: the tetrahedral mesh and a count of what is not in it.
struct ParsedMesh {
  /// Its features, surface triangles and mid-edge nodes are as they are in the file: doubled, degenerate or none of the
  /// mesh's edges and faces.
  TetMesh mesh;
  /// How many of `mesh.tets` are the corners of tetrahedra of third or higher order.
  int curved_tets = 0;
  /// What else the user should know.
  std::vector<std::string> warnings;
  /// The cells that are left out, by their kind in the plural ("hexahedra").
  std::map<std::string, std::int64_t> other_cells;
  /// Where they were wanted, of those the corners of hexahedra, prisms and pyramids in the order of the file; -1 behind
  /// the last.
  std::vector<std::array<int, 8>> other_volumes;
};

inline constexpr const char* kTriangles = "triangles";
inline constexpr const char* kQuadrilaterals = "quadrilaterals";
inline constexpr const char* kHexahedra = "hexahedra";
inline constexpr const char* kPrisms = "prisms";
inline constexpr const char* kPyramids = "pyramids";
inline constexpr const char* kPolyhedra = "polyhedra";

/// The number of corners of hexahedra, prisms and pyramids; 0 of the other kinds.
int NumVolumeCorners(std::string_view kind);

/// A file in memory; `path` only labels it.
struct NamedText {
  std::string path;
  std::string_view text;
  /// Whether other_volumes are wanted. Else they are not looked at, and may be damaged.
  bool with_other_volumes = false;
};

// The readers throw std::runtime_error "path:line: message".
ParsedMesh ReadMedit(const NamedText& file);
ParsedMesh ReadVtk(const NamedText& file);
ParsedMesh ReadVtu(const NamedText& file);
ParsedMesh ReadGmsh(const NamedText& file);
ParsedMesh ReadOpenVolumeMesh(const NamedText& file);
ParsedMesh ReadTet(const NamedText& file);
/// `edges` may be null.
ParsedMesh ReadTetGen(const NamedText& nodes, const NamedText& elements, const NamedText* edges);

/// The mesh with its features in order, or an error if it has no tetrahedra; `warnings`, if given,
/// receives what is left out.
TetMesh FinishMesh(const std::string& path, ParsedMesh parsed, std::vector<std::string>* warnings);

/// The corners of the edges on which the fifth to the tenth node of a second-order tetrahedron lie, as gmsh, VTK and
/// TetGen (checked on what its option -o2 writes) have them.
inline constexpr std::array<std::array<int, 2>, 6> kGmshMidEdges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
inline constexpr std::array<std::array<int, 2>, 6> kVtkMidEdges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<int, 2>, 6> kTetGenMidEdges = {{{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}}};

/// What a file holds, in the format that its extension names.
ParsedMesh ReadAnyMesh(const std::filesystem::path& path, bool with_other_volumes = false);

/// Reads one point.
inline Eigen::Vector3d NextPoint(TextTokenizer& tokens) {
  Eigen::Vector3d point;
  for (double& x : point) {
    x = tokens.NextReal("a coordinate");
  }
  return point;
}

/// A tetrahedron of four vertex numbers of the file. `index_of` turns a number into an index into the
/// points, or throws.
template <typename IndexOf>
std::array<int, 4> MakeTet(const TextTokenizer& tokens, const std::array<std::int64_t, 4>& numbers,
                           const IndexOf& index_of) {
  std::array<int, 4> tet;
  for (int i = 0; i < 4; ++i) {
    tet[i] = index_of(numbers[i]);
    for (int j = 0; j < i; ++j) {
      if (tet[i] == tet[j]) {
        tokens.Fail("a tetrahedron has vertex " + std::to_string(numbers[i]) + " twice");
      }
    }
  }
  return tet;
}

/// Reads a tetrahedron.
template <typename IndexOf>
std::array<int, 4> NextTet(TextTokenizer& tokens, const IndexOf& index_of) {
  std::array<std::int64_t, 4> numbers;
  for (std::int64_t& number : numbers) {
    number = tokens.NextInteger("a vertex index");
  }
  return MakeTet(tokens, numbers, index_of);
}

/// The index of a vertex in formats that number all vertices in order from `first`.
inline int IndexInOrder(const TextTokenizer& tokens, std::int64_t number, int first, std::size_t num_points) {
  if (number < first || number - first >= static_cast<std::int64_t>(num_points)) {
    tokens.Fail("vertex index " + std::to_string(number) + " is out of range " + std::to_string(first) + ".." +
                std::to_string(static_cast<std::int64_t>(num_points) + first - 1));
  }
  return static_cast<int>(number - first);
}

}  // namespace octupole::internal
