#include "octupole/adaptors/cad_mesher.h"

#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "octupole/readers/internal/lower_case.h"

namespace octupole {
namespace {

constexpr double kCreaseAngleDeg = 20;
// gmsh's numbers of kinds of elements.
constexpr int kLine = 1, kTet = 4;
using Tags = std::vector<std::size_t>;

// gmsh between its initialisation and its end.
class Session {
 public:
  Session() {
    constexpr bool kReadConfigFiles = false;
    gmsh::initialize(0, nullptr, kReadConfigFiles);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { gmsh::finalize(); }
};

Eigen::Vector3d NormalAt(int curve, double parameter, int surface) {
  std::vector<double> on_surface, normal;
  gmsh::model::reparametrizeOnSurface(1, curve, {parameter}, surface, on_surface);
  gmsh::model::getNormal(surface, on_surface, normal);
  return {normal.at(0), normal.at(1), normal.at(2)};
}

// Whether the model has a crease at the middle of the curve. Of normals only the line counts: gmsh's are not all
// outward.
bool IsCrease(int curve) {
  std::vector<int> surfaces, points;
  gmsh::model::getAdjacencies(1, curve, surfaces, points);
  std::sort(surfaces.begin(), surfaces.end());
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
  if (surfaces.size() < 2) return false;
  if (surfaces.size() > 2) return true;
  std::vector<double> begin, end;
  gmsh::model::getParametrizationBounds(1, curve, begin, end);
  const double middle = (begin.at(0) + end.at(0)) / 2;
  const double cosine = NormalAt(curve, middle, surfaces[0]).dot(NormalAt(curve, middle, surfaces[1]));
  return std::abs(cosine) < std::cos(kCreaseAngleDeg * M_PI / 180);
}

// The indices into `points` of gmsh's nodes.
class Nodes {
 public:
  explicit Nodes(std::vector<Eigen::Vector3d>* points) {
    Tags tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      index_of_[tags[i]] = static_cast<int>(points->size());
      points->emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    }
  }

  int IndexOf(std::size_t tag) const { return index_of_.at(tag); }

 private:
  std::unordered_map<std::size_t, int> index_of_;
};

// The nodes of the elements of one kind on an entity of the model.
Tags NodesOfElements(int type, int entity) {
  Tags elements, nodes;
  gmsh::model::mesh::getElementsByType(type, elements, nodes, entity);
  return nodes;
}

TetMesh MeshOfModel() {
  TetMesh mesh;
  const Nodes nodes(&mesh.points);
  gmsh::vectorpair volumes, curves;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(curves, 1);
  for (const auto& [dimension, volume] : volumes) {
    const Tags corners = NodesOfElements(kTet, volume);
    for (std::size_t i = 0; i < corners.size(); i += 4) {
      mesh.tets.push_back({nodes.IndexOf(corners[i]), nodes.IndexOf(corners[i + 1]), nodes.IndexOf(corners[i + 2]),
                           nodes.IndexOf(corners[i + 3])});
      mesh.regions.push_back(volume);
    }
  }
  std::map<int, int> edges_at;
  for (const auto& [dimension, curve] : curves) {
    if (!IsCrease(curve)) continue;
    const Tags ends = NodesOfElements(kLine, curve);
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      mesh.feature_edges.push_back({nodes.IndexOf(ends[i]), nodes.IndexOf(ends[i + 1])});
      for (const int v : mesh.feature_edges.back()) ++edges_at[v];
    }
  }
  for (const auto& [v, count] : edges_at) {
    if (count != 2) mesh.feature_points.push_back(v);
  }
  return mesh;
}

}  // namespace

bool IsCadModel(const std::filesystem::path& path) {
  const std::string extension = internal::LowerCase(path.extension().string());
  for (const char* known : {".step", ".stp", ".iges", ".igs", ".brep"}) {
    if (extension == known) return true;
  }
  return false;
}

TetMesh MeshCadModel(const std::filesystem::path& path, double size) {
  if (!(size > 0 && std::isfinite(size))) {
    throw std::invalid_argument("MeshCadModel: the size must be positive and finite, not " + std::to_string(size));
  }
  const auto fail = [&](const std::string& cause) -> TetMesh {
    throw std::runtime_error(path.string() + ": " + cause);
  };
  if (!IsCadModel(path)) return fail("the extension is not one of .step, .stp, .iges, .igs, .brep");
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path)) return fail("cannot be read");
  const Session session;
  TetMesh mesh;
  try {
    gmsh::vectorpair shapes;
    gmsh::model::occ::importShapes(path.string(), shapes);
    gmsh::model::occ::synchronize();
    gmsh::option::setNumber("Mesh.MeshSizeMin", size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
    gmsh::model::mesh::generate(3);
    mesh = MeshOfModel();
  } catch (const std::string& message) {  // so gmsh 4.8; later ones throw exceptions
    return fail("gmsh: " + message);
  } catch (const std::exception& error) {
    return fail(std::string("gmsh: ") + error.what());
  }
  if (mesh.tets.empty()) return fail("the model has no volume");
  return mesh;
}

}  // namespace octupole
