#include "octupole/grids/internal/grid_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"

namespace octupole::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A place in a lattice in 21 bits for each coordinate; any order will do.
std::uint64_t KeyOf(const Vector3d& place) {
  constexpr double kMiddle = 1 << 20;  // places may be negative
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    key = key << 21 | static_cast<std::uint64_t>(std::clamp(place[axis] + kMiddle, 0., 2 * kMiddle - 1));
  }
  return key;
}

// The parts of a cell's corners in the trilinear mean at a point of it, in their order. They add up to 1.
std::array<double, 8> CornerWeights(const SurfaceGrid& grid, int cell, const Vector3d& point) {
  const double width = std::ldexp(grid.size, grid.levels[cell]);
  const Vector3d t = ((point - grid.points[grid.cells[cell][0]]) / width).cwiseMax(0).cwiseMin(1);
  std::array<double, 8> weights;
  for (int c = 0; c < 8; ++c) {
    const bool is_right = c % 4 == 1 || c % 4 == 2, is_back = c % 4 >= 2, is_up = c >= 4;
    weights[c] = (is_right ? t.x() : 1 - t.x()) * (is_back ? t.y() : 1 - t.y()) * (is_up ? t.z() : 1 - t.z());
  }
  return weights;
}

}  // namespace

FrameInterpolation::FrameInterpolation(const char* caller, const SurfaceGrid& grid, const std::vector<Matrix3d>& frames)
    : grid_(grid), frames_(frames) {
  if (frames.size() != grid.points.size()) {
    throw std::invalid_argument(std::string(caller) + ": " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(grid.points.size()) + " nodes");
  }
  hexadecapoles_.reserve(frames.size());
  for (const Matrix3d& frame : frames) {
    CheckRotation(caller, frame);
    hexadecapoles_.push_back(HarmonicFromFrame<4>(frame));
  }
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const std::size_t level = grid.levels[i];
    if (level >= cells_.size()) cells_.resize(level + 1);
    const Vector3d place = (grid.points[grid.cells[i][0]] - grid.origin) / std::ldexp(grid.size, grid.levels[i]);
    cells_[level].emplace_back(KeyOf(place.array().round()), static_cast<int>(i));
  }
  for (auto& of_level : cells_) std::sort(of_level.begin(), of_level.end());
}

int FrameInterpolation::FindCell(const Vector3d& point) const {
  Vector3d place = (point - grid_.origin) / grid_.size;
  for (const auto& of_level : cells_) {
    const std::uint64_t key = KeyOf(place.array().floor());
    const auto found = std::lower_bound(of_level.begin(), of_level.end(), std::pair(key, 0));
    if (found != of_level.end() && found->first == key) return found->second;
    place /= 2;
  }
  return -1;
}

Matrix3d FrameInterpolation::Interpolate(int cell, const Vector3d& point) const {
  const std::array<int, 8>& nodes = grid_.cells[cell];
  const std::array<double, 8> weights = CornerWeights(grid_, cell, point);
  const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  const Matrix3d& guess = frames_[nodes[heaviest]];
  Hexadecapole mean = Hexadecapole::Zero();
  for (int c = 0; c < 8; ++c) {
    if (weights[c] > 0) mean += weights[c] * hexadecapoles_[nodes[c]];
  }
  // A mean that cancels has no nearest frame.
  return mean.isZero(1e-12) ? guess : NearestFrame<4>(mean, guess);
}

}  // namespace octupole::internal
