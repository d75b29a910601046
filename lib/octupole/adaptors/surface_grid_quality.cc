#include "octupole/adaptors/surface_grid_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "octupole/adaptors/internal/grid_alignment.h"
#include "octupole/frames/frame.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

// Samples on the surface are at most this many cells apart.
constexpr double kSpacing = 1;

// The finest cells, by their places in the lattice.
class FinestCells {
 public:
  explicit FinestCells(const SurfaceGrid& grid) : grid_(grid) {
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
      if (grid.levels[i] != 0) continue;
      const Vector3d place = InLattice(grid.points[grid.cells[i][0]]);
      cell_at_[KeyOf(place.array().round().cast<int>())] = i;
    }
  }

  Vector3d InLattice(const Vector3d& point) const { return (point - grid_.points[0]) / grid_.size; }

  /// The corners of the cell around a point of the lattice, or nullptr.
  const std::array<int, 8>* Find(const Vector3d& x) const {
    const auto found = cell_at_.find(KeyOf(x.array().floor().cast<int>()));
    return found == cell_at_.end() ? nullptr : &grid_.cells[found->second];
  }

 private:
  static std::uint64_t KeyOf(const Vector3i& p) {
    constexpr std::uint64_t kMiddle = 1 << 20;  // places may be negative
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) key = key << 21 | ((p[axis] + kMiddle) & ((1 << 21) - 1));
    return key;
  }

  const SurfaceGrid& grid_;
  std::unordered_map<std::uint64_t, std::size_t> cell_at_;
};

// The frame at x, within a cell whose first corner is the integer part of x.
Matrix3d Interpolate(const std::array<int, 8>& corners, const std::vector<Matrix3d>& frames, const Vector3d& x) {
  const Vector3d t = x - x.array().floor().matrix();
  Hexadecapole mean = Hexadecapole::Zero();
  for (int c = 0; c < 8; ++c) {
    const bool is_right = c % 4 == 1 || c % 4 == 2, is_back = c % 4 >= 2, is_up = c >= 4;
    const double weight = (is_right ? t.x() : 1 - t.x()) * (is_back ? t.y() : 1 - t.y()) * (is_up ? t.z() : 1 - t.z());
    mean += weight * HarmonicFromFrame<4>(frames[corners[c]]);
  }
  return NearestFrame<4>(mean);
}

}  // namespace

GridQuality MeasureGridField(const TriangleMesh& surface, const SurfaceGrid& grid,
                             const std::vector<Matrix3d>& frames) {
  if (frames.size() != grid.points.size()) {
    throw std::invalid_argument("MeasureGridField: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(grid.points.size()) + " nodes");
  }
  GridQuality quality;
  for (const auto& [a, b, weight] : grid.graph.edges) {
    quality.energy3 += weight * FrameDifference<3>(frames[a], frames[b]);
    quality.energy4 += weight * FrameDifference<4>(frames[a], frames[b]);
  }
  const FinestCells cells(grid);
  double sum = 0;
  for (const auto& triangle : surface.triangles) {
    const Vector3d normal = TriangleNormal(surface.points, triangle);
    if (normal.isZero(0)) continue;
    std::array<Vector3d, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = cells.InLattice(surface.points[triangle[i]]);
    internal::SampleTriangle(corners, kSpacing, [&](const Vector3d& x, double) {
      const std::array<int, 8>* cell = cells.Find(x);
      if (cell == nullptr) return;
      const auto may_be_smooth = [&](int v) { return grid.graph.alignments[v].kind() != AlignmentKind::kFrame; };
      const auto is_aligned = [&](int v) { return grid.graph.alignments[v].kind() == AlignmentKind::kAxis; };
      if (!std::all_of(cell->begin(), cell->end(), may_be_smooth)) return;
      if (std::none_of(cell->begin(), cell->end(), is_aligned)) return;
      const double cosine = (Interpolate(*cell, frames, x).transpose() * normal).cwiseAbs().maxCoeff();
      const double degrees = std::acos(std::min(1., cosine)) * 180 / M_PI;
      sum += degrees * degrees;
      quality.boundary_max_deg = std::max(quality.boundary_max_deg, degrees);
      ++quality.boundary_samples;
    });
  }
  if (quality.boundary_samples > 0) {
    quality.boundary_rms_deg = std::sqrt(sum / static_cast<double>(quality.boundary_samples));
  }
  return quality;
}

}  // namespace octupole
