#include "octupole/grids/surface_grid_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "octupole/grids/internal/grid_interpolation.h"

namespace octupole {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Tree = Eigen::KdBVH<double, 3, int>;

// The cells that are nearest to points outside: the finest that have a corner outside the solid.
Tree OuterCells(const SurfaceGrid& grid, std::vector<AlignedBox3d>* boxes) {
  std::vector<int> cells;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const auto is_outside = [&](int v) { return grid.distances[v] >= 0; };
    if (grid.levels[i] == 0 && std::any_of(grid.cells[i].begin(), grid.cells[i].end(), is_outside)) {
      cells.push_back(static_cast<int>(i));
    }
  }
  if (cells.empty()) {
    for (std::size_t i = 0; i < grid.cells.size(); ++i) cells.push_back(static_cast<int>(i));
  }
  for (const int i : cells) {
    const Vector3d& low = grid.points[grid.cells[i][0]];
    boxes->emplace_back(low, low + Vector3d::Constant(std::ldexp(grid.size, grid.levels[i])));
  }
  return Tree(cells.begin(), cells.end(), boxes->begin(), boxes->end());
}

}  // namespace

struct GridSampler::Index {
  Index(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames)
      : grid(grid), field("GridSampler", grid, frames), outer_cells(OuterCells(grid, &boxes)) {}

  // The cell that is nearest to a point outside.
  int Nearest(const Vector3d& point) const {
    struct Search {
      using Scalar = double;
      double minimumOnVolume(const AlignedBox3d& box) const {  // NOLINT(readability-identifier-naming): Eigen's name
        return box.squaredExteriorDistance(*point);
      }
      double minimumOnObject(int cell) {  // NOLINT(readability-identifier-naming)
        const Vector3d& low = grid->points[grid->cells[cell][0]];
        const Vector3d high = low + Vector3d::Constant(std::ldexp(grid->size, grid->levels[cell]));
        const double distance = AlignedBox3d(low, high).squaredExteriorDistance(*point);
        if (distance < least) {
          least = distance;
          nearest = cell;
        }
        return distance;
      }
      const SurfaceGrid* grid;
      const Vector3d* point;
      double least = std::numeric_limits<double>::infinity();
      int nearest = 0;
    } search = {&grid, &point};
    Eigen::BVMinimize(outer_cells, search);
    return search.nearest;
  }

  const SurfaceGrid& grid;
  internal::FrameInterpolation field;
  std::vector<AlignedBox3d> boxes;
  Tree outer_cells;
};

GridSampler::GridSampler(const SurfaceGrid& grid, const std::vector<Eigen::Matrix3d>& frames)
    : index_(std::make_unique<Index>(grid, frames)) {}

GridSampler::~GridSampler() = default;

FieldSamples GridSampler::Sample(const std::vector<Vector3d>& points) const {
  FieldSamples samples;
  samples.frames.reserve(points.size());
  samples.is_inside.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      std::ostringstream message;
      message << "GridSampler: point " << i << " is not finite: [" << points[i].transpose() << "]";
      throw std::invalid_argument(message.str());
    }
    int cell = index_->field.FindCell(points[i]);
    samples.is_inside.push_back(cell >= 0);
    if (cell < 0) cell = index_->Nearest(points[i]);
    samples.frames.push_back(index_->field.Interpolate(cell, points[i]));
  }
  return samples;
}

}  // namespace octupole
