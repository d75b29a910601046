#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "octupole/grids/surface_grid.h"

namespace octupole::internal {

/// The cells of a grid by their places.
class CellFinder {
 public:
  /// Keeps the reference.
  explicit CellFinder(const SurfaceGrid& grid);

  /// The cell around a point, or -1.
  int Find(const Eigen::Vector3d& point) const;

 private:
  const SurfaceGrid& grid_;
  /// Of each level, ascending: the places of its cells, in their widths, and their numbers.
  std::vector<std::vector<std::pair<std::uint64_t, int>>> cells_;
};

/// The parts of a cell's corners in the trilinear mean at a point of it, in their order. They add up to 1.
std::array<double, 8> CornerWeights(const SurfaceGrid& grid, int cell, const Eigen::Vector3d& point);

/// The frame whose hexadecapole is nearest to that mean of those of the nodes.
/// \param frames of the nodes.
Eigen::Matrix3d InterpolateFrames(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames, int cell,
                                  const Eigen::Vector3d& point);

}  // namespace octupole::internal
