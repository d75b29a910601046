#pragma once

#include <string>
#include <utility>
#include <vector>

#include "octupole/maps/map_domain.h"
#include "octupole/maps/map_obstacles.h"
#include "octupole/maps/map_quality.h"
#include "octupole/view/scene.h"

namespace octupole {

/// The scene of a map: the boundary of its mesh with its feature edges; the integer grid, which is where a parameter is
/// whole, as lines on the boundary and on the cut; the singular edges as curves by valence; and what stands in the way
/// as balls. It has no figures.
///
/// \param parameters of the tetrahedra of domain.mesh.
/// \param obstacles of FindObstacles.
/// \throw std::invalid_argument unless there are parameters for every tetrahedron.
Scene MakeMapScene(const std::string& title, const MapDomain& domain, const CornerParameters& parameters,
                   const std::vector<MapObstacle>& obstacles, double feature_angle_deg = 40);

/// What is known of a map, as figures of a scene.
/// \param size H.
std::vector<std::pair<std::string, std::string>> MapFigures(const MapDomain& domain, const MapQuality& quality,
                                                            double size);

}  // namespace octupole
