#include "octupole/grids/surface_grid_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "cylinder_mesh.h"
#include "octupole/frames/frame.h"
#include "octupole/grids/surface_grid_tets.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/singular_triangles.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

using Frames = std::vector<Eigen::Matrix3d>;

double EnergyOf(const SurfaceGrid& grid, const Frames& frames) {
  double energy = 0;
  for (const auto& [a, b, weight] : grid.graph.edges) energy += weight * FrameDifference<4>(frames[a], frames[b]);
  return energy;
}

// Four curves of valence 3 from end to end; with levels, the energy of cells of one size.
TEST(SolveOnGrids, GoesFromCoarseToFine) {
  const TriangleMesh surface = BoundarySurface(MakeCylinderMesh(48, 24, 2));
  for (const int levels : {1, 3}) {
    GridOptions options;
    options.size = levels == 1 ? 0.023 : 0.06;
    options.levels = levels;
    Frames frames;
    std::vector<std::size_t> num_nodes;
    double first_energy = 0;
    const SurfaceGrid grid = SolveOnGrids(surface, options, [&](const SurfaceGrid& each, Frames start) {
      EXPECT_EQ(start.size(), num_nodes.empty() ? 0 : each.points.size());
      num_nodes.push_back(each.points.size());
      frames = start.empty() ? SolveFast<3>(each.graph, {}).frames : PolishField<3>(each.graph, {}, start).frames;
      if (start.empty()) first_energy = EnergyOf(each, frames);
      return frames;
    });
    ASSERT_EQ(num_nodes.size(), 2u);
    EXPECT_EQ(num_nodes.back(), grid.points.size());
    EXPECT_EQ(grid.size, options.size);
    const GridTets tets = TetsAtSingularities(grid, frames);
    const SingularCurves curves =
        TraceSingularCurves(tets.mesh, tets.frames, FindSingularTriangles(tets.mesh, tets.frames));
    ASSERT_EQ(curves.curves.size(), 4u) << levels;
    for (const SingularCurve& curve : curves.curves) {
      EXPECT_EQ(curve.valence, 3);
      EXPECT_NEAR(curve.length, 2.05, 0.1);
    }
    if (levels > 1) {
      EXPECT_NEAR(EnergyOf(grid, frames) / first_energy, 1, 0.03);
    }
  }
}

TEST(SolveOnGrids, WantsAFrameForEachNode) {
  GridOptions options;
  options.size = 0.2;
  const auto solve = [](const SurfaceGrid&, const Frames&) { return Frames(1); };
  EXPECT_THROW(SolveOnGrids(BoundarySurface(MakeCylinderMesh(16, 4, 2)), options, solve), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
