#include "octupole/map_solvers/seamless_map.h"

#include <ceres/iteration_callback.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "cylinder_mesh.h"
#include "octupole/maps/map_obstacles.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_solver.h"
#include "rib_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

using testing::HasSubstr;

std::vector<Eigen::Matrix3d> ConstantFrames(const TetMesh& mesh) {
  return std::vector<Eigen::Matrix3d>(mesh.points.size(), Eigen::Matrix3d::Identity());
}

// Two boxes apart, each with a map of its own.
TetMesh TwoBoxes() {
  TetMesh mesh = MakeBoxMesh({3, 2, 2}, {3, 2, 2});
  const TetMesh other = mesh;
  const int n = static_cast<int>(mesh.points.size());
  for (const Eigen::Vector3d& p : other.points) mesh.points.push_back(p + Eigen::Vector3d(10, 0, 0));
  for (const auto& [a, b, c, d] : other.tets) mesh.tets.push_back({a + n, b + n, c + n, d + n});
  return mesh;
}

TEST(SeamlessMap, TakesABoxToTheBox) {
  constexpr double kSize = 0.4;
  const TetMesh mesh = TwoBoxes();
  MapOptions options;
  options.size = kSize;
  const SeamlessMap map = SolveSeamlessMap(mesh, ConstantFrames(mesh), options);
  EXPECT_EQ(map.termination, ceres::CONVERGENCE);
  EXPECT_EQ(map.domain.combed.num_components, 2);
  EXPECT_TRUE(map.flipped.empty());
  for (std::size_t t = 0; t < map.parameters.size(); ++t) {
    const auto& tet = map.domain.mesh.tets[t];
    const Eigen::Matrix3d axes = map.domain.combed.frames[t].transpose();
    for (int i = 1; i < 4; ++i) {
      const Eigen::Vector3d along = (map.domain.mesh.points[tet[i]] - map.domain.mesh.points[tet[0]]) / kSize;
      EXPECT_LT((map.parameters[t][i] - map.parameters[t][0] - axes * along).norm(), 1e-3);
    }
  }
  const MapQuality quality = MeasureMap(map.domain.mesh, map.parameters, kSize);
  EXPECT_EQ(quality.flipped, 0u);
  EXPECT_NEAR(quality.parameter_volume, 24 / (kSize * kSize * kSize), 0.1);
  EXPECT_NEAR(quality.stretch_5, 1, 1e-3);
  EXPECT_NEAR(quality.stretch_95, 1, 1e-3);
}

// Four curves of valence 3, each as long as the cylinder is high. On a mesh as coarse as this some tets stay turned
// over; they are what the obstacles name.
TEST(SeamlessMap, OfACylinderHasFourCurvesOfValenceThree) {
  const TetMesh mesh = MakeCylinderMesh(8, 6, 2);
  const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
  const SeamlessMap map = SolveSeamlessMap(mesh, frames);
  double height = 0;
  for (const SingularEdge& edge : map.domain.singular_edges) {
    EXPECT_EQ(edge.valence, 3);
    const auto [a, b] = edge.vertices;
    height += std::abs(map.domain.mesh.points[a].z() - map.domain.mesh.points[b].z());
  }
  EXPECT_NEAR(height, 4 * 2, 1e-9);
  std::size_t num_named = 0;
  for (const MapObstacle& obstacle : FindObstacles(map.domain, map.flipped)) num_named += obstacle.tets.size();
  EXPECT_EQ(num_named, map.flipped.size());
  EXPECT_EQ(map.flipped == map.domain.collapsed, map.termination == ceres::CONVERGENCE);
  const MapQuality quality = MeasureMap(map.domain.mesh, map.parameters, map.size);
  EXPECT_LE(quality.flipped, map.flipped.size());
  EXPECT_LT(quality.flipped_volume, 0.005);
}

// Four curves, each as long as the cylinder is high, of which H makes a five-hundredth of a cell.
TEST(SeamlessMap, NamesCurvesThatTheSizeIsTooLargeFor) {
  const TetMesh mesh = MakeCylinderMesh(8, 6, 2);
  const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
  MapOptions options;
  for (const double size : {0., 1000.}) {
    options.size = size;
    const SeamlessMap map = SolveSeamlessMap(mesh, frames, options);
    int num_short = 0;
    for (const MapObstacle& obstacle : FindObstacles(map.domain, map.flipped, map.parameters)) {
      if (obstacle.kind != ObstacleKind::kShortCurve) continue;
      ++num_short;
      EXPECT_NEAR(obstacle.size, 2, 0.2);
      EXPECT_NEAR(obstacle.cells, 0.002, 0.0005);
      EXPECT_THAT(obstacle.Describe(), HasSubstr("the size is too large for it; at"));
    }
    EXPECT_EQ(num_short, size == 0 ? 0 : 4);
  }
}

// A rib of 45 degrees, whose slope is of one sheet with the plate: no tetrahedron at its tip is turned over.
TEST(SeamlessMap, OfARibIsFlatNowhere) {
  const TetMesh mesh = MakeRibMesh(1);
  const SeamlessMap map = SolveSeamlessMap(mesh, SolveField<3>(mesh).frames);
  EXPECT_EQ(map.termination, ceres::CONVERGENCE);
  EXPECT_TRUE(map.flipped.empty());
  EXPECT_FALSE(map.is_integer_grid);
}

void ExpectWholeSheets(const SeamlessMap& map) {
  for (const BoundarySheets::Face& face : map.domain.sheets.faces) {
    const double value = map.parameters[face.tet][(face.corner + 1) % 4][face.axis];
    EXPECT_NEAR(value, std::round(value), 1e-12);
  }
}

// Two boxes of 3 x 2 x 2 with cells of 0.43: 7 x 5 x 5 hexahedra each.
TEST(SeamlessMap, RoundsToAnIntegerGrid) {
  const TetMesh mesh = TwoBoxes();
  MapOptions options;
  options.size = 0.43;
  options.integer = true;
  const SeamlessMap map = SolveSeamlessMap(mesh, ConstantFrames(mesh), options);
  EXPECT_TRUE(map.flipped.empty());
  EXPECT_EQ(map.num_rounded, 2 * 6);
  EXPECT_TRUE(map.is_integer_grid);
  EXPECT_EQ(map.domain.unknowns.num_fractional, 0);
  EXPECT_NEAR(MeasureMap(map.domain.mesh, map.parameters, map.size).parameter_volume, 2 * 7 * 5 * 5, 1e-9);
  ExpectWholeSheets(map);
}

// What rounding turns over on meshes as coarse as these takes more vertices to turn back, and what is whole stays so.
// Which of them rounding turns over is a matter of the last digits.
TEST(SeamlessMap, RefinesWhatRoundingTurnsOver) {
  struct Case {
    int cells;
    double height, size;
  };
  bool is_mended = false;
  for (const Case& c : {Case{6, 1, 1.27}, {6, 2, 1.9}, {8, 1, 0.79}}) {
    const TetMesh mesh = MakeCylinderMesh(c.cells, 2, c.height);
    const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
    MapOptions options;
    options.size = c.size;
    const std::size_t num_tets = SolveSeamlessMap(mesh, frames, options).domain.mesh.tets.size();
    options.integer = true;
    const SeamlessMap map = SolveSeamlessMap(mesh, frames, options);
    ExpectWholeSheets(map);
    EXPECT_EQ(map.num_rounded, 10);
    EXPECT_EQ(map.flipped.empty(), map.termination == ceres::CONVERGENCE);
    EXPECT_EQ(map.is_integer_grid, map.flipped.empty());
    if (!map.flipped.empty() || map.domain.mesh.tets.size() == num_tets) continue;
    is_mended = true;
    const MapQuality quality = MeasureMap(map.domain.mesh, map.parameters, map.size);
    EXPECT_GT(quality.parameter_volume, 0.5);
    EXPECT_NEAR(quality.parameter_volume, std::round(quality.parameter_volume), 1e-9);
    break;  // one is enough
  }
  EXPECT_TRUE(is_mended);
}

// Ends after some calls, and keeps the summaries.
class Listener final : public ceres::IterationCallback {
 public:
  Listener(int num_calls, ceres::CallbackReturnType wish) : num_calls_(num_calls), wish_(wish) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    summaries.push_back(summary);
    return static_cast<int>(summaries.size()) < num_calls_ ? ceres::SOLVER_CONTINUE : wish_;
  }

  std::vector<ceres::IterationSummary> summaries;

 private:
  const int num_calls_;
  const ceres::CallbackReturnType wish_;
};

// Axes that turn by a third of a radian along a box, so that no map follows them everywhere.
TEST(SeamlessMap, ReportsTheCostOfTheLeastSquares) {
  const TetMesh mesh = MakeBoxMesh({6, 3, 3}, {6, 3, 3});
  std::vector<Eigen::Matrix3d> frames;
  for (const Eigen::Vector3d& p : mesh.points) {
    frames.push_back(Eigen::AngleAxisd(p.x() / 18, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  }
  MapOptions options;
  Listener listener(1000, ceres::SOLVER_CONTINUE);
  options.callback = &listener;
  const SeamlessMap map = SolveSeamlessMap(mesh, frames, options);
  ASSERT_EQ(map.num_iterations, 0) << "nothing is turned over, so that all that is reported is of the fit";
  ASSERT_FALSE(listener.summaries.empty());
  for (const ceres::IterationSummary& summary : listener.summaries) EXPECT_GE(summary.cost_change, 0);
  // All tetrahedra of a box mesh are of one volume.
  double cost = 0;
  for (std::size_t t = 0; t < map.parameters.size(); ++t) {
    Eigen::Matrix3d edges, images;
    for (int i = 0; i < 3; ++i) {
      edges.col(i) = mesh.points[mesh.tets[t][i + 1]] - mesh.points[mesh.tets[t][0]];
      images.col(i) = map.parameters[t][i + 1] - map.parameters[t][0];
    }
    cost += (map.size * images * edges.inverse() - map.domain.combed.frames[t].transpose()).squaredNorm();
  }
  EXPECT_GT(cost, 0.1);
  EXPECT_NEAR(listener.summaries.back().cost, cost, 1e-9 * cost);
}

// In the fit, while it rounds: whatever is reached is a map, only not a good one.
TEST(SeamlessMap, EndsWhenTheCallbackWants) {
  const TetMesh mesh = MakeCylinderMesh(6, 2, 1);
  const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
  MapOptions options;
  options.size = 1.27;
  options.integer = true;
  Listener all(1000000, ceres::SOLVER_CONTINUE);
  options.callback = &all;
  SolveSeamlessMap(mesh, frames, options);
  const int num_calls = static_cast<int>(all.summaries.size());
  for (const auto& [k, wish, termination] :
       {std::tuple(1, ceres::SOLVER_ABORT, ceres::USER_FAILURE),
        {num_calls / 2, ceres::SOLVER_TERMINATE_SUCCESSFULLY, ceres::USER_SUCCESS}}) {
    Listener some(k, wish);
    options.callback = &some;
    const SeamlessMap map = SolveSeamlessMap(mesh, frames, options);
    EXPECT_EQ(map.termination, termination) << k;
    EXPECT_EQ(static_cast<int>(some.summaries.size()), k);
    EXPECT_FALSE(map.is_integer_grid) << k;
    for (const BoundarySheets::Face& face : map.domain.sheets.faces) {
      if (face.is_released) continue;
      const auto& corners = map.parameters[face.tet];
      for (int i = 1; i < 4; ++i) {
        EXPECT_NEAR(corners[(face.corner + i) % 4][face.axis], corners[(face.corner + 1) % 4][face.axis], 1e-12);
      }
    }
  }
}

// A map is its own fit: started from there, it comes back, up to shifts, and where H is another one, scaled.
TEST(SeamlessMap, BeginsWithAnEarlierOne) {
  const TetMesh mesh = MakeCylinderMesh(8, 6, 2);
  const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
  MapOptions options;
  options.max_iterations = 0;
  const SeamlessMap first = SolveSeamlessMap(mesh, frames, options);
  options.start = MeshMap{first.domain.mesh, first.parameters};
  for (const double factor : {1., 2.}) {
    options.size = factor * first.size;
    const SeamlessMap second = SolveSeamlessMap(mesh, frames, options);
    ASSERT_EQ(second.parameters.size(), first.parameters.size());
    double largest = 0;
    for (std::size_t t = 0; t < first.parameters.size(); ++t) {
      for (int i = 1; i < 4; ++i) {
        const Eigen::Vector3d one = first.parameters[t][i] - first.parameters[t][0],
                              other = second.parameters[t][i] - second.parameters[t][0];
        largest = std::max(largest, (one - factor * other).norm());
      }
    }
    EXPECT_LT(largest, 2e-3) << factor;
  }
  const TetMesh box = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  EXPECT_THAT(MessageOf<std::invalid_argument>([&] { SolveSeamlessMap(box, ConstantFrames(box), options); }),
              HasSubstr("the start is a map of another mesh"));
}

TEST(SeamlessMap, DoesNotDependOnTheNumberOfThreads) {
  const TetMesh mesh = MakeCylinderMesh(6, 4, 2);
  const std::vector<Eigen::Matrix3d> frames = SolveField<3>(mesh).frames;
  MapOptions options;
  const SeamlessMap one = SolveSeamlessMap(mesh, frames, options);
  options.num_threads = 3;
  const SeamlessMap three = SolveSeamlessMap(mesh, frames, options);
  EXPECT_EQ(one.parameters, three.parameters);
}

TEST(SeamlessMap, NamesBadOptions) {
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const auto message = [&](const MapOptions& options) {
    return MessageOf<std::invalid_argument>([&] { SolveSeamlessMap(mesh, ConstantFrames(mesh), options); });
  };
  MapOptions options;
  options.size = -1;
  EXPECT_THAT(message(options), HasSubstr("the size is -1"));
  options = {};
  options.max_iterations = -2;
  EXPECT_THAT(message(options), HasSubstr("max_iterations is -2"));
}

}  // namespace
}  // namespace octupole
