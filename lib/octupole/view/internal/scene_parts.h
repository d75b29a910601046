#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "octupole/mesh/triangle_mesh.h"
#include "octupole/view/scene.h"

namespace octupole::internal {

// What scenes of fields and of maps have in common.

/// A number as figures and labels say it.
std::string SceneText(double number);

/// Triangles of a mesh as a surface, of only the points that they use.
void AddSurface(const std::string& name, const std::vector<Eigen::Vector3d>& points,
                std::vector<std::array<int, 3>> triangles, bool is_solid, Scene* scene);

/// The marked edges of a surface, or if there are none those above the angle; and those at which it is open.
void AddFeatures(const TriangleMesh& mesh, double feature_angle_deg, Scene* scene);

}  // namespace octupole::internal
