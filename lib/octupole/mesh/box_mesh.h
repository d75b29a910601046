#pragma once

#include <Eigen/Core>
#include <array>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A mesh of the box [0, size]: a regular grid with `cells` cells along x, y and z, each cut into
/// six tetrahedra around its diagonal. All tetrahedra are positively oriented; there are no
/// regions. Vertex (i, j, k) of the grid has the index i + (nx + 1) (j + (ny + 1) k).
///
/// \throw std::invalid_argument if a number of cells is below 1, a size is not positive and finite,
/// or an index would not fit an int.
TetMesh MakeBoxMesh(const std::array<int, 3>& cells, const Eigen::Vector3d& size);

}  // namespace octupole
