#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "octupole/mesh_readers.h"

namespace octupole::internal {
namespace {

constexpr int kVtkTet = 10;
constexpr int kVtkQuadraticTet = 24;

/// Where the cells are, until the cell types behind them tell which of them to read.
struct CellSection {
  /// At the first cell, or at the connectivity in format 5.
  TextTokenizer start;
  int num_cells;
  /// The words of all cells, with their leading counts in formats before 5.
  int num_words;
  /// Format 5 only: where each cell begins, one more than cells.
  std::vector<std::int64_t> offsets;
};

/// The plural of cells that are left out, or null for points and lines.
const char* OtherCells(int type) {
  switch (type) {
    case 5:
    case 6:
    case 22:
      return kTriangles;
    case 8:
    case 9:
    case 23:
    case 28:
      return kQuadrilaterals;
    case 11:
    case 12:
    case 25:
    case 29:
      return kHexahedra;
    case 13:
    case 26:
      return kPrisms;
    case 14:
    case 27:
      return kPyramids;
    case 42:
      return "polyhedra";
    case 71:
      return "Lagrange tetrahedra";
    default:
      return nullptr;
  }
}

bool IsIntegerType(std::string_view type) {
  constexpr std::string_view kIntegerTypes[] = {"char",         "unsigned_char", "short",        "unsigned_short",
                                                "int",          "unsigned_int",  "long",         "unsigned_long",
                                                "vtktypeint64", "vtktypeuint64", "vtktypeint32", "vtkIdType"};
  return std::find(std::begin(kIntegerTypes), std::end(kIntegerTypes), type) != std::end(kIntegerTypes);
}

void ReadHeader(TextTokenizer& tokens) {
  constexpr std::string_view kMagic = "# vtk DataFile Version ";
  const std::string_view magic = tokens.SkipLine();
  if (magic.substr(0, kMagic.size()) != kMagic) {
    tokens.Fail("a legacy VTK file begins with '" + std::string(kMagic) + "'");
  }
  const char major = magic.size() > kMagic.size() ? magic[kMagic.size()] : '0';
  if (major < '2' || major > '5') {
    tokens.Fail("VTK versions 2.0 to 5.1 are read, not " + Quoted(magic.substr(kMagic.size())));
  }
  // The title that follows may be empty or have empty lines around it, so look for the line after.
  std::string_view word;
  do {
    tokens.SkipLine();
    word = tokens.NextWord();
    if (word == "BINARY") {
      tokens.Fail("binary VTK is not read; save the mesh as ASCII");
    }
  } while (word != "ASCII" || !tokens.AtLineEnd());
  if (const std::string_view dataset = tokens.NextWord(); dataset != "DATASET") {
    tokens.Fail(Quoted(dataset) + " where DATASET was expected");
  }
  if (const std::string_view kind = tokens.NextWord(); kind != "UNSTRUCTURED_GRID") {
    tokens.Fail("a dataset of kind " + Quoted(kind) + ", only UNSTRUCTURED_GRID is read");
  }
}

CellSection ReadCellSection(TextTokenizer& tokens) {
  CellSection cells{tokens, tokens.NextCount("cells", 1), tokens.NextCount("cell entries", 1), {}};
  TextTokenizer behind = tokens;
  if (!behind.AtEnd() && behind.NextWord() == "OFFSETS") {
    tokens = behind;
    tokens.NextWord();  // the integer type
    cells.offsets.reserve(cells.num_cells);
    for (int i = 0; i < cells.num_cells; ++i) {
      cells.offsets.push_back(tokens.NextInteger("an offset"));
      const std::int64_t previous = i == 0 ? 0 : cells.offsets[i - 1];
      if (cells.offsets[i] < previous || (i == 0 && cells.offsets[0] != 0)) {
        tokens.Fail("offset " + std::to_string(cells.offsets[i]) + " does not fit behind " + std::to_string(previous));
      }
    }
    cells.num_cells = std::max(0, cells.num_cells - 1);
    if (const std::string_view word = tokens.NextWord(); word != "CONNECTIVITY") {
      tokens.Fail(Quoted(word) + " where CONNECTIVITY was expected");
    }
    tokens.NextWord();  // the integer type
  }
  cells.start = tokens;
  tokens.SkipWords(cells.num_words);
  return cells;
}

/// The first array of one integer per cell among the attributes, or nothing.
std::vector<int> ReadRegions(TextTokenizer& tokens, std::string_view section, int num_cells) {
  std::vector<int> regions;
  bool of_cells = section == "CELL_DATA";
  while (!tokens.AtEnd()) {
    const std::string_view word = tokens.NextWord();
    if (word == "CELL_DATA" || word == "POINT_DATA") {
      of_cells = word == "CELL_DATA";
    } else if (word == "SCALARS" && of_cells) {
      tokens.NextWord();  // the name
      const bool is_integer = IsIntegerType(tokens.NextWord());
      const bool is_single = tokens.AtLineEnd() || tokens.NextInteger("a size") == 1;
      if (!is_integer || !is_single) {
        continue;
      }
      if (tokens.NextWord() != "LOOKUP_TABLE") {
        tokens.Fail("LOOKUP_TABLE was expected");
      }
      tokens.NextWord();  // the name
      regions.reserve(num_cells);
      for (int i = 0; i < num_cells; ++i) {
        regions.push_back(tokens.NextInt("a cell's region tag"));
      }
      break;
    }
  }
  return regions;
}

void ReadCells(const CellSection& section, const std::vector<int>& types, const std::vector<int>& regions,
               ParsedMesh* result) {
  TetMesh& mesh = result->mesh;
  TextTokenizer tokens = section.start;
  const auto index_of = [&](std::int64_t number) { return IndexInOrder(tokens, number, 0, mesh.points.size()); };
  std::int64_t num_words = 0;
  for (int c = 0; c < section.num_cells; ++c) {
    std::int64_t size = 0;
    if (section.offsets.empty()) {
      size = tokens.NextInteger("a cell's number of vertices");
      ++num_words;
    } else {
      size = section.offsets[c + 1] - section.offsets[c];
    }
    if (size < 0 || size > section.num_words - num_words) {
      tokens.Fail("a cell of " + std::to_string(size) + " vertices does not fit the " +
                  std::to_string(section.num_words) + " entries announced");
    }
    num_words += size;
    const int tet_size = types[c] == kVtkTet ? 4 : types[c] == kVtkQuadraticTet ? 10 : 0;
    if (tet_size == 0) {
      if (const char* kind = OtherCells(types[c])) {
        ++result->other_cells[kind];
      }
      tokens.SkipWords(size);
      continue;
    }
    if (size != tet_size) {
      tokens.Fail("a tetrahedron of " + std::to_string(size) + " vertices instead of " + std::to_string(tet_size));
    }
    mesh.tets.push_back(NextTet(tokens, index_of));
    tokens.SkipWords(tet_size - 4);
    result->curved_tets += tet_size > 4;
    if (!regions.empty()) {
      mesh.regions.push_back(regions[c]);
    }
  }
  if (num_words != section.num_words) {
    tokens.Fail("the cells have " + std::to_string(num_words) + " entries, but " + std::to_string(section.num_words) +
                " were announced");
  }
}

}  // namespace

ParsedMesh ReadVtk(const std::string& path, std::string_view text) {
  TextTokenizer tokens(path, text);
  ReadHeader(tokens);
  ParsedMesh result;
  std::vector<Eigen::Vector3d>& points = result.mesh.points;
  std::optional<CellSection> cells;
  std::vector<int> types;
  std::vector<int> regions;
  // What is not one of these sections, such as FIELD or METADATA, is skipped word by word.
  while (!tokens.AtEnd()) {
    const std::string_view word = tokens.NextWord();
    if (word == "POINTS" && points.empty()) {
      const int num_points = tokens.NextCount("points", 3);
      tokens.NextWord();  // the number type
      points.reserve(num_points);
      for (int i = 0; i < num_points; ++i) {
        points.push_back(NextPoint(tokens));
      }
    } else if (word == "CELLS" && !cells) {
      cells = ReadCellSection(tokens);
    } else if (word == "CELL_TYPES" && types.empty()) {
      const int num_types = tokens.NextCount("cell types", 1);
      if (!cells || num_types != cells->num_cells) {
        tokens.Fail(std::to_string(num_types) + " cell types for " + std::to_string(cells ? cells->num_cells : 0) +
                    " cells");
      }
      types.reserve(num_types);
      for (int i = 0; i < num_types; ++i) {
        types.push_back(tokens.NextInt("a cell type"));
      }
    } else if (word == "POINTS" || word == "CELLS" || word == "CELL_TYPES") {
      tokens.Fail("a second section " + std::string(word));
    } else if (word == "CELL_DATA" || word == "POINT_DATA") {
      regions = ReadRegions(tokens, word, static_cast<int>(types.size()));
    }
  }
  for (const auto& [is_missing, section] :
       {std::pair(points.empty(), "POINTS"), std::pair(!cells, "CELLS"), std::pair(types.empty(), "CELL_TYPES")}) {
    if (is_missing) {
      throw std::runtime_error(path + ": the section " + section + " is missing or empty");
    }
  }
  ReadCells(*cells, types, regions, &result);
  return result;
}

}  // namespace octupole::internal
