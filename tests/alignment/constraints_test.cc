#include "octupole/alignment/constraints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "random_inputs.h"
#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

// A direction in the xz plane, so many degrees from z.
Vector3d Tilted(double degrees) {
  const double angle = degrees * EIGEN_PI / 180;
  return {std::sin(angle), 0, std::cos(angle)};
}

Alignment Apply(const Alignment& boundary, const Alignment& constraint, ConstraintSummary* summary = nullptr) {
  std::vector<Alignment> alignments = {Alignment(), boundary};
  const ConstraintSummary result = ApplyConstraints({{1, constraint}}, &alignments);
  EXPECT_EQ(alignments[0].kind(), AlignmentKind::kFree);
  if (summary != nullptr) *summary = result;
  return alignments[1];
}

double LargestCosine(const Matrix3d& frame, const Vector3d& axis) {
  return (frame.transpose() * axis.normalized()).cwiseAbs().maxCoeff();
}

TEST(ContradictionDeg, IsTheAngleThatCannotBeMet) {
  const Alignment z = Alignment::Axis({0, 0, -2});
  const Alignment axes = Alignment::Frame(Matrix3d::Identity());
  for (const auto& [tilt, expected] : {std::pair(0., 0.), {20., 20.}, {45., 45.}, {70., 20.}, {90., 0.}}) {
    EXPECT_NEAR(ContradictionDeg(z, Alignment::Axis(Tilted(tilt))), expected, 1e-6);
    EXPECT_NEAR(ContradictionDeg(axes, Alignment::Axis(Tilted(tilt))), expected, 1e-6);
    EXPECT_NEAR(ContradictionDeg(Alignment::Axis(Tilted(tilt)), axes), expected, 1e-6);
    const Matrix3d turned = Eigen::AngleAxisd(tilt * EIGEN_PI / 180, Vector3d::UnitX()).toRotationMatrix();
    EXPECT_NEAR(ContradictionDeg(axes, Alignment::Frame(turned)), expected, 1e-6);
  }
  EXPECT_NEAR(ContradictionDeg(axes, Alignment::Axis({1, 1, 1})), 54.7356, 1e-4);
  EXPECT_EQ(ContradictionDeg(Alignment(), axes), 0);
}

// Whatever the boundary asks, the constraint holds to rounding.
TEST(ApplyConstraints, HoldExactly) {
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Vector3d axis = RandomDirection(&generator);
    const Matrix3d frame = RandomFrame(&generator);
    for (const Alignment& boundary :
         {Alignment(), Alignment::Axis(RandomDirection(&generator)), Alignment::Frame(RandomFrame(&generator))}) {
      EXPECT_NEAR(LargestCosine(Apply(boundary, Alignment::Axis(axis)).frame(), axis), 1, 1e-14);
      EXPECT_NEAR(FrameDifference<4>(Apply(boundary, Alignment::Frame(frame)).frame(), frame), 0, 1e-13);
    }
  }
}

TEST(ApplyConstraints, LeaveTheRestToTheBoundary) {
  const Alignment normal = Alignment::Axis(Vector3d::UnitZ());
  // A tangent: a frame of both.
  ConstraintSummary summary;
  Alignment result = Apply(normal, Alignment::Axis({1, 1, 0}), &summary);
  ASSERT_EQ(result.kind(), AlignmentKind::kFrame);
  EXPECT_NEAR(LargestCosine(result.frame(), Vector3d::UnitZ()), 1, 1e-14);
  EXPECT_EQ(summary.num_axes, 1u);
  EXPECT_EQ(summary.num_contradictions, 0u);
  // Nearly a tangent: the axis holds, the normal as far as it can.
  result = Apply(normal, Alignment::Axis(Tilted(80)), &summary);
  ASSERT_EQ(result.kind(), AlignmentKind::kFrame);
  EXPECT_NEAR(LargestCosine(result.frame(), Vector3d::UnitZ()), std::cos(10 * EIGEN_PI / 180), 1e-14);
  EXPECT_EQ(summary.num_contradictions, 1u);
  EXPECT_NEAR(summary.largest_contradiction_deg, 10, 1e-9);
  // Nearer to the normal: it replaces it.
  result = Apply(normal, Alignment::Axis(Tilted(30)), &summary);
  EXPECT_EQ(result.kind(), AlignmentKind::kAxis);
  EXPECT_NEAR(summary.largest_contradiction_deg, 30, 1e-9);
  // A frame of the boundary turns no more than it must.
  result = Apply(Alignment::Frame(Matrix3d::Identity()), Alignment::Axis(Tilted(10)), &summary);
  ASSERT_EQ(result.kind(), AlignmentKind::kFrame);
  EXPECT_NEAR(LargestCosine(result.frame(), Vector3d::UnitY()), 1, 1e-12);
  // Nothing is contradicted where nothing was asked.
  Apply(Alignment(), Alignment::Frame(Matrix3d::Identity()), &summary);
  EXPECT_EQ(summary.num_frames, 1u);
  EXPECT_EQ(summary.largest_contradiction_deg, 0);
}

TEST(ApplyConstraints, RefuseWhatIsWrong) {
  const auto error = [](const std::vector<Constraint>& constraints) {
    std::vector<Alignment> alignments(3);
    return MessageOf<std::invalid_argument>([&] { ApplyConstraints(constraints, &alignments); });
  };
  const Alignment x = Alignment::Axis(Vector3d::UnitX());
  EXPECT_EQ(error({{0, x}, {3, x}}), "ApplyConstraints: constraint 1 of vertex 3, out of range 0..2");
  EXPECT_THAT(error({{-1, x}}), HasSubstr("vertex -1, out of range"));
  EXPECT_EQ(error({{2, Alignment()}}), "ApplyConstraints: constraint 0 of vertex 2 prescribes nothing");
  EXPECT_EQ(
      error({{2, x}, {2, Alignment::Axis(Vector3d::UnitY())}}),
      "ApplyConstraints: constraint 1 of vertex 2 asks for the axis [0 1 0], an earlier one for the axis [1 0 0]");
  EXPECT_THAT(error({{2, x}, {2, Alignment::Frame(Matrix3d::Identity())}}), HasSubstr("an earlier one"));
  EXPECT_EQ(error({{2, x}, {2, Alignment::Axis({-3, 0, 0})}}), "") << "the same axis";
}

TEST(TwoAxes, SplitWhatLacksToARightAngle) {
  const Matrix3d frame = Alignment::TwoAxes({0, 0, 5}, {3, 0, 0.03}).frame();
  EXPECT_TRUE((frame.transpose() * frame).isIdentity(1e-14));
  EXPECT_NEAR(frame.col(0).dot(Vector3d::UnitZ()), frame.col(1).dot(Vector3d(3, 0, 0.03).normalized()), 1e-14);
  EXPECT_THAT(MessageOf<std::invalid_argument>([] {
                Alignment::TwoAxes({1, 0, 0}, {1, 1, 0});
              }),
              HasSubstr("[1 0 0] and [1 1 0] are at 45 degrees"));
  EXPECT_THROW(Alignment::TwoAxes({1, 0, 0}, {0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(Alignment::TwoAxes({std::numeric_limits<double>::quiet_NaN(), 0, 0}, {0, 0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
