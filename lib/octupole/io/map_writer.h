#pragma once

#include <filesystem>
#include <vector>

#include "octupole/maps/map_cut.h"
#include "octupole/maps/map_obstacles.h"
#include "octupole/maps/map_quality.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Writes a map in the text format .hexex of libHexEx: the number of points and the points; the number of tetrahedra,
/// and for each its four indices, from 0, and three parameters for each of its corners. Numbers are written so that
/// they read back as they are.
///
/// \throw std::invalid_argument unless there are parameters for every tetrahedron.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
void WriteHexEx(const std::filesystem::path& path, const TetMesh& mesh, const CornerParameters& parameters);

/// Writes a map for ParaView and the like: the mesh, cut open, with the point array `parameters` (3 numbers). Points
/// are doubled where the cut goes; a contour of one parameter at the integers is a sheet of the grid. Errors as above.
void WriteMapVtu(const std::filesystem::path& path, const TetMesh& mesh, const MapCut& cut,
                 const CornerParameters& parameters);

/// Writes what stands in the way of a map: lines and tetrahedra with the cell arrays `obstacle`, an ObstacleKind, and
/// `number`, its place in the list. \throw std::runtime_error as above.
void WriteObstacles(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<MapObstacle>& obstacles);

}  // namespace octupole
