#include "octupole/grids/surface_grid_quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "octupole/field/field_quality.h"
#include "octupole/grids/internal/grid_alignment.h"
#include "octupole/grids/internal/grid_interpolation.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Samples on the surface are at most this many cells apart.
constexpr double kSpacing = 1;

}  // namespace

GridQuality MeasureGridField(const TriangleMesh& surface, const SurfaceGrid& grid,
                             const std::vector<Matrix3d>& frames) {
  const internal::FrameInterpolation field("MeasureGridField", grid, frames);
  GridQuality quality;
  quality.energy3 = SmoothnessOfFrames<3>(grid.graph.edges, frames);
  quality.energy4 = SmoothnessOfFrames<4>(grid.graph.edges, frames);
  double sum = 0;
  for (const auto& triangle : surface.triangles) {
    const Vector3d normal = TriangleNormal(surface.points, triangle);
    if (normal.isZero(0)) continue;
    std::array<Vector3d, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = surface.points[triangle[i]];
    internal::SampleTriangle(corners, kSpacing * grid.size, [&](const Vector3d& x, double) {
      const int cell = field.FindCell(x);
      if (cell < 0) return;
      const std::array<int, 8>& nodes = grid.cells[cell];
      const auto may_be_smooth = [&](int v) { return grid.graph.alignments[v].kind() != AlignmentKind::kFrame; };
      const auto is_aligned = [&](int v) { return grid.graph.alignments[v].kind() == AlignmentKind::kAxis; };
      if (!std::all_of(nodes.begin(), nodes.end(), may_be_smooth)) return;
      if (std::none_of(nodes.begin(), nodes.end(), is_aligned)) return;
      const Matrix3d frame = field.Interpolate(cell, x);
      const double cosine = (frame.transpose() * normal).cwiseAbs().maxCoeff();
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
