#include "octupole/field/tet_frames.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/box_mesh.h"
#include "random_inputs.h"
#include "turn.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d FrameOfTet(const std::vector<Matrix3d>& corners) {
  const TetMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  return TetFrames(mesh, corners).at(0);
}

TEST(TetFrames, KeepsAConstantField) {
  std::mt19937 generator(1);
  const TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const Matrix3d frame = RandomFrame(&generator);
  for (const Matrix3d& mean : TetFrames(mesh, std::vector<Matrix3d>(mesh.points.size(), frame))) {
    EXPECT_LT(FrameDifference<4>(mean, frame), 1e-14);
  }
}

// Pairs turned by opposite angles about two axes of a frame: half turns about these axes swap them, so the mean is the
// frame.
TEST(TetFrames, IsTheMiddleOfItsCorners) {
  std::mt19937 generator(2);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const Vector3d u = Vector3d::Unit(i % 3), v = Vector3d::Unit((i + 1) % 3);
    EXPECT_LT(FrameDifference<4>(FrameOfTet({frame * Turn(0.3, u), frame * Turn(-0.3, u), frame * Turn(0.1, v),
                                             frame * Turn(-0.1, v)}),
                                 frame),
              1e-12);
  }
}

TEST(TetFrames, DoesNotDependOnTheOrderAndSignOfTheAxes) {
  std::mt19937 generator(3);
  std::uniform_int_distribution<int> element(0, 23);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    std::vector<Matrix3d> corners, reordered;
    for (int k = 0; k < 4; ++k) {
      corners.push_back(frame * Turn(0.2, RandomFrame(&generator).col(0)));
      reordered.push_back(corners.back() * OctahedralGroup()[element(generator)].matrix());
    }
    EXPECT_LT(FrameDifference<4>(FrameOfTet(corners), FrameOfTet(reordered)), 1e-12);
    // All corners are within 0.2 of the frame, so the mean is nearer to it than to any copy of one corner.
    EXPECT_LT(FrameDifference<4>(FrameOfTet(corners), frame), 20. / 3 * 0.2 * 0.2);
  }
}

TEST(TetFrames, MakesAFrameOfAnyCorners) {
  std::mt19937 generator(4);
  for (int i = 0; i < 200; ++i) {
    const Matrix3d mean = FrameOfTet(
        {RandomFrame(&generator), RandomFrame(&generator), RandomFrame(&generator), RandomFrame(&generator)});
    EXPECT_LT((mean.transpose() * mean - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(mean.determinant(), 0);
  }
}

TEST(TetFrames, WantsOneRotationPerPoint) {
  EXPECT_THROW(FrameOfTet(std::vector<Matrix3d>(3, Matrix3d::Identity())), std::invalid_argument);
  EXPECT_THROW(FrameOfTet(std::vector<Matrix3d>(4, Matrix3d::Zero())), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
