#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {
namespace {

/// The plural under which cells are counted that are no tetrahedra.
const char* OtherCells(std::int64_t num_vertices) {
  switch (num_vertices) {
    case 5:
      return kPyramids;
    case 6:
      return kPrisms;
    case 8:
      return kHexahedra;
    default:
      return kPolyhedra;
  }
}

int ReadHeaderLine(TextTokenizer& tokens, const char* items, int words_each, std::string_view expected,
                   std::string_view or_expected) {
  const int count = tokens.NextCount(items, words_each);
  if (const std::string_view word = tokens.NextWord(); word != expected && word != or_expected) {
    tokens.Fail(Quoted(word) + " where '" + std::string(expected) + "' was expected");
  }
  return count;
}

}  // namespace

ParsedMesh ReadTet(const NamedText& file) {
  TextTokenizer tokens(file.path, file.text, '#');
  const int num_points = ReadHeaderLine(tokens, "vertices", 3, "vertices", "vertices");
  const int num_cells = ReadHeaderLine(tokens, "cells", 5, "tets", "cells");
  ParsedMesh result;
  TetMesh& mesh = result.mesh;
  mesh.points.reserve(num_points);
  for (int i = 0; i < num_points; ++i) {
    mesh.points.push_back(NextPoint(tokens));
  }
  mesh.tets.reserve(num_cells);
  for (int c = 0; c < num_cells; ++c) {
    const std::int64_t size = tokens.NextInteger("a cell's number of vertices");
    if (size == 4) {
      mesh.tets.push_back(
          NextTet(tokens, [&](std::int64_t number) { return IndexInOrder(tokens, number, 0, mesh.points.size()); }));
    } else if (size > 4) {
      ++result.other_cells[OtherCells(size)];
      tokens.SkipWords(size);
    } else {
      tokens.Fail("a cell of " + std::to_string(size) + " vertices");
    }
  }
  if (!tokens.AtEnd()) {
    tokens.NextWord();
    tokens.Fail("more cells than announced");
  }
  return result;
}

}  // namespace octupole::internal
