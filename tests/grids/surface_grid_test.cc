#include "octupole/grids/surface_grid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "ball_mesh.h"
#include "cylinder_mesh.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

TriangleMesh Box(const Vector3d& size) { return BoundarySurface(MakeBoxMesh({1, 1, 1}, size)); }

TriangleMesh Ball() { return BoundarySurface(MakeBallMesh(24)); }

SurfaceGrid GridOfSize(const TriangleMesh& surface, double size, int levels = 1) {
  GridOptions options;
  options.size = size;
  options.levels = levels;
  return MakeGrid(surface, options);
}

double WidthOf(const SurfaceGrid& grid, std::size_t cell) { return std::ldexp(grid.size, grid.levels[cell]); }

double VolumeOf(const SurfaceGrid& grid) {
  double volume = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) volume += std::pow(WidthOf(grid, i), 3);
  return volume;
}

TEST(MakeGrid, CoversABoxWithHalfACellBeyondItsFaces) {
  const SurfaceGrid grid = GridOfSize(Box({1, 2, 3}), 0.25);
  EXPECT_EQ(grid.points.size(), 6u * 10 * 14);
  EXPECT_EQ(grid.cells.size(), 5u * 9 * 13);
  EXPECT_EQ(grid.levels, std::vector<std::uint8_t>(grid.cells.size(), 0));
  EXPECT_TRUE(grid.hanging_nodes.empty());
  EXPECT_EQ(grid.graph.num_vertices(), grid.points.size());
  EXPECT_EQ(grid.graph.edges.size(), 5u * 10 * 14 + 6 * 9 * 14 + 6 * 10 * 13);
  CheckFieldGraph(grid.graph);
}

TEST(MakeGrid, MeasuresTheDistanceToABall) {
  for (const int levels : {1, 3}) {
    const SurfaceGrid grid = GridOfSize(BoundarySurface(MakeBallMesh(48)), 0.05, levels);
    double deepest = 0;
    for (std::size_t v = 0; v < grid.points.size(); ++v) {
      const double exact = grid.points[v].norm() - 1;
      const double distance = grid.distances[v];
      deepest = std::min(deepest, distance);
      if (exact > -0.1) {
        EXPECT_NEAR(distance, exact, 2e-3) << v;  // the triangles lie inside the ball
      } else {
        EXPECT_LT(distance, -0.095) << v;
      }
    }
    EXPECT_NEAR(deepest, -3 * 0.05 * (1 << (levels - 1)), 0.01);
  }
}

TEST(MakeGrid, GradesTwoToOne) {
  const SurfaceGrid grid = GridOfSize(Ball(), 0.03, 4);
  EXPECT_EQ(*std::max_element(grid.levels.begin(), grid.levels.end()), 3);
  // The levels of all cells that have a point of the finest lattice.
  std::map<std::array<long, 3>, std::set<int>> levels_at;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const int width = 1 << grid.levels[i];
    const Vector3d corner = (grid.points[grid.cells[i][0]] - grid.points[0]) / grid.size;
    for (int x = 0; x <= width; ++x) {
      for (int y = 0; y <= width; ++y) {
        for (int z = 0; z <= width; ++z) {
          levels_at[{std::lround(corner.x()) + x, std::lround(corner.y()) + y, std::lround(corner.z()) + z}].insert(
              grid.levels[i]);
        }
      }
    }
  }
  for (const auto& [point, levels] : levels_at) EXPECT_LE(*levels.rbegin() - *levels.begin(), 1);
}

TEST(MakeGrid, CoversTheSameSolidWithAnyLevels) {
  const SurfaceGrid uniform = GridOfSize(Ball(), 0.05);
  for (const int levels : {2, 3, 4}) {
    const SurfaceGrid grid = GridOfSize(Ball(), 0.05, levels);
    EXPECT_NEAR(VolumeOf(grid), VolumeOf(uniform), 1e-9);
    EXPECT_LT(grid.points.size(), uniform.points.size());
  }
}

TEST(MakeGrid, FindsHangingNodesInTheMiddle) {
  const SurfaceGrid grid = GridOfSize(Ball(), 0.04, 3);
  EXPECT_FALSE(grid.hanging_nodes.empty());
  for (const auto& [node, ends] : grid.hanging_nodes) {
    EXPECT_NEAR((grid.points[node] - (grid.points[ends[0]] + grid.points[ends[1]]) / 2).norm(), 0, 1e-12);
    EXPECT_TRUE((grid.points[ends[0]].array() <= grid.points[ends[1]].array() + 1e-12).all());
  }
}

// The claim of the header for linear functions: to rounding, with any levels.
TEST(MakeGrid, HasTheEnergyOfLinearFunctions) {
  for (const int levels : {1, 2, 4}) {
    const SurfaceGrid grid = GridOfSize(Ball(), 0.04, levels);
    const double volume = VolumeOf(grid);
    for (const Vector3d& gradient : {Vector3d(1, 0, 0), Vector3d(0.3, -2, 0.7)}) {
      double energy = 0;
      for (const auto& [a, b, weight] : grid.graph.edges) {
        energy += weight * std::pow(gradient.dot(grid.points[b] - grid.points[a]), 2);
      }
      EXPECT_NEAR(energy * grid.size, gradient.squaredNorm() * volume, 1e-9 * volume);
    }
  }
}

// And the other claim: forces cancel at inner nodes, those in the middle of a coarser cell's face included.
TEST(MakeGrid, HasLinearFunctionsInBalance) {
  for (const int levels : {1, 2, 3, 5}) {
    const SurfaceGrid grid = GridOfSize(Ball(), 0.03, levels);
    for (const Vector3d& gradient : {Vector3d(1, 0, 0), Vector3d(0.3, -2, 0.7)}) {
      std::vector<double> force(grid.points.size(), 0);
      for (const auto& [a, b, weight] : grid.graph.edges) {
        EXPECT_GT(weight, 0);
        const double difference = weight * gradient.dot(grid.points[b] - grid.points[a]) / grid.size;
        force[a] += difference;
        force[b] -= difference;
      }
      double largest = 0;
      for (std::size_t v = 0; v < force.size(); ++v) {
        if (grid.distances[v] < 0) largest = std::max(largest, std::abs(force[v]));
      }
      EXPECT_LT(largest, 1e-9) << levels;
    }
  }
}

// Only what the surface runs through has to be fine.
TEST(MakeGrid, IsCoarseInside) {
  const SurfaceGrid uniform = GridOfSize(Ball(), 0.02), graded = GridOfSize(Ball(), 0.02, 5);
  EXPECT_LT(graded.points.size(), 0.25 * uniform.points.size());
  for (std::size_t i = 0; i < graded.cells.size(); ++i) {
    const double depth = 1 - (graded.points[graded.cells[i][0]].norm() + WidthOf(graded, i));
    EXPECT_TRUE(graded.levels[i] > 0 || depth < 3 * 0.02) << depth;
  }
}

// Where an odd number of the finest cells fits between two faces, both run through the deeper of two siblings.
TEST(MakeGrid, IsFineInOneLayerAlongABox) {
  const SurfaceGrid grid = GridOfSize(Box({1, 1, 1}), 1. / 15, 2);
  EXPECT_EQ(std::count(grid.levels.begin(), grid.levels.end(), 0), 16 * 16 * 16 - 14 * 14 * 14);
}

TEST(MakeGrid, IsFineAtFinePoints) {
  GridOptions options;
  options.size = 0.03;
  options.levels = 4;
  options.fine_points = {{0.1, 0.2, 0.3}, {5, 0, 0}};
  const SurfaceGrid grid = MakeGrid(Ball(), options);
  int num_near = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const Vector3d& low = grid.points[grid.cells[i][0]];
    const Vector3d middle = low + Vector3d::Constant(WidthOf(grid, i) / 2);
    if ((middle - options.fine_points[0]).cwiseAbs().maxCoeff() > 0.045) continue;
    ++num_near;
    EXPECT_EQ(grid.levels[i], 0);
  }
  EXPECT_GE(num_near, 27);
}

// On a field that turns smoothly, the energies with cells of one size and of several differ by the square of the angle
// between neighbours: where the field turns half as fast, by a quarter.
TEST(MakeGrid, HasTheEnergyOfASmoothField) {
  const SurfaceGrid uniform = GridOfSize(Ball(), 0.05, 1), graded = GridOfSize(Ball(), 0.05, 3);
  const auto energy_of = [](const SurfaceGrid& grid, double rate) {
    std::vector<Eigen::Matrix3d> frames;
    for (const Vector3d& p : grid.points) {
      const double angle = rate * (0.8 * std::sin(2 * p.x()) + 0.5 * p.y() * p.z());
      frames.push_back(Eigen::AngleAxisd(angle, Vector3d(1, 2, 3).normalized()).toRotationMatrix());
    }
    double energy = 0;
    for (const auto& [a, b, weight] : grid.graph.edges) energy += weight * FrameDifference<3>(frames[a], frames[b]);
    return energy;
  };
  const auto difference = [&](double rate) { return std::abs(energy_of(graded, rate) / energy_of(uniform, rate) - 1); };
  EXPECT_LT(difference(1), 0.04);
  EXPECT_LT(difference(0.5), 0.012);
  EXPECT_LT(difference(0.25), 0.005);
}

// The largest angle between the radius and the axis that a node near the unit sphere is given.
double LargestAngleToRadius(const SurfaceGrid& grid) {
  double largest = 0;
  for (std::size_t v = 0; v < grid.points.size(); ++v) {
    const Alignment& alignment = grid.graph.alignments[v];
    if (alignment.kind() == AlignmentKind::kFree) continue;
    EXPECT_EQ(alignment.kind(), AlignmentKind::kAxis);
    const double cosine = std::abs(alignment.frame().col(2).dot(grid.points[v].normalized()));
    largest = std::max(largest, std::acos(std::min(1., cosine)));
  }
  return largest * 180 / M_PI;
}

TEST(MakeGrid, AlignsNodesWithASmoothSurface) {
  const TriangleMesh sphere = BoundarySurface(MakeBallMesh(64));
  const SurfaceGrid grid = GridOfSize(sphere, 0.1);
  EXPECT_EQ(grid.alignment.num_frames + grid.alignment.num_tangents + grid.alignment.num_free, 0u);
  EXPECT_EQ(grid.alignment.num_feature_edges, 0u);
  for (std::size_t v = 0; v < grid.points.size(); ++v) {
    const double distance = std::abs(grid.points[v].norm() - 1);
    if (std::abs(distance - 0.09) < 2e-3) continue;
    EXPECT_EQ(grid.graph.alignments[v].kind() == AlignmentKind::kAxis, distance < 0.09) << distance;
  }
  EXPECT_LT(LargestAngleToRadius(grid), 3);
}

TEST(MakeGrid, PrescribesFramesAtRightAngles) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  TriangleMesh box = Box({1, 1, 1});
  for (Vector3d& p : box.points) p = turn * p;
  const SurfaceGrid grid = GridOfSize(box, 0.1);
  EXPECT_EQ(grid.alignment.num_feature_edges, 12u);
  EXPECT_EQ(grid.alignment.num_free + grid.alignment.num_tangents, 0u);
  EXPECT_GT(grid.alignment.num_frames, 12u * 10);
  for (const Alignment& alignment : grid.graph.alignments) {
    if (alignment.kind() == AlignmentKind::kFrame) {
      EXPECT_LT(FrameDifference<3>(alignment.frame(), turn), 16 * std::pow(0.07, 2));
    } else if (alignment.kind() == AlignmentKind::kAxis) {
      EXPECT_GT((turn.transpose() * alignment.frame().col(2)).cwiseAbs().maxCoeff(), std::cos(0.3));
    }
  }
}

TEST(MakeGrid, FollowsMarkedEdgesOnSmoothSurfaces) {
  TriangleMesh box = BoundarySurface(MakeBoxMesh({4, 4, 1}, {1, 1, 0.5}));
  // A line across the top, turned by 26.6 degrees from the axes.
  const auto find = [&](const Vector3d& p) {
    return static_cast<int>(
        std::find_if(box.points.begin(), box.points.end(), [&](const Vector3d& q) { return (p - q).norm() < 1e-9; }) -
        box.points.begin());
  };
  box.feature_edges = {{find({0.25, 0.25, 0.5}), find({0.75, 0.5, 0.5})}};
  const SurfaceGrid grid = GridOfSize(box, 0.05);
  EXPECT_TRUE(grid.alignment.has_marked_features);
  int num_on_line = 0;
  for (std::size_t v = 0; v < grid.points.size(); ++v) {
    if ((grid.points[v] - Vector3d(0.5, 0.375, 0.5)).norm() > 0.05) continue;
    ++num_on_line;
    ASSERT_EQ(grid.graph.alignments[v].kind(), AlignmentKind::kFrame);
    const Vector3d direction = Vector3d(2, 1, 0).normalized();
    EXPECT_NEAR((grid.graph.alignments[v].frame().transpose() * direction).cwiseAbs().maxCoeff(), 1, 1e-9);
  }
  EXPECT_GT(num_on_line, 0);
}

// Both sheets reach every node: they ask for the same.
TEST(MakeGrid, AlignsPlatesThinnerThanACell) {
  for (const double thickness : {0.05, 0.02, 0.005}) {
    const SurfaceGrid grid = GridOfSize(Box({1, 1, thickness}), 0.05);
    EXPECT_GT(grid.alignment.num_normals, 0.8 * grid.points.size()) << thickness;
    EXPECT_EQ(grid.alignment.num_free, 0u) << thickness;
    for (std::size_t v = 0; v < grid.points.size(); ++v) {
      if ((grid.points[v] - Vector3d(0.5, 0.5, grid.points[v].z())).norm() > 0.4) continue;
      ASSERT_EQ(grid.graph.alignments[v].kind(), AlignmentKind::kAxis);
      EXPECT_NEAR(std::abs(grid.graph.alignments[v].frame()(2, 2)), 1, 1e-9);
    }
  }
}

TEST(MakeGrid, RefusesWhatMakesNoGrid) {
  const auto message = [](const TriangleMesh& surface, const GridOptions& options) {
    return MessageOf<std::invalid_argument>([&] { MakeGrid(surface, options); });
  };
  GridOptions options;
  for (const double size : {0., -1., std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.size = size;
    EXPECT_NE(message(Ball(), options).find("MakeGrid: the size of the cells must be positive"), std::string::npos);
  }
  options.size = 0.1;
  for (const int levels : {0, 9}) {
    options.levels = levels;
    EXPECT_NE(message(Ball(), options).find("MakeGrid: the levels must be from 1 to 8, not"), std::string::npos);
  }
  options.levels = 1;
  options.feature_angle_deg = 180;
  EXPECT_NE(message(Ball(), options).find("feature angle"), std::string::npos);
  options.feature_angle_deg = 40;
  EXPECT_THROW(MakeGrid(TriangleMesh(), options), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
