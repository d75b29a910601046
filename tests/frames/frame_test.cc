#include "octupole/frames/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "octupole/frames/internal/nearest_rotation.h"
#include "octupole/frames/octahedral_group.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::StartsWith;
using testing::ThrowsMessage;

template <typename Degree>
class FrameTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(FrameTest, Degrees);

double AngleBetween(const Matrix3d& a, const Matrix3d& b) {
  return Eigen::AngleAxisd((a * MatchFrames(a, b).matrix()).transpose() * b).angle();
}

TYPED_TEST(FrameTest, HarmonicIsThatOfTheAxes) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const Vector3d at = RandomDirection(&generator);
    // The reference in the coordinates of the frame.
    const double expected = ReferenceHarmonic<l>().dot(EvaluateBasis<l>(frame.transpose() * at));
    EXPECT_NEAR(HarmonicFromFrame<l>(frame).dot(EvaluateBasis<l>(at)), expected, 1e-13);
  }
}

TYPED_TEST(FrameTest, HarmonicForgetsOrderAndSignsOfAxes) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  const Matrix3d frame = RandomFrame(&generator);
  const Harmonic<l> h = HarmonicFromFrame<l>(frame);
  int num_same = 0;
  for (const auto& g : OctahedralGroup()) {
    const Harmonic<l> other = HarmonicFromFrame<l>(frame * g.matrix());
    EXPECT_NEAR(std::abs(h.dot(other)), 1, 1e-13);
    num_same += h.dot(other) > 0;
  }
  EXPECT_EQ(num_same, l == 3 ? 12 : 24);
}

TYPED_TEST(FrameTest, NearestFrameInvertsHarmonicFromFrame) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const double scale = std::pow(10, i % 20 - 10);
    const Matrix3d nearest = NearestFrame<l>(scale * HarmonicFromFrame<l>(frame));
    EXPECT_LT(AngleBetween(frame, nearest), 1e-12);
    EXPECT_LT((nearest.transpose() * nearest - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(nearest.determinant(), 1, 1e-14);
  }
}

TYPED_TEST(FrameTest, NearestFrameTurnsWithItsHarmonic) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(4);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d rotation = RandomFrame(&generator);
    // Near enough to the manifold for the nearest frame to be unique.
    const Harmonic<l> h = HarmonicFromFrame<l>(RandomFrame(&generator)) + 0.1 * RandomHarmonic<l>(&generator);
    EXPECT_LT(AngleBetween(rotation * NearestFrame<l>(h), NearestFrame<l>(HarmonicRotation<l>(rotation) * h)), 1e-7);
  }
}

// A brute force that shares nothing with NearestFrame: a dense random set of frames, and a search by ever smaller turns
// about the axes from the best two of them that are not neighbours.
template <int kDegree>
class BruteForce {
 public:
  BruteForce() : samples_(kDimension<kDegree>, 20000) {
    std::mt19937 generator(5);
    for (Eigen::Index i = 0; i < samples_.cols(); ++i) {
      frames_.push_back(RandomFrame(&generator));
      samples_.col(i) = HarmonicFromFrame<kDegree>(frames_.back());
    }
  }

  double Maximum(const Harmonic<kDegree>& h) const {
    Eigen::RowVectorXd values = h.transpose() * samples_;
    Eigen::Index best = 0;
    values.maxCoeff(&best);
    const double first = Polish(h, frames_[best]);
    const Eigen::RowVectorXd cosines = samples_.col(best).transpose() * samples_;
    values = (cosines.array() > 0.8).select(-10., values);
    values.maxCoeff(&best);
    return std::max(first, Polish(h, frames_[best]));
  }

 private:
  static double Polish(const Harmonic<kDegree>& h, Matrix3d frame) {
    double value = h.dot(HarmonicFromFrame<kDegree>(frame));
    double step = 0.05;
    while (step > 1e-6) {
      bool improved = false;
      for (int k = 0; k < 6; ++k) {
        const double angle = k < 3 ? step : -step;
        const Matrix3d turned = frame * Eigen::AngleAxisd(angle, Vector3d::Unit(k % 3)).toRotationMatrix();
        const double other = h.dot(HarmonicFromFrame<kDegree>(turned));
        if (other <= value) continue;
        value = other;
        frame = turned;
        improved = true;
      }
      if (!improved) step /= 2;
    }
    return value;
  }

  std::vector<Matrix3d> frames_;
  Eigen::Matrix<double, kDimension<kDegree>, Eigen::Dynamic> samples_;
};

TYPED_TEST(FrameTest, NearestFrameIsGlobalFromAnyGuess) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(6);
  const BruteForce<l> brute_force;
  for (int i = 0; i < 2000; ++i) {
    const Harmonic<l> h = RandomHarmonic<l>(&generator).normalized();
    const double expected = brute_force.Maximum(h);
    const Matrix3d nearest = NearestFrame<l>(h);
    EXPECT_NEAR(h.dot(HarmonicFromFrame<l>(nearest)), expected, 1e-9) << h.transpose();
    for (const Matrix3d& guess : {RandomFrame(&generator), nearest}) {
      EXPECT_NEAR(h.dot(HarmonicFromFrame<l>(NearestFrame<l>(h, guess))), expected, 1e-9) << h.transpose();
    }
  }
}

// Within the manifold's reach of h one climb is proof enough; beyond, the first maximum may not be the global one.
TYPED_TEST(FrameTest, NearestFrameClimbsOnceWhereThatIsProofEnough) {
  constexpr int l = TypeParam::value;
  const double reach = l == 3 ? 2. / 3 : std::sqrt(5. / 12);
  std::mt19937 generator(11);
  int num_beyond = 0, num_that_climb_again = 0;
  for (int i = 0; i < 1000; ++i) {
    const Harmonic<l> h = RandomHarmonic<l>(&generator).normalized();
    const internal::NearestRotation nearest = internal::FindNearestRotation<l>(h);
    const double cosine = h.dot(HarmonicFromFrame<l>(nearest.rotation.toRotationMatrix()));
    if (1 - cosine * cosine < reach * reach) {
      EXPECT_EQ(nearest.num_climbs, 1) << h.transpose();
    } else {
      ++num_beyond;
      num_that_climb_again += nearest.num_climbs > 1;
    }
  }
  EXPECT_GT(num_beyond, 20);
  EXPECT_GT(num_that_climb_again, num_beyond / 2);
}

// What NearestFrame takes for granted: below this distance a stationary frame is the nearest of all. The manifold is
// one orbit, so that its reach (Federer 1959, theorem 4.18) is the least of |y - x|^2 / (2 |part of y - x normal to it
// at x|) over its points y, for any one point x.
TYPED_TEST(FrameTest, ReachIsTwoThirdsInDegree3AndTheRootOf5Over12InDegree4) {
  constexpr int l = TypeParam::value;
  const Harmonic<l> x = ReferenceHarmonic<l>();
  Eigen::Matrix<double, kDimension<l>, 3> tangents;
  for (int k = 0; k < 3; ++k) tangents.col(k) = (RotationGenerators<l>()[k] * x).normalized();
  const auto quotient = [&](const Matrix3d& frame) {
    const Harmonic<l> difference = HarmonicFromFrame<l>(frame) - x;
    const double normal = (difference - tangents * (tangents.transpose() * difference)).norm();
    return difference.squaredNorm() / (2 * normal + 1e-300);
  };
  std::mt19937 generator(7);
  double least = 2;
  for (int i = 0; i < 200000; ++i) least = std::min(least, quotient(RandomFrame(&generator)));
  const double reach = l == 3 ? 2. / 3 : std::sqrt(5. / 12);
  EXPECT_GE(least, reach - 1e-12);
  // Attained on circles: by turns about a diagonal of the cube, in degree 4 about one of its axes.
  const Vector3d axis = l == 3 ? Vector3d(1, 1, 1).normalized() : Vector3d(1, 0, 0);
  EXPECT_NEAR(quotient(Eigen::AngleAxisd(0.5, axis).toRotationMatrix()), reach, 1e-12);
}

TYPED_TEST(FrameTest, DistanceToFramesIsThatOfAKnownNearestPoint) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(8);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    const Harmonic<l> h = HarmonicFromFrame<l>(frame);
    Eigen::Matrix<double, kDimension<l>, 3> tangents;
    for (int k = 0; k < 3; ++k) tangents.col(k) = (RotationGenerators<l>()[k] * h).normalized();
    // Normal to the manifold and within its reach: h stays the nearest point.
    Harmonic<l> normal = RandomHarmonic<l>(&generator);
    normal -= tangents * (tangents.transpose() * normal);
    const double distance = 0.6 * (i + 1) / 300;
    const Harmonic<l> moved = h + distance * normal.normalized();
    EXPECT_NEAR(DistanceToFrames<l>(moved), distance, 1e-12);
    EXPECT_LT(AngleBetween(NearestFrame<l>(moved), frame), 1e-11);
  }
  EXPECT_THROW(DistanceToFrames<l>(Harmonic<l>::Zero()), std::invalid_argument);
}

// Half way between two frames' harmonics both are equally near, when no third is nearer. One of them is returned, and
// the same every time.
TYPED_TEST(FrameTest, NearestFrameOfATieIsOneOfTheTied) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(9);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d a = RandomFrame(&generator);
    const Matrix3d b = a * Eigen::AngleAxisd(EIGEN_PI / 4, Vector3d::UnitZ()).toRotationMatrix();
    // In degree 3 an eighth turn is a right angle between the octupoles, in degree 4 it is the opposite point of a
    // circle.
    const Harmonic<l> h = HarmonicFromFrame<l>(a) + HarmonicFromFrame<l>(b);
    const Matrix3d nearest = NearestFrame<l>(h);
    const double found = h.dot(HarmonicFromFrame<l>(nearest));
    EXPECT_GE(found, h.dot(HarmonicFromFrame<l>(a)) - 1e-12);
    EXPECT_EQ(nearest, NearestFrame<l>(h));
  }
}

// A circle of frames is equally near to a harmonic that turns about z leave alone, and they all are to the eye of
// Newton's method: it must not lose its way along the circle.
TYPED_TEST(FrameTest, NearestFrameOfAnInvariantHarmonicIsAMaximum) {
  constexpr int l = TypeParam::value;
  const BruteForce<l> brute_force;
  std::mt19937 generator(10);
  for (int m = 0; m <= l; ++m) {
    for (const double sign : {-1., 1.}) {
      const Harmonic<l> h = HarmonicRotation<l>(RandomFrame(&generator)) * (sign * Harmonic<l>::Unit(l + m));
      const Matrix3d nearest = NearestFrame<l>(h);
      EXPECT_NEAR(h.dot(HarmonicFromFrame<l>(nearest)), brute_force.Maximum(h), 1e-9) << m;
      EXPECT_LT((nearest.transpose() * nearest - Matrix3d::Identity()).norm(), 1e-14);
    }
  }
}

TYPED_TEST(FrameTest, NearestFrameRefusesZeroAndNonFinite) {
  constexpr int l = TypeParam::value;
  EXPECT_THROW(NearestFrame<l>(Harmonic<l>::Zero()), std::invalid_argument);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Harmonic<l> h = Harmonic<l>::Ones();
    h[2] = bad;
    EXPECT_THROW(NearestFrame<l>(h), std::invalid_argument);
  }
}

TYPED_TEST(FrameTest, ErrorsNameTheFunctionAndTheValue) {
  constexpr int l = TypeParam::value;
  const Harmonic<l> zero = Harmonic<l>::Zero();
  const Matrix3d reflection = Vector3d(1, 1, -1).asDiagonal();
  EXPECT_THAT([&] { NearestFrame<l>(zero); },
              ThrowsMessage<std::invalid_argument>(StartsWith("NearestFrame: no frame is nearest to [0 0 0")));
  EXPECT_THAT([&] { DistanceToFrames<l>(zero); },
              ThrowsMessage<std::invalid_argument>(StartsWith("DistanceToFrames: no frame is nearest to [0 0 0")));
  EXPECT_THAT([&] { HarmonicFromFrame<l>(reflection); },
              ThrowsMessage<std::invalid_argument>(StartsWith("HarmonicFromFrame: not a rotation: [1, 0, 0")));
}

// theory.md, section 3: closed forms in Q = A^T B.
TEST(FrameDifference, EqualsItsHarmonicsTerms) {
  std::mt19937 generator(6);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d frame_a = RandomFrame(&generator), frame_b = RandomFrame(&generator);
    const Octupole a = HarmonicFromFrame<3>(frame_a), b = HarmonicFromFrame<3>(frame_b);
    EXPECT_NEAR(a.dot(b), Permanent(frame_a.transpose() * frame_b), 1e-13);
    EXPECT_NEAR(FrameDifference<3>(frame_a, frame_b), (a - b).squaredNorm() * (a + b).squaredNorm(), 1e-13);
    const Hexadecapole g = HarmonicFromFrame<4>(frame_a), h = HarmonicFromFrame<4>(frame_b);
    EXPECT_NEAR(g.dot(h), (SumOfFourthPowers(frame_a.transpose() * frame_b) - 9. / 5) / (6. / 5), 1e-13);
    EXPECT_NEAR(FrameDifference<4>(frame_a, frame_b), (g - h).squaredNorm(), 1e-13);
  }
}

TEST(FrameDifference, IsIsotropicForSmallAnglesInTheRatio2Point4) {
  std::mt19937 generator(7);
  const double angle = 1e-3;
  for (int i = 0; i < 20; ++i) {
    const Matrix3d a = RandomFrame(&generator);
    const Matrix3d b = a * Eigen::AngleAxisd(angle, RandomDirection(&generator)).toRotationMatrix();
    EXPECT_NEAR(FrameDifference<3>(a, b) / (angle * angle), 16, 1e-3);
    EXPECT_NEAR(FrameDifference<4>(a, b) / (angle * angle), 20. / 3, 1e-3);
  }
}

// Turned about an axis of the frame, and about the diagonal of two axes (docs/surfaces.md).
TEST(FrameDifference, DependsOnTheAxisToFourthOrder) {
  const double angle = 0.02;
  const auto turned_about = [&](const Vector3d& axis) {
    return Matrix3d(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix());
  };
  const auto fourth_order = [&](double difference, double second_order) {
    return (difference / (second_order * angle * angle) - 1) / (angle * angle);
  };
  const Matrix3d frame = Matrix3d::Identity(), along = turned_about({1, 0, 0}), diagonal = turned_about({1, 1, 0});
  EXPECT_NEAR(fourth_order(FrameDifference<3>(frame, along), 16), -4. / 3, 1e-2);
  EXPECT_NEAR(fourth_order(FrameDifference<3>(frame, diagonal), 16), -1.65, 1e-2);
  EXPECT_NEAR(fourth_order(FrameDifference<4>(frame, along), 20. / 3), -4. / 3, 1e-2);
  EXPECT_NEAR(fourth_order(FrameDifference<4>(frame, diagonal), 20. / 3), -0.90, 1e-2);
}

}  // namespace
}  // namespace octupole
