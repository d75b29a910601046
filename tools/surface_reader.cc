#include "surface_reader.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
// After MeshIO.hh, which has to come before the meshes.
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

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
  /// No more than `max_items` vertices, and faces, can be in the file, whatever it claims.
  FaceCollector(std::uintmax_t max_items, Mesh* vertices)
      : ImporterT(*vertices), max_items_(max_items), vertices_(vertices) {}

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
      throw std::runtime_error("face " + std::to_string(faces_.size()) + " has a vertex that is not there");
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
    if (count >= max_items_) throw std::runtime_error("it claims more vertices or faces than it has bytes");
  }

  std::uintmax_t max_items_;
  Mesh* vertices_;
  std::vector<std::vector<int>> faces_;
};

std::string LowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool Import(const std::filesystem::path& path, const std::string& extension, OpenMesh::IO::BaseImporter* importer) {
  OpenMesh::IO::Options options;
  if (extension == ".obj" || extension == ".stl")
    return OpenMesh::IO::IOManager().read(path.string(), *importer, options);
  // The readers of formats that begin with counts go on to the end of those, whether there is anything to read or not.
  std::ifstream stream(path, std::ios::binary);
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  return OpenMesh::IO::IOManager().read(stream, extension, *importer, options);
}

std::string Count(std::size_t number, const char* one, const char* several) {
  return std::to_string(number) + " " + (number == 1 ? one : several);
}

// What is wrong with the vertices of an OBJ file, of which OpenMesh read so many: it passes over those that are no
// numbers, and all that come after have wrong indices.
std::string ProblemOfObj(const std::filesystem::path& path, std::size_t num_read) {
  std::ifstream stream(path);
  std::size_t count = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(" \t");
    count += begin != std::string::npos && line[begin] == 'v' && begin + 1 < line.size() &&
             (line[begin + 1] == ' ' || line[begin + 1] == '\t');
  }
  if (count == num_read) return "";
  return "of " + Count(count, "vertex", "vertices") + " only " + std::to_string(num_read) + " can be read as numbers";
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

SurfaceFile ReadSurface(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  const auto fail = [&](const std::string& what) -> std::runtime_error {
    return std::runtime_error(path.string() + ": " + what);
  };
  const std::string extension = LowerExtension(path);
  if (extension != ".obj" && extension != ".off" && extension != ".stl" && extension != ".ply") {
    throw fail("not one of .obj, .off, .stl and .ply");
  }
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path)) throw fail("cannot be opened");

  Mesh vertices;
  FaceCollector collector(std::filesystem::file_size(path), &vertices);
  std::string problem;
  try {
    const ScopedSilence silence;
    if (!Import(path, extension, &collector)) problem = "OpenMesh cannot read it as " + extension;
  } catch (const std::ios_base::failure&) {
    problem = "it ends too early, or has something else than numbers";
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (extension == ".obj") {
    const std::string problem_of_vertices = ProblemOfObj(path, vertices.n_vertices());
    if (!problem_of_vertices.empty()) problem = problem_of_vertices;
  }
  if (!problem.empty()) throw fail(problem);

  SurfaceFile file;
  for (std::size_t v = 0; v < vertices.n_vertices(); ++v) {
    const OpenMesh::Vec3d p = vertices.point(OpenMesh::VertexHandle(static_cast<int>(v)));
    file.mesh.points.emplace_back(p[0], p[1], p[2]);
    if (!file.mesh.points.back().allFinite()) throw fail("vertex " + std::to_string(v + 1) + " is not finite");
  }
  file.num_faces = collector.faces().size();
  std::size_t num_degenerate = 0;
  for (std::size_t f = 0; f < file.num_faces; ++f) {
    const std::vector<int>& face = collector.faces()[f];
    if (face.size() < 3 || std::set<int>(face.begin(), face.end()).size() < face.size()) {
      ++num_degenerate;
      continue;
    }
    for (const std::array<int, 3>& triangle : FanOfPolygon(file.mesh.points, face)) {
      file.mesh.triangles.push_back(triangle);
      file.faces.push_back(static_cast<int>(f));
    }
  }
  if (file.mesh.triangles.empty()) throw fail("no faces");
  if (num_degenerate > 0) {
    warnings->push_back(Count(num_degenerate, "face has", "faces have") +
                        " a corner twice, or less than three corners: left out");
  }
  WarnOfTopology(file.mesh, warnings);
  return file;
}

}  // namespace octupole
