#include "octupole/view/map_scene.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>

#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/view/internal/scene_parts.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using internal::SceneText;

enum MapKind { kEdgeOfValence3, kEdgeOfValence5, kEdgeOfOtherTurn, kObstacle };
const std::vector<SceneKind> kMapKinds = {
    {"valence 3", "#e5484d"}, {"valence 5", "#3e7bfa"}, {"other turns", "#e2a610"}, {"in the way", "#a13fd1"}};

// Calls `use` with each whole number that lies between corners' values, and which corners are at or above it.
template <std::size_t N, typename Use>
void ForEachLevel(const std::array<double, N>& values, const Use& use) {
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  for (double level = std::floor(*least) + 1; level <= *largest; ++level) {
    std::array<bool, N> is_above;
    for (std::size_t i = 0; i < N; ++i) is_above[i] = values[i] >= level;
    use(level, is_above);
  }
}

// Where a value is `level` between two points.
Vector3d Crossing(const Vector3d& a, double value_a, const Vector3d& b, double value_b, double level) {
  return a + (level - value_a) / (value_b - value_a) * (b - a);
}

// The surfaces inside on which a parameter is whole.
SceneSurface GridInside(const TetMesh& mesh, const CornerParameters& parameters) {
  SceneSurface grid;
  grid.name = "grid on the cut";
  grid.is_only_on_cut = true;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto point = [&](int i) -> const Vector3d& { return mesh.points[mesh.tets[t][i]]; };
    for (int k = 0; k < 3; ++k) {
      const std::array<double, 4> values = {parameters[t][0][k], parameters[t][1][k], parameters[t][2][k],
                                            parameters[t][3][k]};
      ForEachLevel(values, [&](double level, const std::array<bool, 4>& is_above) {
        std::vector<int> above, below;
        for (int i = 0; i < 4; ++i) (is_above[i] ? above : below).push_back(i);
        const int first = static_cast<int>(grid.points.size());
        const auto add = [&](int i, int j) {
          grid.points.push_back(Crossing(point(i), values[i], point(j), values[j], level));
        };
        for (const int i : above) {
          for (const int j : below) add(i, j);
        }
        grid.triangles.push_back({first, first + 1, first + 2});
        // Of two corners on either side: (0, 2), (0, 3), (1, 2), (1, 3), a quadrangle whose last two are crossed.
        if (above.size() == 2) grid.triangles.push_back({first + 1, first + 3, first + 2});
      });
    }
  }
  return grid;
}

SceneLines GridOnBoundary(const MapDomain& domain, const CornerParameters& parameters) {
  SceneLines grid;
  grid.name = "grid on the boundary";
  grid.is_cut = true;
  const TetMesh& mesh = domain.mesh;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int corner = 0; corner < 4; ++corner) {
      if (domain.combed.neighbours[t][corner] >= 0) continue;
      const std::array<int, 3> at = {(corner + 1) % 4, (corner + 2) % 4, (corner + 3) % 4};
      for (int k = 0; k < 3; ++k) {
        const std::array<double, 3> values = {parameters[t][at[0]][k], parameters[t][at[1]][k],
                                              parameters[t][at[2]][k]};
        ForEachLevel(values, [&](double level, const std::array<bool, 3>& is_above) {
          const int first = static_cast<int>(grid.points.size());
          for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            if (is_above[i] == is_above[j]) continue;
            grid.points.push_back(Crossing(mesh.points[mesh.tets[t][at[i]]], values[i],
                                           mesh.points[mesh.tets[t][at[j]]], values[j], level));
          }
          grid.segments.push_back({first, first + 1});
        });
      }
    }
  }
  return grid;
}

// Singular edges of one valence that follow each other, as one curve.
void AddCurves(const MapDomain& domain, Scene* scene) {
  const std::vector<SingularEdge>& edges = domain.singular_edges;
  std::map<int, std::vector<std::size_t>> edges_of;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const int v : edges[i].vertices) edges_of[v].push_back(i);
  }
  const auto goes_on_at = [&](int v) {
    const std::vector<std::size_t>& there = edges_of[v];
    return there.size() == 2 && edges[there[0]].valence == edges[there[1]].valence;
  };
  std::vector<bool> is_done(edges.size(), false);
  const auto trace = [&](std::size_t first, int from) {
    std::vector<int> vertices = {from};
    for (std::size_t i = first; !is_done[i];) {
      is_done[i] = true;
      const auto [a, b] = edges[i].vertices;
      vertices.push_back(vertices.back() == a ? b : a);
      const int v = vertices.back();
      if (goes_on_at(v)) i = edges_of[v][0] == i ? edges_of[v][1] : edges_of[v][0];
    }
    SceneCurve curve;
    const int valence = edges[first].valence;
    curve.kind = valence == 3 ? kEdgeOfValence3 : valence == 5 ? kEdgeOfValence5 : kEdgeOfOtherTurn;
    double length = 0;
    for (const int v : vertices) {
      curve.points.push_back(domain.mesh.points[v]);
      if (curve.points.size() > 1) length += (curve.points.back() - *(curve.points.end() - 2)).norm();
    }
    curve.label =
        (valence == 0 ? "no valence" : "valence " + std::to_string(valence)) + "\nlength " + SceneText(length);
    scene->curves.push_back(std::move(curve));
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const int v : edges[i].vertices) {
      if (!is_done[i] && !goes_on_at(v)) trace(i, v);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {  // closed ones
    if (!is_done[i]) trace(i, edges[i].vertices[0]);
  }
}

}  // namespace

Scene MakeMapScene(const std::string& title, const MapDomain& domain, const CornerParameters& parameters,
                   const std::vector<MapObstacle>& obstacles, double feature_angle_deg) {
  if (parameters.size() != domain.mesh.tets.size()) {
    throw std::invalid_argument("MakeMapScene: parameters for " + std::to_string(parameters.size()) +
                                " tetrahedra, not " + std::to_string(domain.mesh.tets.size()));
  }
  Scene scene;
  scene.title = title;
  scene.kinds = kMapKinds;
  const TriangleMesh boundary = BoundarySurface(domain.mesh);
  internal::AddSurface("boundary", domain.mesh.points, boundary.triangles, true, &scene);
  scene.surfaces.push_back(GridInside(domain.mesh, parameters));
  scene.lines.push_back(GridOnBoundary(domain, parameters));
  internal::AddFeatures(boundary, feature_angle_deg, &scene);
  AddCurves(domain, &scene);
  for (const MapObstacle& obstacle : obstacles) {
    scene.markers.push_back({kObstacle, obstacle.Describe(), obstacle.place});
  }
  return scene;
}

std::vector<std::pair<std::string, std::string>> MapFigures(const MapDomain& domain, const MapQuality& quality,
                                                            double size) {
  return {{"tetrahedra", std::to_string(domain.mesh.tets.size())},
          {"size H", SceneText(size)},
          {"volume in parameters", SceneText(quality.parameter_volume)},
          {"turned over", std::to_string(quality.flipped)},
          {"their share of the volume", SceneText(100 * quality.flipped_volume) + " %"},
          {"stretch, 5 %", SceneText(quality.stretch_5)},
          {"95 %", SceneText(quality.stretch_95)}};
}

}  // namespace octupole
