#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Three parameters for each corner of each tetrahedron.
using CornerParameters = std::vector<std::array<Eigen::Vector3d, 4>>;

/// A map and the mesh that it is of.
struct MeshMap {
  TetMesh mesh;
  CornerParameters parameters;
};

/// What a map does to volumes and lengths.
struct MapQuality {
  /// Tetrahedra turned over or flat, and their share of the volume.
  std::size_t flipped = 0;
  double flipped_volume = 0;
  /// The signed volume in parameters: the number of hexahedra that an integer-grid map stands for.
  double parameter_volume = 0;
  /// Of the singular values of H grad u the fifth percentile of the smallest and the 95th of the largest: how far
  /// lengths are from those asked for. 0 if no tetrahedron has a volume.
  double stretch_5 = 0;
  double stretch_95 = 0;
};

/// \param size H, the length that one unit of a parameter stands for.
/// \throw std::invalid_argument unless there are parameters for every tetrahedron.
MapQuality MeasureMap(const TetMesh& mesh, const CornerParameters& parameters, double size);

}  // namespace octupole
