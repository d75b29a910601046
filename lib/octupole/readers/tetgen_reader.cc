#include <cmath>
#include <limits>
#include <optional>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {
namespace {

/// The next number of the current line, or `otherwise` if it ends before.
int NextIntOfLine(TextTokenizer& tokens, const char* what, int otherwise) {
  return tokens.AtLineEnd() ? otherwise : tokens.NextInt(what);
}

void CheckRange(const TextTokenizer& tokens, const char* what, int value, int lowest, int highest) {
  if (value < lowest || value > highest) {
    tokens.Fail(std::to_string(value) + " as " + what);
  }
}

/// Reads the number that begins each line. They count on from the first, which is 0 or 1.
void ReadNumber(TextTokenizer& tokens, const char* what, int line, std::optional<int>* first) {
  const std::int64_t number = tokens.NextInteger(what);
  if (!*first) {
    if (number != 0 && number != 1) {
      tokens.Fail(std::string(what) + " " + std::to_string(number) + " where 0 or 1 is the first");
    }
    *first = static_cast<int>(number);
  }
  if (number != **first + static_cast<std::int64_t>(line)) {
    tokens.Fail(std::string(what) + " " + std::to_string(number) + " where " +
                std::to_string(**first + static_cast<std::int64_t>(line)) + " was expected");
  }
}

void EndLine(TextTokenizer& tokens) {
  if (!tokens.AtLineEnd()) {
    tokens.Fail("more on this line than the first line of the file announces");
  }
}

void EndFile(TextTokenizer& tokens, const char* items) {
  if (!tokens.AtEnd()) {
    tokens.NextWord();
    tokens.Fail(std::string("more ") + items + " than announced");
  }
}

constexpr int kMaxColumns = 1000;

/// Returns the number of the first node, 0 or 1.
int ReadNodes(const NamedText& file, std::vector<Eigen::Vector3d>* points) {
  TextTokenizer tokens(file.path, file.text, '#');
  const int count = tokens.NextCount("nodes", 4);
  CheckRange(tokens, "the dimension", NextIntOfLine(tokens, "the dimension", 3), 3, 3);
  const int num_attributes = NextIntOfLine(tokens, "the number of attributes", 0);
  CheckRange(tokens, "the number of attributes", num_attributes, 0, kMaxColumns);
  const int has_markers = NextIntOfLine(tokens, "0 or 1 for boundary markers", 0);
  CheckRange(tokens, "0 or 1 for boundary markers", has_markers, 0, 1);
  EndLine(tokens);
  points->reserve(count);
  std::optional<int> first;
  for (int i = 0; i < count; ++i) {
    ReadNumber(tokens, "node", i, &first);
    points->push_back(NextPoint(tokens));
    tokens.SkipWords(num_attributes + has_markers);
  }
  EndFile(tokens, "nodes");
  return first.value_or(0);
}

void ReadElements(const NamedText& file, int first_node, ParsedMesh* result, int* nodes_each) {
  TextTokenizer tokens(file.path, file.text, '#');
  const int count = tokens.NextCount("tetrahedra", 5);
  *nodes_each = NextIntOfLine(tokens, "the number of nodes of a tetrahedron", 4);
  if (*nodes_each != 4 && *nodes_each != 10) {
    tokens.Fail("tetrahedra of " + std::to_string(*nodes_each) + " nodes, not 4 or 10");
  }
  const int num_attributes = NextIntOfLine(tokens, "the number of attributes", 0);
  CheckRange(tokens, "the number of attributes", num_attributes, 0, kMaxColumns);
  EndLine(tokens);
  TetMesh& mesh = result->mesh;
  mesh.tets.reserve(count);
  bool has_regions = num_attributes > 0;
  std::optional<int> first;
  for (int t = 0; t < count; ++t) {
    ReadNumber(tokens, "tetrahedron", t, &first);
    const auto index_of = [&](std::int64_t number) {
      return IndexInOrder(tokens, number, first_node, mesh.points.size());
    };
    const std::array<int, 4> tet = NextTet(tokens, index_of);
    mesh.tets.push_back(tet);
    for (int i = 0; i < *nodes_each - 4; ++i) {
      const auto [a, b] = kTetGenMidEdges[i];
      mesh.mid_edge_nodes.push_back({index_of(tokens.NextInteger("a vertex index")), tet[a], tet[b]});
    }
    if (num_attributes > 0) {
      // Attributes are real numbers, but regions are integers.
      const double region = tokens.NextReal("an attribute");
      has_regions = has_regions && region == std::rint(region) && std::abs(region) <= std::numeric_limits<int>::max();
      mesh.regions.push_back(has_regions ? static_cast<int>(region) : 0);
      tokens.SkipWords(num_attributes - 1);
    }
  }
  EndFile(tokens, "tetrahedra");
  if (!has_regions) {
    mesh.regions.clear();
  }
}

/// Reads the edges with a marker other than 0. Those of tetrahedra of 10 nodes have their middle as third node.
void ReadEdges(const NamedText& file, int first_node, int nodes_each, TetMesh* mesh) {
  TextTokenizer tokens(file.path, file.text, '#');
  const int count = tokens.NextCount("edges", 3);
  const int has_markers = NextIntOfLine(tokens, "0 or 1 for markers", 0);
  CheckRange(tokens, "0 or 1 for markers", has_markers, 0, 1);
  std::optional<int> first;
  for (int i = 0; i < count; ++i) {
    ReadNumber(tokens, "edge", i, &first);
    std::array<int, 2> edge;
    for (int& v : edge) {
      v = IndexInOrder(tokens, tokens.NextInteger("a vertex index"), first_node, mesh->points.size());
    }
    tokens.SkipWords(nodes_each > 4 ? 1 : 0);
    if (has_markers != 0 && tokens.NextInteger("a marker") != 0) {
      mesh->feature_edges.push_back(edge);
    }
    tokens.SkipLine();  // a neighbouring tetrahedron
  }
  EndFile(tokens, "edges");
}

}  // namespace

ParsedMesh ReadTetGen(const NamedText& nodes, const NamedText& elements, const NamedText* edges) {
  ParsedMesh result;
  const int first_node = ReadNodes(nodes, &result.mesh.points);
  int nodes_each = 4;
  ReadElements(elements, first_node, &result, &nodes_each);
  if (edges != nullptr) {
    ReadEdges(*edges, first_node, nodes_each, &result.mesh);
  }
  return result;
}

}  // namespace octupole::internal
