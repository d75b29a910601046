#include "octupole/field/mid_edge_frames.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/frames/random_rotation.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TetMesh OneTetWithNode() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.mid_edge_nodes = {{4, 0, 1}};
  return mesh;
}

// Between frames that one turn about an axis of symmetry takes into each other lies half of the turn; whatever the
// names of their axes.
TEST(SetMidEdgeFrames, TakesTheFrameHalfWay) {
  const TetMesh mesh = OneTetWithNode();
  std::mt19937 generator(3);
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(1, 1, 0), Vector3d(0, -1, 1)}) {
    for (const double angle : {0.1, 0.6}) {
      const Matrix3d frame = RandomRotation(&generator).toRotationMatrix();
      const auto turned = [&](double by) -> Matrix3d {
        return frame * Eigen::AngleAxisd(by, axis.normalized()).toRotationMatrix();
      };
      Matrix3d renamed;
      renamed << 0, 0, 1, 1, 0, 0, 0, 1, 0;
      std::vector<Matrix3d> frames(5, Matrix3d::Identity());
      frames[0] = frame;
      frames[1] = turned(angle) * renamed;
      SetMidEdgeFrames(mesh, &frames);
      EXPECT_LT(FrameDifference<4>(frames[4], turned(angle / 2)), 1e-12) << axis.transpose() << ", " << angle;
      EXPECT_EQ(frames[0], frame);
      EXPECT_EQ(frames[2], Matrix3d::Identity());
    }
  }
}

TEST(SetMidEdgeFrames, RefusesAnotherNumberOfFrames) {
  std::vector<Matrix3d> frames(4, Matrix3d::Identity());
  EXPECT_THROW(SetMidEdgeFrames(OneTetWithNode(), &frames), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
