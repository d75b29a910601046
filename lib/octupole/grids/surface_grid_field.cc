#include "octupole/grids/surface_grid_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/grids/internal/grid_input.h"
#include "octupole/grids/internal/grid_maker.h"
#include "octupole/grids/surface_grid_sampler.h"
#include "octupole/grids/surface_grid_tets.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/singular_triangles.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The first grid is the finest of cells of one size that has at most so many nodes.
constexpr double kMaxNodes = 500000;

// The options for a grid of cells 2^step times as large.
GridOptions Coarsened(const GridOptions& options, int step, int levels) {
  GridOptions coarse = options;
  coarse.size = std::ldexp(options.size, step);
  coarse.levels = levels;
  return coarse;
}

// The options for the grids, from the first to the one wanted.
std::vector<GridOptions> Grids(const TriangleMesh& surface, const GridOptions& options) {
  int step = 0;
  while (ForecastGrid(surface, Coarsened(options, step, 1)).nodes > kMaxNodes) ++step;
  std::vector<GridOptions> grids = {Coarsened(options, step, 1)};
  if (step == 0 && options.levels > 1) step = 1;
  while (step-- > 0) grids.push_back(Coarsened(options, step, std::max(1, options.levels - step)));
  return grids;
}

// The middles of the singular triangles of a field. They are closer together than the grid's cells are wide.
std::vector<Vector3d> PointsOnCurves(const SurfaceGrid& grid, const std::vector<Matrix3d>& frames) {
  const auto& [mesh, tet_frames] = TetsAtSingularities(grid, frames);
  std::vector<Vector3d> points;
  for (const SingularTriangle& triangle : FindSingularTriangles(mesh, tet_frames)) {
    const auto& [a, b, c] = triangle.vertices;
    points.push_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3);
  }
  return points;
}

}  // namespace

SurfaceGrid SolveOnGrids(const TriangleMesh& surface, const GridOptions& options, const GridSolver& solve,
                         std::vector<std::string>* warnings) {
  internal::CheckGridSize(surface, options);
  const internal::SolidBySurface solid = internal::FindSolid(surface, options.repair, warnings);
  SurfaceGrid grid;
  std::vector<Matrix3d> frames;
  for (GridOptions& each : Grids(surface, options)) {
    std::vector<Matrix3d> start;
    if (frames.empty()) {
      grid = internal::MakeGridOfSolid(surface, solid, each);
    } else {
      const std::vector<Vector3d> curves = PointsOnCurves(grid, frames);
      each.fine_points.insert(each.fine_points.end(), curves.begin(), curves.end());
      SurfaceGrid fine_grid = internal::MakeGridOfSolid(surface, solid, each);
      start = GridSampler(grid, frames).Sample(fine_grid.points).frames;
      grid = std::move(fine_grid);
    }
    frames = std::vector<Matrix3d>();
    frames = solve(grid, std::move(start));
    if (frames.size() != grid.points.size()) {
      throw std::invalid_argument("SolveOnGrids: " + std::to_string(frames.size()) + " frames for " +
                                  std::to_string(grid.points.size()) + " nodes");
    }
  }
  return grid;
}

}  // namespace octupole
