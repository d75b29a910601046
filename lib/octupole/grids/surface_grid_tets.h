#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Some cells of a grid as tets, and the frames at their points.
struct GridTets {
  TetMesh mesh;
  std::vector<Eigen::Matrix3d> frames;
};

/// The cells of a grid through which singular curves of a field may run, cut into tets, for FindSingularTriangles and
/// TraceSingularCurves: they find what they would find among the tets of all cells. Left out are cells with all frames
/// less than 22.5 degrees from one, which have no singular triangle, so there are few.
///
/// A cell is cut into Kuhn's six tets along the diagonal to the corner of largest coordinates. Beside smaller cells,
/// all tets meet in a point in the middle of the cell, with the frame nearest to the mean of those at the corners, and
/// stand on the triangles of the smaller cells' faces: neighbours fit together.
///
/// \param frames one rotation per node of the grid, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per node.
GridTets TetsAtSingularities(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames);

/// All cells of a grid cut in the same way, for whoever wants a tet mesh with a staircase for a boundary.
GridTets TetsOfGrid(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
