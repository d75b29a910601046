#include <algorithm>
#include <optional>
#include <stdexcept>

#include "octupole/mesh_readers.h"

namespace octupole::internal {
namespace {

bool IsKeyword(std::string_view word) {
  const char c = word.front();
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// The plural under which cells that are left out are counted, or null.
const char* OtherCells(std::string_view keyword) {
  if (keyword == "Triangles") return kTriangles;
  if (keyword == "Quadrilaterals") return kQuadrilaterals;
  if (keyword == "Hexahedra" || keyword == "Hexaedra") return kHexahedra;
  if (keyword == "Prisms" || keyword == "Pentahedra") return kPrisms;
  if (keyword == "Pyramids") return kPyramids;
  return nullptr;
}

/// A section that is longer than its count was cut off or counted wrongly: do not guess.
void CheckSectionEnd(TextTokenizer& tokens, const char* what) {
  if (!tokens.AtEnd() && !IsKeyword(tokens.NextWord())) {
    tokens.Fail(std::string("more ") + what + " than announced");
  }
}

void SetOnce(std::optional<TextTokenizer>& section, const TextTokenizer& start, std::string_view keyword) {
  if (section) {
    start.Fail("a second section " + std::string(keyword));
  }
  section = start;
}

}  // namespace

ParsedMesh ReadMedit(const std::string& path, std::string_view text) {
  TextTokenizer tokens(path, text, '#');
  if (const std::string_view word = tokens.NextWord(); word != "MeshVersionFormatted") {
    tokens.Fail(Quoted(word) + " where a Medit mesh has MeshVersionFormatted");
  }
  if (const int version = tokens.NextInt("the format version"); version < 1 || version > 4) {
    tokens.Fail("Medit version " + std::to_string(version) + " is not 1..4");
  }

  // Find the sections first, whatever their order. The others are skipped from keyword to keyword,
  // since their counts are wrong in some files.
  ParsedMesh result;
  std::optional<TextTokenizer> vertices;
  std::optional<TextTokenizer> tetrahedra;
  while (!tokens.AtEnd()) {
    const std::string_view word = tokens.NextWord();
    if (word == "End") {
      break;
    }
    if (word == "Dimension") {
      if (const int dimension = tokens.NextInt("the dimension"); dimension != 3) {
        tokens.Fail("a mesh of dimension " + std::to_string(dimension) + ", not 3");
      }
    } else if (word == "Vertices") {
      SetOnce(vertices, tokens, word);
    } else if (word == "Tetrahedra") {
      SetOnce(tetrahedra, tokens, word);
    } else if (const char* kind = OtherCells(word)) {
      result.other_cells[kind] += std::max(0, tokens.NextInt("the number of cells"));
    }
  }
  if (!vertices) {
    throw std::runtime_error(path + ": the section Vertices is missing");
  }

  TetMesh& mesh = result.mesh;
  const int num_points = vertices->NextCount("vertices", 4);
  mesh.points.reserve(num_points);
  for (int i = 0; i < num_points; ++i) {
    mesh.points.push_back(NextPoint(*vertices));
    vertices->NextInteger("a vertex tag");
  }
  CheckSectionEnd(*vertices, "vertices");

  if (tetrahedra) {
    const int num_tets = tetrahedra->NextCount("tetrahedra", 5);
    mesh.tets.reserve(num_tets);
    mesh.regions.reserve(num_tets);
    const auto index_of = [&](std::int64_t number) { return IndexInOrder(*tetrahedra, number, 1, mesh.points.size()); };
    for (int t = 0; t < num_tets; ++t) {
      mesh.tets.push_back(NextTet(*tetrahedra, index_of));
      mesh.regions.push_back(tetrahedra->NextInt("a region tag"));
    }
    CheckSectionEnd(*tetrahedra, "tetrahedra");
  }
  return result;
}

}  // namespace octupole::internal
