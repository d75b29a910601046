#include <algorithm>
#include <cctype>
#include <optional>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {
namespace {

bool IsEqualInAnyCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// A face as a loop of at most three vertices; larger ones are only counted.
struct Face {
  int num_vertices;
  std::array<int, 3> vertices;
};

class OpenVolumeMeshReader {
 public:
  explicit OpenVolumeMeshReader(const NamedText& file) : tokens_(file.path, file.text) {}

  ParsedMesh Read() {
    if (tokens_.NextWord() != "OVM") {
      tokens_.Fail("an OpenVolumeMesh file begins with 'OVM ASCII'");
    }
    if (const std::string_view kind = tokens_.NextWord(); kind != "ASCII") {
      tokens_.Fail("an OpenVolumeMesh file of kind " + Quoted(kind) + " is not read, only 'ASCII'");
    }
    SkipTo("Vertices");
    const int num_vertices = tokens_.NextCount("vertices", 3);
    result_.mesh.points.reserve(num_vertices);
    for (int i = 0; i < num_vertices; ++i) {
      result_.mesh.points.push_back(NextPoint(tokens_));
    }
    SkipTo("Edges");
    const int num_edges = tokens_.NextCount("edges", 2);
    edges_.reserve(num_edges);
    for (int i = 0; i < num_edges; ++i) {
      const int from = NextIndex("a vertex index", num_vertices);
      const int to = NextIndex("a vertex index", num_vertices);
      edges_.push_back({from, to});
    }
    SkipTo("Faces");
    const int num_faces = tokens_.NextCount("faces", 2);
    faces_.reserve(num_faces);
    for (int i = 0; i < num_faces; ++i) {
      faces_.push_back(NextFace());
    }
    SkipTo("Polyhedra");
    const int num_cells = tokens_.NextCount("cells", 2);
    for (int i = 0; i < num_cells; ++i) {
      ReadCell();
    }
    return std::move(result_);
  }

 private:
  /// Properties may stand between the sections, and a comment of the program that wrote the file.
  void SkipTo(std::string_view keyword) {
    while (!tokens_.AtEnd()) {
      if (IsEqualInAnyCase(tokens_.NextWord(), keyword)) {
        return;
      }
    }
    tokens_.Fail("the section " + std::string(keyword) + " is missing");
  }

  int NextIndex(const char* what, std::int64_t size) {
    const std::int64_t index = tokens_.NextInteger(what);
    if (index < 0 || index >= size) {
      tokens_.Fail(std::to_string(index) + " as " + what + " is out of range 0.." + std::to_string(size - 1));
    }
    return static_cast<int>(index);
  }

  /// Half-edges 2e and 2e + 1 are edge e as it is and the other way round.
  Face NextFace() {
    Face face{tokens_.NextInt("a face's number of half-edges"), {}};
    if (face.num_vertices < 3) {
      tokens_.Fail("a face of " + std::to_string(face.num_vertices) + " half-edges");
    }
    int first = 0;
    int last = 0;
    for (int i = 0; i < face.num_vertices; ++i) {
      const int half_edge = NextIndex("a half-edge", 2 * static_cast<std::int64_t>(edges_.size()));
      auto [from, to] = edges_[half_edge / 2];
      if (half_edge % 2 == 1) {
        std::swap(from, to);
      }
      if (i < 3) {
        face.vertices[i] = from;
      }
      first = i == 0 ? from : first;
      if (i > 0 && from != last) {
        tokens_.Fail("half-edge " + std::to_string(half_edge) + " does not begin where the one before it ends");
      }
      last = to;
    }
    if (last != first) {
      tokens_.Fail("a face that is not closed");
    }
    return face;
  }

  /// Half-faces 2f and 2f + 1 are face f as it is and the other way round.
  void ReadCell() {
    const int num_faces = tokens_.NextInt("a cell's number of half-faces");
    if (num_faces < 4) {
      tokens_.Fail("a cell of " + std::to_string(num_faces) + " half-faces");
    }
    int num_triangles = 0;
    int num_quadrilaterals = 0;
    std::array<int, 4> half_faces = {};
    for (int i = 0; i < num_faces; ++i) {
      const int half_face = NextIndex("a half-face", 2 * static_cast<std::int64_t>(faces_.size()));
      half_faces[i % 4] = half_face;
      num_triangles += faces_[half_face / 2].num_vertices == 3;
      num_quadrilaterals += faces_[half_face / 2].num_vertices == 4;
    }
    const std::array<int, 3> kinds = {num_faces, num_triangles, num_quadrilaterals};
    if (kinds == std::array<int, 3>{4, 4, 0}) {
      AddTet(half_faces);
    } else {
      ++result_.other_cells[kinds == std::array<int, 3>{6, 0, 6}   ? kHexahedra
                            : kinds == std::array<int, 3>{5, 2, 3} ? kPrisms
                            : kinds == std::array<int, 3>{5, 4, 1} ? kPyramids
                                                                   : kPolyhedra];
    }
  }

  /// The first half-face, then the vertex that it lacks.
  void AddTet(const std::array<int, 4>& half_faces) {
    std::array<int, 4> tet = {};
    std::copy_n(faces_[half_faces[0] / 2].vertices.begin(), 3, tet.begin());
    if (half_faces[0] % 2 == 1) {
      std::swap(tet[0], tet[1]);
    }
    for (const int v : faces_[half_faces[1] / 2].vertices) {
      if (std::find(tet.begin(), tet.begin() + 3, v) == tet.begin() + 3) {
        tet[3] = v;
      }
    }
    // Each of the four triangles has to lack another one of the four vertices.
    int lacking = 0;
    for (const int half_face : half_faces) {
      int corners = 0;
      for (const int v : faces_[half_face / 2].vertices) {
        corners |= 1 << (std::find(tet.begin(), tet.end(), v) - tet.begin());
      }
      for (int i = 0; i < 4; ++i) {
        lacking |= corners == 15 - (1 << i) ? 1 << i : 0;
      }
    }
    if (lacking != 15) {
      tokens_.Fail("a cell of four triangles that is no tetrahedron");
    }
    result_.mesh.tets.push_back(tet);
  }

  TextTokenizer tokens_;
  ParsedMesh result_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<Face> faces_;
};

}  // namespace

ParsedMesh ReadOpenVolumeMesh(const NamedText& file) { return OpenVolumeMeshReader(file).Read(); }

}  // namespace octupole::internal
