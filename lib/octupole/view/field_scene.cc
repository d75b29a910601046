#include "octupole/view/field_scene.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/view/internal/scene_parts.h"

namespace octupole {
namespace {

using internal::AddFeatures;
using internal::AddSurface;
using internal::SceneText;
using Triangles = std::vector<std::array<int, 3>>;
using Edges = std::vector<std::array<int, 2>>;

enum Kind { kValence3, kValence5, kOtherTurns, kNode };
const std::vector<SceneKind> kKinds = {{"valence 3, index 1/4", "#e5484d"},
                                       {"valence 5, index -1/4", "#3e7bfa"},
                                       {"other turns", "#e2a610"},
                                       {"node", "#8b8d98"}};

constexpr std::array<const char*, 5> kNameOfType = {"no turn", "quarter turn", "half turn",
                                                    "half turn about a diagonal", "third of a turn"};
constexpr std::array<const char*, 4> kNameOfEnd = {"none", "boundary", "node", "open"};

std::string Degrees(double number) { return SceneText(std::round(number * 100) / 100) + "\u00b0"; }

std::string IndexText(int quarter_index) {
  const std::string sign = quarter_index < 0 ? "-" : "";
  const int quarters = std::abs(quarter_index);
  if (quarters % 4 == 0) return sign + std::to_string(quarters / 4);
  return sign + (quarters % 2 == 0 ? std::to_string(quarters / 2) + "/2" : std::to_string(quarters) + "/4");
}

void AddFrames(const std::string& caller, const std::vector<Eigen::Vector3d>& points, const Edges& edges,
               const std::vector<Eigen::Matrix3d>& frames, bool are_flat, Scene* scene) {
  if (frames.size() != points.size()) {
    throw std::invalid_argument(caller + ": " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(points.size()) + " points");
  }
  std::vector<double> spacings(points.size(), 0);
  std::vector<int> counts(points.size(), 0);
  for (const auto& [a, b] : edges) {
    const double length = (points[a] - points[b]).norm();
    for (const int v : {a, b}) {
      spacings[v] += length;
      ++counts[v];
    }
  }
  const std::vector<double> values = MeanDifferences(edges, frames);
  SceneBoxes& boxes = scene->boxes.emplace_back();
  boxes.name = "frames";
  boxes.value_name = "energy per edge";
  boxes.are_flat = are_flat;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (counts[v] == 0) continue;
    boxes.centers.push_back(points[v]);
    boxes.frames.push_back(frames[v]);
    boxes.spacings.push_back(spacings[v] / counts[v]);
    boxes.values.push_back(values[v]);
  }
}

void AddCurves(const SingularCurves& curves, Scene* scene) {
  for (const SingularCurve& curve : curves.curves) {
    const bool has_valence = curve.valence == 3 || curve.valence == 5;
    std::string label = has_valence ? "valence " + std::to_string(curve.valence) : "no valence";
    label += std::string("\n") + kNameOfType[static_cast<std::size_t>(curve.type)];
    if (has_valence) label += ", index " + IndexText(4 - curve.valence);
    label += "\nlength " + SceneText(curve.length);
    if (curve.is_loop()) {
      label += ", closed";
    } else {
      label += std::string("\nends: ") + kNameOfEnd[static_cast<std::size_t>(curve.ends[0])] + ", " +
               kNameOfEnd[static_cast<std::size_t>(curve.ends[1])];
    }
    const Kind kind = curve.valence == 3 ? kValence3 : curve.valence == 5 ? kValence5 : kOtherTurns;
    if (curve.points.size() == 1) {  // through one triangle only
      scene->markers.push_back({kind, label, curve.points[0]});
    } else {
      scene->curves.push_back({kind, label, curve.points});
    }
  }
  for (const SingularNode& node : curves.nodes) {
    scene->markers.push_back({kNode, "node of " + std::to_string(node.num_ends) + " curve ends", node.point});
  }
}

void AddPoints(const std::vector<SingularPoint>& points, const std::string& where, Scene* scene) {
  for (const SingularPoint& point : points) {
    const Kind kind = point.quarter_index == 1 ? kValence3 : point.quarter_index == -1 ? kValence5 : kOtherTurns;
    scene->markers.push_back(
        {kind, "point on the " + where + "\nindex " + IndexText(point.quarter_index), point.point});
  }
}

}  // namespace

Scene MakeFieldScene(const std::string& title, const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                     const Triangles& interfaces, const SingularCurves& curves,
                     const std::vector<SingularPoint>& boundary_points, double feature_angle_deg) {
  Scene scene;
  scene.title = title;
  scene.kinds = kKinds;
  AddFrames("MakeFieldScene", mesh.points, MeshEdges(mesh), frames, false, &scene);
  const TriangleMesh boundary = BoundarySurface(mesh);
  AddSurface("boundary", mesh.points, boundary.triangles, true, &scene);
  if (!interfaces.empty()) AddSurface("interfaces", mesh.points, interfaces, false, &scene);
  AddFeatures(boundary, feature_angle_deg, &scene);
  AddCurves(curves, &scene);
  AddPoints(boundary_points, "boundary", &scene);
  return scene;
}

Scene MakeFieldScene(const std::string& title, const TriangleMesh& boundary, const std::vector<Eigen::Vector3d>& points,
                     const std::vector<std::array<int, 2>>& edges, const std::vector<Eigen::Matrix3d>& frames,
                     const SingularCurves& curves, double feature_angle_deg) {
  Scene scene;
  scene.title = title;
  scene.kinds = kKinds;
  AddFrames("MakeFieldScene", points, edges, frames, false, &scene);
  AddSurface("boundary", boundary.points, boundary.triangles, true, &scene);
  AddFeatures(boundary, feature_angle_deg, &scene);
  AddCurves(curves, &scene);
  return scene;
}

Scene MakeSurfaceScene(const std::string& title, const TriangleMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                       const std::vector<SingularPoint>& points, double feature_angle_deg) {
  Scene scene;
  scene.title = title;
  scene.kinds = kKinds;
  AddFrames("MakeSurfaceScene", mesh.points, MeshEdges(mesh), frames, true, &scene);
  AddSurface("surface", mesh.points, mesh.triangles, false, &scene);
  AddFeatures(mesh, feature_angle_deg, &scene);
  AddPoints(points, "surface", &scene);
  return scene;
}

std::vector<std::pair<std::string, std::string>> FieldFigures(const TetMesh& mesh, const FieldQuality& quality,
                                                              const SingularCurves& curves,
                                                              const std::vector<SingularPoint>& boundary_points) {
  double length = 0;
  for (const SingularCurve& curve : curves.curves) length += curve.length;
  return {{"vertices", std::to_string(mesh.points.size())},
          {"tetrahedra", std::to_string(mesh.tets.size())},
          {"energy of the frames, degree 3", SceneText(quality.energy3)},
          {"degree 4", SceneText(quality.energy4)},
          {"boundary error, rms", Degrees(quality.boundary_rms_deg)},
          {"largest", Degrees(quality.boundary_max_deg)},
          {"singular triangles", std::to_string(quality.singular_triangles)},
          {"singular curves", std::to_string(curves.curves.size())},
          {"their length", SceneText(length)},
          {"nodes", std::to_string(curves.nodes.size())},
          {"points on the boundary", std::to_string(boundary_points.size())}};
}

}  // namespace octupole
