#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "octupole/field/field_quality.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/view/scene.h"

namespace octupole {

/// The scene of a field on a tet mesh: its boundary, its interfaces, its feature edges (the marked ones, else those
/// above `feature_angle_deg`), a box for every frame, coloured by the mean FrameDifference<3> to its neighbours,
/// singular curves by valence, their nodes, and singular points of the boundary. It has no figures.
///
/// \param frames one rotation per point, its columns the axes.
/// \param interfaces triangles of the mesh, such as BoundaryAlignment::interfaces has.
/// \throw std::invalid_argument unless there is one frame per point.
Scene MakeFieldScene(const std::string& title, const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                     const std::vector<std::array<int, 3>>& interfaces, const SingularCurves& curves,
                     const std::vector<SingularPoint>& boundary_points, double feature_angle_deg = 40);

/// The same for a field at points in a solid that are no mesh, such as the nodes of a grid: without interfaces and
/// singular points. \param edges between neighbouring points; points without any are left out.
Scene MakeFieldScene(const std::string& title, const TriangleMesh& boundary, const std::vector<Eigen::Vector3d>& points,
                     const std::vector<std::array<int, 2>>& edges, const std::vector<Eigen::Matrix3d>& frames,
                     const SingularCurves& curves, double feature_angle_deg = 40);

/// The same for a cross field on a surface: flat boxes, and only the surface's singular points.
/// \param frames as CrossField gives them, the third axis the surface's normal.
Scene MakeSurfaceScene(const std::string& title, const TriangleMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                       const std::vector<SingularPoint>& points, double feature_angle_deg = 40);

/// What is known of a field, as figures of a scene.
std::vector<std::pair<std::string, std::string>> FieldFigures(const TetMesh& mesh, const FieldQuality& quality,
                                                              const SingularCurves& curves,
                                                              const std::vector<SingularPoint>& boundary_points);

}  // namespace octupole
