#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "octupole/field/field_sampler.h"
#include "octupole/grids/surface_grid.h"

namespace octupole {

/// A field on a grid, anywhere: at a point of a cell the frame whose hexadecapole is nearest to the trilinear mean of
/// those of the cell's corners; outside all cells, that at the nearest point of them. Between cells of one size it is
/// continuous as that of FieldSampler is.
class GridSampler {
 public:
  /// Keeps the references.
  /// \param frames one rotation per node, its columns the axes.
  /// \throw std::invalid_argument unless there is one frame per node and each is a rotation.
  GridSampler(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames);
  ~GridSampler();

  /// Inside is what the cells cover: up to a cell more than the solid.
  /// \throw std::invalid_argument naming the first point that is not finite.
  FieldSamples Sample(const std::vector<Eigen::Vector3d>& points) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace octupole
