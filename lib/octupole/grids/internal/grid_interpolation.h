#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "octupole/grids/surface_grid.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole::internal {

/// The frames of a grid's nodes in its cells.
class FrameInterpolation {
 public:
  /// Keeps the references.
  /// \throw std::invalid_argument naming `caller` unless there is one frame per node and each is a rotation.
  FrameInterpolation(const char* caller, const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames);

  /// The cell around a point, or -1.
  int FindCell(const Eigen::Vector3d& point) const;

  /// At a point of a cell, the frame whose hexadecapole is nearest to the trilinear mean of those of the corners.
  Eigen::Matrix3d Interpolate(int cell, const Eigen::Vector3d& point) const;

 private:
  const SurfaceGrid& grid_;
  const std::vector<Eigen::Matrix3d>& frames_;
  /// Of the frames.
  std::vector<Hexadecapole> hexadecapoles_;
  /// Of each level, ascending: the places of its cells, in their widths, and their numbers.
  std::vector<std::vector<std::pair<std::uint64_t, int>>> cells_;
};

}  // namespace octupole::internal
