#include "octupole/field/field_sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "ball_mesh.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::Each;
using testing::HasSubstr;

// A field that turns smoothly about a slanted axis.
Matrix3d Turned(const Vector3d& p) {
  return Eigen::AngleAxisd(0.3 * p.x() + 0.2 * p.y() - 0.1 * p.z(), Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

std::vector<Matrix3d> TurnedAt(const std::vector<Vector3d>& points) {
  std::vector<Matrix3d> frames;
  for (const Vector3d& p : points) frames.push_back(Turned(p));
  return frames;
}

std::vector<Vector3d> RandomPoints(int count, double size) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vector3d> points(count);
  for (Vector3d& p : points) p = Vector3d::NullaryExpr([&] { return uniform(generator); });
  return points;
}

TEST(FieldSampler, GivesTheFieldBackAtTheVertices) {
  const TetMesh mesh = MakeBallMesh(6);
  const std::vector<Matrix3d> frames = TurnedAt(mesh.points);
  const FieldSamples samples = FieldSampler(mesh, frames).Sample(mesh.points);
  EXPECT_THAT(samples.is_inside, Each(1));
  for (std::size_t v = 0; v < frames.size(); ++v) EXPECT_LT(FrameDifference<4>(samples.frames[v], frames[v]), 1e-12);
}

// Against all tets, one by one, and the mean as it is defined.
TEST(FieldSampler, IsTheNearestFrameToTheBarycentricMean) {
  TetMesh mesh = MakeBallMesh(4);
  for (std::size_t t = 0; t < mesh.tets.size(); t += 2) std::swap(mesh.tets[t][0], mesh.tets[t][1]);  // inverted
  std::mt19937 generator(2);
  std::vector<Matrix3d> frames;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) frames.push_back(RandomFrame(&generator));
  const std::vector<Vector3d> points = RandomPoints(300, 0.7);
  const FieldSamples samples = FieldSampler(mesh, frames).Sample(points);
  int num_inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& tet : mesh.tets) {
      Eigen::Matrix4d corners;
      for (int k = 0; k < 4; ++k) corners.col(k) << mesh.points[tet[k]], 1;
      const Eigen::Vector4d weights = corners.inverse() * points[i].homogeneous();
      if (weights.minCoeff() < 1e-9) continue;
      ++num_inside;
      Hexadecapole mean = Hexadecapole::Zero();
      for (int k = 0; k < 4; ++k) mean += weights[k] * HarmonicFromFrame<4>(frames[tet[k]]);
      EXPECT_EQ(samples.is_inside[i], 1);
      EXPECT_NEAR(mean.dot(HarmonicFromFrame<4>(samples.frames[i])),
                  mean.dot(HarmonicFromFrame<4>(NearestFrame<4>(mean))), 1e-9);
    }
  }
  EXPECT_GT(num_inside, 150);
}

TEST(FieldSampler, FollowsASmoothField) {
  const TetMesh mesh = MakeBallMesh(12);
  const std::vector<Vector3d> points = RandomPoints(2000, 0.5);
  const FieldSamples samples = FieldSampler(mesh, TurnedAt(mesh.points)).Sample(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // A thousandth of a radian; the frames turn by 0.06 from vertex to vertex.
    EXPECT_LT(FrameDifference<4>(samples.frames[i], Turned(points[i])), 20. / 3 * 1e-6);
  }
}

// Outside a box the nearest point is the clamped one.
TEST(FieldSampler, GivesTheNearestBoundaryPointOutside) {
  TetMesh mesh = MakeBoxMesh({5, 5, 5}, {2, 2, 2});
  for (Vector3d& p : mesh.points) p -= Vector3d::Ones();
  const FieldSampler sampler(mesh, TurnedAt(mesh.points));
  std::vector<Vector3d> points = RandomPoints(1000, 3), clamped;
  points.insert(points.end(), {{1e6, 0, 0}, {1, 1, 1.5}, {-1, 5, 1}});
  for (const Vector3d& p : points) clamped.push_back(p.cwiseMax(-1).cwiseMin(1));
  const FieldSamples samples = sampler.Sample(points);
  const FieldSamples expected = sampler.Sample(clamped);
  EXPECT_THAT(expected.is_inside, Each(1)) << "points of the boundary are inside";
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(samples.is_inside[i], points[i] == clamped[i]) << i;
    EXPECT_LT(FrameDifference<4>(samples.frames[i], expected.frames[i]), 1e-10) << i;
  }
}

TEST(FieldSampler, LosesNoPointBetweenTets) {
  const TetMesh mesh = MakeBallMesh(5);
  std::vector<Vector3d> points;
  for (const auto& [a, b] : MeshEdges(mesh)) points.push_back((mesh.points[a] + 2 * mesh.points[b]) / 3);
  for (const auto& [a, b, c] : MeshTriangles(mesh)) {
    points.push_back((mesh.points[a] + mesh.points[b] + 5 * mesh.points[c]) / 7);
  }
  EXPECT_THAT(FieldSampler(mesh, TurnedAt(mesh.points)).Sample(points).is_inside, Each(1));
}

TEST(FieldSampler, TakesPointsInAPlaneOneOrNoneAndFarApart) {
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const FieldSampler sampler(mesh, TurnedAt(mesh.points));
  EXPECT_TRUE(sampler.Sample({}).frames.empty());
  const Vector3d point(0.3, 0.4, 0.5);
  const Matrix3d frame = sampler.Sample({point}).frames[0];
  for (const Vector3d& other : {point, Vector3d(0.1, 0.2, 0.5), Vector3d(1e308, -1e308, 0), Vector3d(5e-324, 0, 0)}) {
    const FieldSamples samples = sampler.Sample({other, point, -other});
    EXPECT_LT(FrameDifference<4>(samples.frames[1], frame), 1e-12);
    for (const Matrix3d& any : samples.frames) EXPECT_NEAR(any.determinant(), 1, 1e-12);
  }
}

TEST(FieldSampler, RefusesWhatIsWrong) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  std::vector<Matrix3d> frames(mesh.points.size(), Matrix3d::Identity());
  const auto error = [](const auto& run) { return MessageOf<std::invalid_argument>(run); };
  EXPECT_EQ(error([] { FieldSampler({}, {}); }), "FieldSampler: the mesh has no tetrahedra");
  EXPECT_EQ(error([&] { FieldSampler(mesh, {}); }), "FieldSampler: 0 frames for 8 points");
  const FieldSampler sampler(mesh, frames);
  EXPECT_THAT(error([&] {
                sampler.Sample({{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}});
              }),
              HasSubstr("FieldSampler: point 1 is not finite: [  0 nan   0]"));
  frames[3] *= 2;
  EXPECT_NE(error([&] { FieldSampler(mesh, frames); }), "");
}

TEST(TransferFrames, IsByVertexOnTheSamePointsAndSampledElse) {
  const TetMesh mesh = MakeBallMesh(6);
  const std::vector<Matrix3d> frames = TurnedAt(mesh.points);
  EXPECT_EQ(TransferFrames(mesh, frames, mesh.points), frames);
  const TetMesh other = MakeBallMesh(5);
  const std::vector<Matrix3d> sampled = TransferFrames(mesh, frames, other.points);
  ASSERT_EQ(sampled.size(), other.points.size());
  for (std::size_t v = 0; v < sampled.size(); ++v) {
    EXPECT_LT(FrameDifference<4>(sampled[v], Turned(other.points[v])), 1e-2);
  }
}

}  // namespace
}  // namespace octupole
