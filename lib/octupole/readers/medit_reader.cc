#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {
namespace {

bool IsKeyword(std::string_view word) {
  const char c = word.front();
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// The plural under which cells that are left out are counted, or null.
const char* OtherCells(std::string_view keyword) {
  if (keyword == "Quadrilaterals") return kQuadrilaterals;
  if (keyword == "Hexahedra" || keyword == "Hexaedra") return kHexahedra;
  if (keyword == "Prisms" || keyword == "Pentahedra") return kPrisms;
  if (keyword == "Pyramids") return kPyramids;
  return nullptr;
}

class MeditReader {
 public:
  explicit MeditReader(const NamedText& file)
      : path_(file.path), tokens_(file.path, file.text, '#'), with_other_volumes_(file.with_other_volumes) {}

  ParsedMesh Read() {
    ReadHeader();
    // Sections that come before the vertices are read after them.
    std::vector<std::pair<std::string, TextTokenizer>> later;
    while (!tokens_.AtEnd()) {
      const std::string keyword(tokens_.NextWord());
      if (keyword == "End") {
        break;
      }
      if (IsSection(keyword)) {
        if (!found_.insert(keyword).second) {
          tokens_.Fail("a second section " + keyword);
        }
        if (found_.count("Vertices") > 0) {
          ReadSection(keyword, tokens_);
          continue;
        }
        later.emplace_back(keyword, tokens_);
      } else if (keyword == "Triangles") {
        triangles_.push_back(tokens_);
        result_.other_cells[kTriangles] += std::max(0, tokens_.NextInt("the number of cells"));
      } else if (keyword == "Dimension") {
        if (const int dimension = tokens_.NextInt("the dimension"); dimension != 3) {
          tokens_.Fail("a mesh of dimension " + std::to_string(dimension) + ", not 3");
        }
      } else if (const char* kind = OtherCells(keyword)) {
        if (with_other_volumes_ && NumVolumeCorners(kind) > 0) later.emplace_back(keyword, tokens_);
        result_.other_cells[kind] += std::max(0, tokens_.NextInt("the number of cells"));
      }
      // From keyword to keyword, since the counts of other sections are wrong in some files.
      tokens_.SkipToLetter();
    }
    if (found_.count("Vertices") == 0) {
      throw std::runtime_error(path_ + ": the section Vertices is missing");
    }
    for (auto& [keyword, start] : later) {
      ReadSection(keyword, start);
    }
    for (const TextTokenizer& start : triangles_) {
      ReadTriangles(start);
    }
    SelectFeatureEdges();
    return std::move(result_);
  }

 private:
  void ReadHeader() {
    if (const std::string_view word = tokens_.NextWord(); word != "MeshVersionFormatted") {
      tokens_.Fail(Quoted(word) + " where a Medit mesh has MeshVersionFormatted");
    }
    if (const int version = tokens_.NextInt("the format version"); version < 1 || version > 4) {
      tokens_.Fail("Medit version " + std::to_string(version) + " is not 1..4");
    }
    tokens_.SkipToLetter();
  }

  static bool IsSection(std::string_view keyword) {
    return keyword == "Vertices" || keyword == "Tetrahedra" || keyword == "Edges" || keyword == "Ridges" ||
           keyword == "RequiredEdges" || keyword == "Corners";
  }

  void ReadSection(std::string_view keyword, TextTokenizer& tokens) {
    const char* items = "edge numbers";
    if (keyword == "Vertices") {
      items = "vertices";
      ReadVertices(tokens, tokens.NextCount(items, 4));
    } else if (keyword == "Tetrahedra") {
      items = "tetrahedra";
      ReadTetrahedra(tokens, tokens.NextCount(items, 5));
    } else if (keyword == "Edges") {
      items = "edges";
      ReadEdges(tokens, tokens.NextCount(items, 3));
    } else if (const char* kind = OtherCells(keyword)) {
      items = kind;
      ReadVolumes(tokens, kind);
    } else if (keyword == "Corners") {
      items = "corners";
      const int count = tokens.NextCount(items, 1);
      for (int i = 0; i < count; ++i) {
        result_.mesh.feature_points.push_back(NextVertex(tokens));
      }
    } else {
      const int count = tokens.NextCount(items, 1);
      for (int i = 0; i < count; ++i) {
        named_edges_.push_back(tokens.NextInteger("an edge number"));
      }
    }
    CheckEnd(tokens, items);
  }

  /// A section that is longer than its count was cut off or counted wrongly: do not guess.
  static void CheckEnd(TextTokenizer behind, const char* items) {
    if (!behind.AtEnd() && !IsKeyword(behind.NextWord())) {
      behind.Fail(std::string("more ") + items + " than announced");
    }
  }

  /// Triangles only say what surfaces there are, and wrong ones are common, so that those do no harm.
  void ReadTriangles(TextTokenizer tokens) {
    TetMesh& mesh = result_.mesh;
    const std::size_t num_before = mesh.surface_triangles.size();
    try {
      const int count = tokens.NextCount("triangles", 4);
      for (int i = 0; i < count; ++i) {
        const int a = NextVertex(tokens), b = NextVertex(tokens), c = NextVertex(tokens);
        mesh.surface_triangles.push_back({a, b, c});
        mesh.surface_tags.push_back(tokens.NextInt("a surface tag"));
      }
      CheckEnd(tokens, "triangles");
    } catch (const std::runtime_error& error) {
      mesh.surface_triangles.resize(num_before);
      mesh.surface_tags.resize(num_before);
      result_.warnings.push_back(std::string("the surface tags are left out: ") + error.what());
    }
  }

  int IndexOf(const TextTokenizer& tokens, std::int64_t number) const {
    return IndexInOrder(tokens, number, 1, result_.mesh.points.size());
  }

  int NextVertex(TextTokenizer& tokens) const { return IndexOf(tokens, tokens.NextInteger("a vertex index")); }

  void ReadVertices(TextTokenizer& tokens, int count) {
    result_.mesh.points.reserve(count);
    for (int i = 0; i < count; ++i) {
      result_.mesh.points.push_back(NextPoint(tokens));
      tokens.NextInteger("a vertex tag");
    }
  }

  void ReadTetrahedra(TextTokenizer& tokens, int count) {
    TetMesh& mesh = result_.mesh;
    mesh.tets.reserve(count);
    mesh.regions.reserve(count);
    for (int t = 0; t < count; ++t) {
      mesh.tets.push_back(NextTet(tokens, [&](std::int64_t number) { return IndexOf(tokens, number); }));
      mesh.regions.push_back(tokens.NextInt("a region tag"));
    }
  }

  void ReadVolumes(TextTokenizer& tokens, const char* kind) {
    const int num_corners = NumVolumeCorners(kind);
    const int count = tokens.NextCount(kind, num_corners + 1);
    for (int i = 0; i < count; ++i) {
      std::array<int, 8>& corners = result_.other_volumes.emplace_back();
      corners.fill(-1);
      for (int k = 0; k < num_corners; ++k) corners[k] = NextVertex(tokens);
      tokens.NextInteger("a region tag");
    }
  }

  void ReadEdges(TextTokenizer& tokens, int count) {
    edges_.reserve(count);
    for (int i = 0; i < count; ++i) {
      const int a = NextVertex(tokens);
      const int b = NextVertex(tokens);
      edges_.push_back({a, b});
      tokens.NextInteger("an edge tag");
    }
  }

  /// Ridges and RequiredEdges say by their numbers which edges matter. Without them, all do.
  void SelectFeatureEdges() {
    std::vector<std::array<int, 2>>& features = result_.mesh.feature_edges;
    if (found_.count("Ridges") + found_.count("RequiredEdges") == 0) {
      features = std::move(edges_);
    }
    for (const std::int64_t number : named_edges_) {
      if (number < 1 || number > static_cast<std::int64_t>(edges_.size())) {
        throw std::runtime_error(path_ + ": Ridges or RequiredEdges name edge " + std::to_string(number) +
                                 ", out of range 1.." + std::to_string(edges_.size()));
      }
      features.push_back(edges_[number - 1]);
    }
  }

  std::string path_;
  TextTokenizer tokens_;
  bool with_other_volumes_;
  ParsedMesh result_;
  std::set<std::string> found_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<std::int64_t> named_edges_;
  /// Where sections of triangles begin, behind the keyword.
  std::vector<TextTokenizer> triangles_;
};

}  // namespace

ParsedMesh ReadMedit(const NamedText& file) { return MeditReader(file).Read(); }

}  // namespace octupole::internal
