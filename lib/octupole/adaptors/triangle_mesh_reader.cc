#include "octupole/adaptors/triangle_mesh_reader.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>
// After MeshIO.hh, which has to come before the meshes.
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "octupole/readers/internal/lower_case.h"
#include "octupole/readers/internal/text_tokenizer.h"

namespace octupole {
namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

// OpenMesh tells its own streams, and here and there the standard ones, what it does not like, and goes on.
class ScopedSilence {
 public:
  ScopedSilence() : error_(std::cerr.rdbuf(nullptr)), log_(std::clog.rdbuf(nullptr)) {
    omerr().disable();
    omlog().disable();
  }
  ScopedSilence(const ScopedSilence&) = delete;
  ScopedSilence& operator=(const ScopedSilence&) = delete;
  ~ScopedSilence() {
    // Half a line would wait for the rest of it.
    for (OpenMesh::mostream* stream : {&omerr(), &omlog()}) {
      stream->flush();
      stream->enable();
    }
    std::cerr.rdbuf(error_);
    std::clog.rdbuf(log_);
  }

 private:
  std::streambuf* error_;
  std::streambuf* log_;
};

// Takes the vertices into a mesh, but the faces as they are.
class FaceCollector final : public OpenMesh::IO::ImporterT<Mesh> {
 public:
  FaceCollector(const std::filesystem::path& path, Mesh* vertices)
      : ImporterT(*vertices), path_(path.string()), max_items_(std::filesystem::file_size(path)), vertices_(vertices) {}

  const std::vector<std::vector<int>>& faces() const { return faces_; }

  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override {
    CheckCount(vertices_->n_vertices());
    return ImporterT::add_vertex(point);
  }
  OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d& point) override {
    CheckCount(vertices_->n_vertices());
    return ImporterT::add_vertex(point);
  }
  OpenMesh::VertexHandle add_vertex() override {
    CheckCount(vertices_->n_vertices());
    return ImporterT::add_vertex();
  }

  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    CheckCount(faces_.size());
    std::vector<int>& face = faces_.emplace_back();
    for (const OpenMesh::VertexHandle corner : corners) {
      face.push_back(corner.idx());
      if (vertices_->is_valid_handle(corner)) continue;
      throw std::runtime_error(path_ + ": face " + std::to_string(faces_.size()) + " has a vertex that is not there");
    }
    return OpenMesh::FaceHandle(static_cast<int>(faces_.size()) - 1);
  }

  // Whatever is known of faces beyond their corners, and room for counts that a file only claims.
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle, const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(OpenMesh::FaceHandle, int) override {}
  void reserve(unsigned, unsigned, unsigned) override {}

 private:
  void CheckCount(std::size_t count) const {
    if (count >= max_items_) throw std::runtime_error(path_ + ": it claims more vertices or faces than it has bytes");
  }

  std::string path_;
  /// No more vertices, and faces, can be in the file, whatever it claims.
  std::uintmax_t max_items_;
  Mesh* vertices_;
  std::vector<std::vector<int>> faces_;
};

// The vertices and faces of an OBJ file, with the coordinates apart: OpenMesh would round them to floats. It also
// asserts that faces have vertices, passes over vertices that are no numbers, so that all that come after have wrong
// indices, and opens whatever files of materials are named.
std::string CheckedObj(const std::filesystem::path& path, std::vector<Eigen::Vector3d>* points) {
  const internal::FileContent content(path);
  internal::TextTokenizer tokens(path.string(), content.text(), '#');
  std::ostringstream checked;
  while (!tokens.AtEnd()) {
    const std::string_view keyword = tokens.NextWord();
    if (keyword == "v") {
      for (double& coordinate : points->emplace_back()) {
        if (tokens.AtLineEnd()) tokens.Fail("a vertex has less than three coordinates");
        coordinate = tokens.NextReal("a coordinate");
      }
      checked << "v 0 0 0\n";
    } else if (keyword == "f") {
      if (tokens.AtLineEnd()) tokens.Fail("a face without vertices");
      checked << "f";
      while (!tokens.AtLineEnd()) {
        // "vertex/texture/normal"
        std::string_view corner = tokens.NextWord();
        corner = corner.substr(0, corner.find('/'));
        if (corner.empty() || corner.find_first_not_of("-0123456789") != std::string_view::npos) {
          tokens.Fail("a face has " + internal::Quoted(corner) + " where a vertex was expected");
        }
        checked << " " << corner;
      }
      checked << "\n";
    }
    tokens.SkipLine();
  }
  return checked.str();
}

// Throws unless a file that is no complete binary STL file is a complete one of text: of that, OpenMesh takes the lines
// that it knows, and has no opinion on the rest.
void CheckStl(const std::filesystem::path& path) {
  const internal::FileContent content(path);
  const std::string_view bytes = content.text();
  constexpr std::size_t kHeader = 80, kCount = 4, kTriangle = 50;
  if (bytes.size() >= kHeader + kCount) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < kCount; ++k)
      count |= std::size_t{static_cast<unsigned char>(bytes[kHeader + k])} << 8 * k;
    if (bytes.size() == kHeader + kCount + count * kTriangle) return;
  }
  internal::TextTokenizer tokens(path.string(), bytes);
  const auto expect = [&tokens](const char* word) {
    if (internal::LowerCase(tokens.NextWord()) != word)
      tokens.Fail("not the '" + std::string(word) + "' of an STL file");
  };
  expect("solid");
  tokens.SkipLine();
  for (;;) {
    const std::string keyword = internal::LowerCase(tokens.NextWord());
    if (keyword == "endsolid") {
      tokens.SkipLine();
      if (tokens.AtEnd()) return;
      expect("solid");
      tokens.SkipLine();
      continue;
    }
    if (keyword != "facet") tokens.Fail("neither 'facet' nor 'endsolid' of an STL file");
    tokens.SkipLine();
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      if (!tokens.AtLineEnd()) tokens.Fail("more than one vertex on a line of an STL file");
      expect("vertex");
      for (int k = 0; k < 3; ++k) tokens.NextReal("a coordinate");
    }
    expect("endloop");
    expect("endfacet");
  }
}

// A PLY file whose header OpenMesh can take: it writes beyond its memory at a property that comes before any element,
// cannot count the bytes of types that it does not know, reads lists of other things than corners as single numbers,
// and looks for keywords in what follows obj_info.
std::string CheckedPly(const std::filesystem::path& path) {
  static const std::set<std::string_view> kTypes = {"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                                    "float", "double", "int8",    "uint8",  "int16", "uint16",
                                                    "int32", "uint32", "float32", "float64"};
  static const std::set<std::string_view> kCountTypes = {"uint8", "uint16", "uchar", "int"};
  const internal::FileContent content(path);
  const std::string_view text = content.text();
  internal::TextTokenizer tokens(path.string(), text);
  const auto next_of = [&tokens](const std::set<std::string_view>& words, const char* what) {
    const std::string_view word = tokens.NextWord();
    if (words.count(word) == 0) tokens.Fail(internal::Quoted(word) + " where " + what + " was expected");
    return word;
  };
  std::ostringstream header;
  header << next_of({"ply", "PLY"}, "'ply'") << "\n" << next_of({"format"}, "'format'") << " ";
  header << next_of({"ascii", "binary_little_endian", "binary_big_endian"}, "a format of PLY") << " 1.0\n";
  tokens.SkipLine();
  std::string element;
  for (;;) {
    const std::string_view keyword =
        next_of({"comment", "obj_info", "element", "property", "end_header"}, "a keyword of a PLY header");
    if (keyword == "element") {
      element = tokens.NextWord();
      const int count = tokens.CheckCount(tokens.NextInteger("a count"), "elements", 1);
      header << "element " << element << " " << count << "\n";
    } else if (keyword == "property") {
      if (element.empty()) tokens.Fail("a property of no element");
      std::string_view type = tokens.NextWord();
      const bool is_list = type == "list";
      header << "property " << type;
      if (is_list) {
        header << " " << next_of(kCountTypes, "a type of counts that OpenMesh reads");
        type = tokens.NextWord();
        header << " " << type;
      }
      if (kTypes.count(type) == 0) tokens.Fail(internal::Quoted(type) + " is no type of PLY");
      const std::string_view name = tokens.NextWord();
      const bool are_corners = element == "face" && (name == "vertex_index" || name == "vertex_indices");
      if (is_list && !are_corners) tokens.Fail("a list of something else than corners of faces cannot be read");
      header << " " << name << "\n";
    } else if (keyword == "end_header") {
      const std::string_view rest = tokens.SkipLine();
      const std::size_t header_size = rest.data() + rest.size() - text.data();
      return header.str() + "end_header\n" + std::string(text.substr(std::min(header_size + 1, text.size())));
    }
    tokens.SkipLine();
  }
}

// Gives the points of an OBJ file, too; those of others are what the importer is given.
bool Import(const std::filesystem::path& path, const std::string& extension, OpenMesh::IO::BaseImporter* importer,
            std::vector<Eigen::Vector3d>* points) {
  OpenMesh::IO::Options options;
  if (extension == ".stl") {
    CheckStl(path);
    return OpenMesh::IO::IOManager().read(path.string(), *importer, options);
  }
  if (extension == ".obj") {
    std::istringstream stream(CheckedObj(path, points));
    return OpenMesh::IO::IOManager().read(stream, extension, *importer, options);
  }
  std::unique_ptr<std::istream> stream;
  if (extension == ".ply") {
    stream = std::make_unique<std::istringstream>(CheckedPly(path));
  } else {
    stream = std::make_unique<std::ifstream>(path, std::ios::binary);
  }
  // The readers of formats that begin with counts go on to the end of those, whether there is anything to read or not.
  stream->exceptions(std::ios::failbit | std::ios::badbit);
  return OpenMesh::IO::IOManager().read(*stream, extension, *importer, options);
}

std::string Count(std::size_t number, const char* one, const char* several) {
  return std::to_string(number) + " " + (number == 1 ? one : several);
}

void WarnOfTopology(const TriangleMesh& mesh, std::vector<std::string>* warnings) {
  const ManifoldSurface manifold = CutToManifold(mesh);
  const std::set<int> used(manifold.points.begin(), manifold.points.end());
  const std::size_t num_cuts = manifold.points.size() - used.size();
  if (num_cuts > 0) {
    warnings->push_back("the surface is no oriented manifold; cut open, it has " +
                        Count(num_cuts, "more vertex", "more vertices"));
  }
  const std::size_t num_isolated = mesh.points.size() - used.size();
  if (num_isolated > 0) warnings->push_back(Count(num_isolated, "vertex belongs", "vertices belong") + " to no face");
}

}  // namespace

bool IsSurfaceFile(const std::filesystem::path& path) {
  const std::string extension = internal::LowerCase(path.extension().string());
  return extension == ".obj" || extension == ".off" || extension == ".stl" || extension == ".ply";
}

TriangleMesh ReadTriangleMesh(const std::filesystem::path& path, std::vector<std::string>* warnings,
                              std::vector<int>* faces) {
  const auto fail = [&](const std::string& what) -> std::runtime_error {
    return std::runtime_error(path.string() + ": " + what);
  };
  if (!IsSurfaceFile(path)) throw fail("not one of .obj, .off, .stl and .ply");
  const std::string extension = internal::LowerCase(path.extension().string());
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path)) throw fail("cannot be opened");

  Mesh vertices;
  FaceCollector collector(path, &vertices);
  TriangleMesh mesh;
  bool is_read = false;
  try {
    const ScopedSilence silence;
    is_read = Import(path, extension, &collector, &mesh.points);
  } catch (const std::ios_base::failure&) {
    throw fail("it ends too early, or has something else than numbers");
  }
  if (!is_read) throw fail("OpenMesh cannot read it as " + extension);

  for (std::size_t v = mesh.points.size(); v < vertices.n_vertices(); ++v) {
    const OpenMesh::Vec3d p = vertices.point(OpenMesh::VertexHandle(static_cast<int>(v)));
    mesh.points.emplace_back(p[0], p[1], p[2]);
    if (!mesh.points.back().allFinite()) throw fail("vertex " + std::to_string(v + 1) + " is not finite");
  }
  if (faces != nullptr) faces->clear();
  std::size_t num_degenerate = 0;
  for (std::size_t f = 0; f < collector.faces().size(); ++f) {
    const std::vector<int>& face = collector.faces()[f];
    if (face.size() < 3 || std::set<int>(face.begin(), face.end()).size() < face.size()) {
      ++num_degenerate;
      continue;
    }
    for (const std::array<int, 3>& triangle : FanOfPolygon(mesh.points, face)) {
      mesh.triangles.push_back(triangle);
      if (faces != nullptr) faces->push_back(static_cast<int>(f));
    }
  }
  if (mesh.triangles.empty()) throw fail("no faces");
  if (warnings == nullptr) return mesh;
  if (num_degenerate > 0) {
    warnings->push_back(Count(num_degenerate, "face has", "faces have") +
                        " a corner twice, or less than three corners: left out");
  }
  WarnOfTopology(mesh, warnings);
  return mesh;
}

}  // namespace octupole
