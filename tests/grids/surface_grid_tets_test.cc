#include "octupole/grids/surface_grid_tets.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "ball_mesh.h"
#include "cylinder_mesh.h"
#include "octupole/frames/random_rotation.h"
#include "octupole/grids/surface_grid.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/singular_triangles.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using Frames = std::vector<Eigen::Matrix3d>;

SurfaceGrid MakeGridOf(const TetMesh& solid, double size, int levels) {
  GridOptions options;
  options.size = size;
  options.levels = levels;
  return MakeGrid(BoundarySurface(solid), options);
}

// The surface area of the union of the cells, by counting the faces of the finest lattice that have a cell on one side.
double AreaOf(const SurfaceGrid& grid) {
  std::set<std::array<long, 3>> filled;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Vector3d corner = (grid.points[grid.cells[i][0]] - grid.points[0]) / grid.size;
    const int width = 1 << grid.levels[i];
    for (int x = 0; x < width; ++x) {
      for (int y = 0; y < width; ++y) {
        for (int z = 0; z < width; ++z) {
          filled.insert({std::lround(corner.x()) + x, std::lround(corner.y()) + y, std::lround(corner.z()) + z});
        }
      }
    }
  }
  double area = 0;
  for (const auto& cell : filled) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        auto neighbour = cell;
        neighbour[axis] += step;
        if (filled.count(neighbour) == 0) area += grid.size * grid.size;
      }
    }
  }
  return area;
}

// A gap or an overlap between the tets of cells of different sizes would add to the boundary.
TEST(TetsOfGrid, FitTogether) {
  for (const int levels : {1, 2, 3}) {
    const SurfaceGrid grid = MakeGridOf(MakeBallMesh(16), 0.07, levels);
    const GridTets tets = TetsOfGrid(grid, Frames(grid.points.size(), Eigen::Matrix3d::Identity()));
    CheckTetMesh(tets.mesh);
    double volume = 0, cells_volume = 0;
    for (const double sixfold : SixfoldVolumes(tets.mesh)) {
      EXPECT_GT(std::abs(sixfold), 1e-9);
      volume += std::abs(sixfold) / 6;
    }
    for (const int level : grid.levels) cells_volume += std::pow(std::ldexp(grid.size, level), 3);
    EXPECT_NEAR(volume, cells_volume, 1e-9);
    double area = 0;
    for (const auto& [a, b, c] : BoundaryTriangles(tets.mesh)) {
      const auto& p = tets.mesh.points;
      area += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    EXPECT_NEAR(area, AreaOf(grid), 1e-9);
  }
}

// The middles of triangles, in millionths.
std::multiset<std::array<long, 3>> CentresOf(const TetMesh& mesh, const std::vector<SingularTriangle>& triangles) {
  std::multiset<std::array<long, 3>> centres;
  for (const SingularTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const Vector3d centre = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3 * 1e6;
    centres.insert({std::lround(centre.x()), std::lround(centre.y()), std::lround(centre.z())});
  }
  return centres;
}

TEST(TetsAtSingularities, HaveAllSingularTriangles) {
  const SurfaceGrid grid = MakeGridOf(MakeBallMesh(16), 0.1, 3);
  // Smooth but for the half x > 0.3, which is random.
  std::mt19937 random(3);
  Frames frames;
  for (const Vector3d& p : grid.points) {
    frames.push_back(p.x() > 0.3 ? RandomRotation(&random).toRotationMatrix()
                                 : Eigen::AngleAxisd(0.2 * p.y(), Vector3d::UnitZ()).toRotationMatrix());
  }
  const GridTets all = TetsOfGrid(grid, frames), some = TetsAtSingularities(grid, frames);
  EXPECT_LT(some.mesh.tets.size(), 0.6 * all.mesh.tets.size());
  const auto of_all = FindSingularTriangles(all.mesh, all.frames);
  const auto of_some = FindSingularTriangles(some.mesh, some.frames);
  EXPECT_GT(of_all.size(), 100u);
  EXPECT_TRUE(CentresOf(all.mesh, of_all) == CentresOf(some.mesh, of_some));
  const auto num_tets = [](const std::vector<SingularTriangle>& triangles) {
    std::size_t count = 0;
    for (const SingularTriangle& triangle : triangles) count += triangle.tets.size();
    return count;
  };
  EXPECT_EQ(num_tets(of_all), num_tets(of_some));
}

TEST(TetsAtSingularities, IsEmptyForAConstantField) {
  const SurfaceGrid grid = MakeGridOf(MakeBallMesh(16), 0.1, 2);
  EXPECT_TRUE(TetsAtSingularities(grid, Frames(grid.points.size(), Eigen::Matrix3d::Identity())).mesh.tets.empty());
  EXPECT_THROW(TetsAtSingularities(grid, {}), std::invalid_argument);
}

// Four curves of valence 3 from end to end: the cross field of a disk.
TEST(TetsAtSingularities, HaveTheCurvesOfACylinder) {
  for (const int levels : {1, 3}) {
    const SurfaceGrid grid = MakeGridOf(MakeCylinderMesh(32, 16, 2), 0.06, levels);
    const Frames frames = SolveFast<3>(grid.graph, {}).frames;
    const GridTets tets = TetsAtSingularities(grid, frames);
    const SingularCurves curves =
        TraceSingularCurves(tets.mesh, tets.frames, FindSingularTriangles(tets.mesh, tets.frames));
    ASSERT_EQ(curves.curves.size(), 4u) << levels;
    for (const SingularCurve& curve : curves.curves) {
      EXPECT_EQ(curve.valence, 3);
      EXPECT_EQ(curve.ends, (std::array<CurveEnd, 2>{CurveEnd::kBoundary, CurveEnd::kBoundary}));
      // Where cells are four times as large, so are the curve's zigzags.
      EXPECT_NEAR(curve.length, levels == 1 ? 2.1 : 2.4, levels == 1 ? 0.1 : 0.4);
    }
  }
}

}  // namespace
}  // namespace octupole
