#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "octupole/maps/map_domain.h"
#include "octupole/maps/map_quality.h"

namespace octupole {

enum class ObstacleKind : std::uint8_t {
  kTurn = 1,           ///< edges around which the frame makes another turn than a quarter
  kValenceChange = 2,  ///< a vertex at which a curve changes from valence 3 to 5
  kWedge = 3,          ///< edges where two sheets of one parameter meet, one of which was released
  kThinPart = 4,       ///< edges inside from one side of the boundary to the other: a part one tetrahedron thick
  kCollapsed = 5,      ///< tetrahedra that are flat in every map
  kFlipped = 6,        ///< tetrahedra that the map turns over or flattens
  kReleased = 7,       ///< tetrahedra at the boundary on whose faces no parameter is held constant
  kShortCurve = 8,     ///< a singular curve that is shorter than a tenth of a cell in the map
};

/// What stands in the way of a map at one place: all of a kind that hangs together.
struct MapObstacle {
  ObstacleKind kind;
  /// In indices of the domain's mesh.
  std::vector<std::array<int, 2>> edges;
  std::vector<int> tets;
  /// In its middle.
  Eigen::Vector3d place;
  /// The length of the edges together (of a thin part: of the shortest), or the extent of the tetrahedra.
  double size = 0;
  /// Of a wedge, the sharpest angle.
  double angle_deg = 0;
  /// Of a short curve, its length in the map.
  double cells = 0;

  /// One line that names it, its size, its place, and what it means.
  std::string Describe() const;
};

/// Kind by kind, the largest first.
/// \param flipped of a map of the domain.
/// \param parameters of that map; without them no short curves are found.
std::vector<MapObstacle> FindObstacles(const MapDomain& domain, const std::vector<int>& flipped,
                                       const CornerParameters& parameters = {});

}  // namespace octupole
