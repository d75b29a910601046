#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "octupole/tet_mesh.h"
#include "octupole/text_tokenizer.h"

namespace octupole::internal {

/// What a file holds: the tetrahedral mesh and a count of what is not in it.
struct ParsedMesh {
  TetMesh mesh;
  /// How many of `mesh.tets` are the corners of second- or third-order tetrahedra.
  int curved_tets = 0;
  /// The cells that are left out, by their kind in the plural ("hexahedra").
  std::map<std::string, std::int64_t> other_cells;
};

inline constexpr const char* kTriangles = "triangles";
inline constexpr const char* kQuadrilaterals = "quadrilaterals";
inline constexpr const char* kHexahedra = "hexahedra";
inline constexpr const char* kPrisms = "prisms";
inline constexpr const char* kPyramids = "pyramids";

// The readers throw std::runtime_error "path:line: message"; `path` only labels it.
ParsedMesh ReadMedit(const std::string& path, std::string_view text);
ParsedMesh ReadVtk(const std::string& path, std::string_view text);
ParsedMesh ReadGmsh(const std::string& path, std::string_view text);

/// Reads one point.
inline Eigen::Vector3d NextPoint(TextTokenizer& tokens) {
  Eigen::Vector3d point;
  for (double& x : point) {
    x = tokens.NextReal("a coordinate");
  }
  return point;
}

/// Reads the four vertices of a tetrahedron. `index_of` turns a vertex number of the file into an
/// index into the points, or throws.
template <typename IndexOf>
std::array<int, 4> NextTet(TextTokenizer& tokens, const IndexOf& index_of) {
  std::array<int, 4> tet;
  for (int i = 0; i < 4; ++i) {
    const std::int64_t number = tokens.NextInteger("a vertex index");
    tet[i] = index_of(number);
    for (int j = 0; j < i; ++j) {
      if (tet[i] == tet[j]) {
        tokens.Fail("a tetrahedron has vertex " + std::to_string(number) + " twice");
      }
    }
  }
  return tet;
}

/// The `index_of` of formats that number all vertices in order from `first`.
inline int IndexInOrder(const TextTokenizer& tokens, std::int64_t number, int first, std::size_t num_points) {
  if (number < first || number - first >= static_cast<std::int64_t>(num_points)) {
    tokens.Fail("vertex index " + std::to_string(number) + " is out of range " + std::to_string(first) + ".." +
                std::to_string(static_cast<std::int64_t>(num_points) + first - 1));
  }
  return static_cast<int>(number - first);
}

}  // namespace octupole::internal
