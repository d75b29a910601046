#include "octupole/view/internal/scene_parts.h"

#include <locale>
#include <sstream>
#include <utility>

#include "octupole/alignment/sharp_edges.h"

namespace octupole::internal {
namespace {

// The points that cells use, and the cells with indices into these.
template <std::size_t N>
void Compact(const std::vector<Eigen::Vector3d>& all_points, std::vector<std::array<int, N>> all_cells,
             std::vector<Eigen::Vector3d>* points, std::vector<std::array<int, N>>* cells) {
  std::vector<int> index_of(all_points.size(), -1);
  for (std::array<int, N>& cell : all_cells) {
    for (int& v : cell) {
      if (index_of[v] < 0) {
        index_of[v] = static_cast<int>(points->size());
        points->push_back(all_points[v]);
      }
      v = index_of[v];
    }
  }
  *cells = std::move(all_cells);
}

}  // namespace

std::string SceneText(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(5);
  text << number;
  return text.str();
}

void AddSurface(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                std::vector<std::array<int, 3>> triangles, bool is_solid, Scene* scene) {
  SceneSurface& surface = scene->surfaces.emplace_back();
  surface.name = name;
  surface.is_solid = is_solid;
  Compact(points, std::move(triangles), &surface.points, &surface.triangles);
}

void AddFeatures(const TriangleMesh& mesh, double feature_angle_deg, Scene* scene) {
  SceneLines& lines = scene->lines.emplace_back();
  lines.name = "feature edges";
  auto edges =
      mesh.feature_edges.empty() ? SharpEdges(mesh.points, mesh.triangles, feature_angle_deg) : mesh.feature_edges;
  const auto open = OpenEdges(mesh);
  edges.insert(edges.end(), open.begin(), open.end());
  Compact(mesh.points, std::move(edges), &lines.points, &lines.segments);
}

}  // namespace octupole::internal
