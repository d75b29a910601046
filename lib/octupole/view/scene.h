#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace octupole {

// What a page in the browser shows (scene_page.h): plain things in space that have names. The page knows nothing of
// meshes and fields; scenes of them are made by field_scene.h.

/// An entry of the legend: what curves and markers of one colour are.
struct SceneKind {
  std::string name;
  /// As in CSS, "#d62728". It has to be seen on white and on black.
  std::string color;
};

/// Triangles that are shown and hidden together.
struct SceneSurface {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  /// It encloses something solid: where the page cuts it open, the cut is filled.
  bool is_solid = false;
  /// Only its line on the cut is shown.
  bool is_only_on_cut = false;
};

/// Thin lines that are shown and hidden together.
struct SceneLines {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 2>> segments;
  /// They go where the page cuts, as what they lie on does.
  bool is_cut = false;
};

/// A polyline as a tube; `label` is what the page says under the mouse.
struct SceneCurve {
  /// Index into Scene::kinds.
  int kind = 0;
  std::string label;
  std::vector<Eigen::Vector3d> points;
};

/// A point as a ball, likewise.
struct SceneMarker {
  int kind = 0;
  std::string label;
  Eigen::Vector3d point;
};

/// Boxes, coloured by a number or by the directions of their axes.
struct SceneBoxes {
  std::string name;
  std::vector<Eigen::Vector3d> centers;
  /// Rotations; their columns are the directions of the box's edges.
  std::vector<Eigen::Matrix3d> frames;
  /// How much room there is for each: the distance to its neighbours.
  std::vector<double> spacings;
  /// Not negative; what they are says `value_name`.
  std::vector<double> values;
  std::string value_name;
  /// Flat boxes are crosses on a surface, their third axis its normal. Others fill a solid and are shown where it is
  /// cut.
  bool are_flat = false;
};

struct Scene {
  std::string title;
  std::vector<SceneKind> kinds;
  std::vector<SceneSurface> surfaces;
  std::vector<SceneLines> lines;
  std::vector<SceneCurve> curves;
  std::vector<SceneMarker> markers;
  std::vector<SceneBoxes> boxes;
  /// Names and values, shown as a table.
  std::vector<std::pair<std::string, std::string>> figures;
};

}  // namespace octupole
