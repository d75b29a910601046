#include "octupole/grids/surface_grid_sampler.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/frames/frame.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using Frames = std::vector<Eigen::Matrix3d>;

Eigen::Matrix3d SmoothFrame(const Vector3d& p) {
  return Eigen::AngleAxisd(0.8 * p.x() + 0.3 * p.y() * p.z(), Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

SurfaceGrid MakeBallGrid(double size, int levels) {
  GridOptions options;
  options.size = size;
  options.levels = levels;
  return MakeGrid(BoundarySurface(MakeBallMesh(24)), options);
}

Frames SmoothFrames(const SurfaceGrid& grid) {
  Frames frames;
  for (const Vector3d& p : grid.points) frames.push_back(SmoothFrame(p));
  return frames;
}

double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::sqrt(FrameDifference<4>(a, b) * 3 / 20);
}

TEST(GridSampler, InterpolatesSmoothFields) {
  for (const int levels : {1, 3}) {
    const SurfaceGrid grid = MakeBallGrid(0.05, levels);
    const Frames frames = SmoothFrames(grid);
    const GridSampler sampler(grid, frames);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-0.57, 0.57);
    std::vector<Vector3d> points;
    for (int i = 0; i < 1000; ++i) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    const FieldSamples samples = sampler.Sample(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(samples.is_inside[i]);
      // Linear between nodes, so the error is of second order.
      EXPECT_LT(AngleBetween(samples.frames[i], SmoothFrame(points[i])), levels == 1 ? 1e-3 : 1e-2);
    }
  }
}

TEST(GridSampler, HasTheFramesOfNodes) {
  const SurfaceGrid grid = MakeBallGrid(0.1, 1);
  const Frames frames = SmoothFrames(grid);
  const FieldSamples samples = GridSampler(grid, frames).Sample(grid.points);
  // On the far sides of the last cells, points are outside all cells or not, by rounding.
  for (std::size_t v = 0; v < frames.size(); ++v) EXPECT_LT(AngleBetween(samples.frames[v], frames[v]), 1e-6);
}

TEST(GridSampler, GoesToTheNearestCellFromOutside) {
  const SurfaceGrid grid = MakeBallGrid(0.1, 2);
  const Frames frames = SmoothFrames(grid);
  const FieldSamples samples = GridSampler(grid, frames).Sample({{3, 0, 0}, {0, 0, -20}, {0, 0, 0}});
  EXPECT_EQ(samples.is_inside, (std::vector<std::uint8_t>{0, 0, 1}));
  EXPECT_LT(AngleBetween(samples.frames[0], SmoothFrame({1, 0, 0})), 0.12);
  EXPECT_LT(AngleBetween(samples.frames[1], SmoothFrame({0, 0, -1})), 0.12);
}

TEST(GridSampler, SaysWhatIsWrong) {
  const SurfaceGrid grid = MakeBallGrid(0.2, 1);
  const Frames frames = SmoothFrames(grid);
  EXPECT_THROW(GridSampler(grid, {}), std::invalid_argument);
  Frames scaled = frames;
  scaled[5] *= 2;
  EXPECT_NE(MessageOf<std::invalid_argument>([&] { GridSampler(grid, scaled); }).find("GridSampler: "),
            std::string::npos);
  EXPECT_NE(MessageOf<std::invalid_argument>([&] {
              GridSampler(grid, frames).Sample({{0, 0, 0}, {0, NAN, 0}});
            }).find("GridSampler: point 1 is not finite"),
            std::string::npos);
}

}  // namespace
}  // namespace octupole
