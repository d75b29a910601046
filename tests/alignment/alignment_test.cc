#include "octupole/alignment/alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"
#include "octupole/harmonics/quadrics.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <typename Degree>
class AlignedSubspaceTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AlignedSubspaceTest, Degrees);

TYPED_TEST(AlignedSubspaceTest, HasAnOrthonormalBasisOf7Or2Or1Columns) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const std::vector<std::pair<Alignment, int>> cases = {{Alignment(), kDimension<l>},
                                                          {Alignment::Axis(3 * RandomDirection(&generator)), 2},
                                                          {Alignment::Frame(RandomFrame(&generator)), 1}};
    for (const auto& [alignment, columns] : cases) {
      const AlignedSubspace<l> subspace(alignment);
      ASSERT_EQ(subspace.basis.cols(), columns);
      EXPECT_LT((subspace.basis.transpose() * subspace.basis - Eigen::MatrixXd::Identity(columns, columns)).norm(),
                1e-13);
      EXPECT_LT((subspace.basis.transpose() * subspace.offset).norm(), 1e-13);
    }
  }
}

// Every frame with the axis lies in the subspace, on a circle of the stated radius (theory.md, section 4).
TYPED_TEST(AlignedSubspaceTest, HoldsTheFramesWithTheAxis) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d frame = RandomFrame(&generator);
    for (int k = 0; k < 3; ++k) {
      const AlignedSubspace<l> subspace(Alignment::Axis(-frame.col(k)));
      const Harmonic<l> h = HarmonicFromFrame<l>(frame);
      EXPECT_LT((subspace.Project(h) - h).norm(), 1e-13);
      EXPECT_NEAR((h - subspace.offset).squaredNorm(), l == 3 ? 1 : 5. / 12, 1e-13);
    }
  }
}

TYPED_TEST(AlignedSubspaceTest, HoldsNothingElseOnItsCircle) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(3);
  const Vector3d axis = RandomDirection(&generator);
  const AlignedSubspace<l> subspace(Alignment::Axis(axis));
  const double radius = l == 3 ? 1 : std::sqrt(5. / 12);
  for (int i = 0; i < 50; ++i) {
    const double t = 0.1 * i;
    const Harmonic<l> h =
        subspace.offset + radius * (std::cos(t) * subspace.basis.col(0) + std::sin(t) * subspace.basis.col(1));
    EXPECT_LT(Deviation<l>(h), 1e-25);
    EXPECT_NEAR((NearestFrame<l>(h).transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

TYPED_TEST(AlignedSubspaceTest, WorksForEveryDirection) {
  constexpr int l = TypeParam::value;
  for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0, 1e-9, -1), Vector3d(1e-300, 0, 0),
                               Vector3d(1e300, 1e300, 0), Vector3d(-1, 0, 0)}) {
    const Alignment alignment = Alignment::Axis(axis);
    EXPECT_NEAR(alignment.frame().col(2).dot(axis.stableNormalized()), 1, 1e-15);
    EXPECT_LT((AlignedSubspace<l>(alignment).Project(HarmonicFromFrame<l>(alignment.frame())) -
               HarmonicFromFrame<l>(alignment.frame()))
                  .norm(),
              1e-13);
  }
}

// Two unit normals at an angle phi, equally heavy: the eigenvalues of the averaged projectors are (1 +- s)/2 for two
// numbers s, of the cosine c = cos(phi) (theory.md, section 4):
//   s = c (3 c^2 - 1) / 2, whose eigenvectors belong to the mean normal up to a right angle,
//   s = cos(2 phi), whose eigenvectors are semisymmetric and have the edge's tangent as an axis.
// The smallest eigenvalue changes from the first pair to the second at c = 2/3, phi = 48.19 degrees.
struct TwoNormals {
  explicit TwoNormals(double phi) {
    const Vector3d first(std::sin(phi / 2), 0, std::cos(phi / 2)), second(-std::sin(phi / 2), 0, std::cos(phi / 2));
    for (const Vector3d& normal : {first, second}) {
      const AlignedSubspace<3> subspace(Alignment::Axis(normal));
      conflict -= subspace.basis * subspace.basis.transpose() / 2;
    }
    eigen = internal::DecomposeSymmetric(conflict);
  }
  Octupole lowest() const { return eigen.vectors.col(0); }

  HarmonicMatrix<3> conflict = HarmonicMatrix<3>::Identity();
  internal::SymmetricEigen eigen;
};

TEST(TwoNormals, HaveTheEigenvaluesInClosedForm) {
  for (int degrees = 1; degrees < 180; ++degrees) {
    const double phi = degrees * EIGEN_PI / 180, c = std::cos(phi);
    const double s = c * (3 * c * c - 1) / 2, t = std::cos(2 * phi);
    std::vector<double> expected = {(1 - s) / 2, (1 + s) / 2, (1 - t) / 2, (1 + t) / 2, 1, 1, 1};
    std::sort(expected.begin(), expected.end());
    const TwoNormals normals(phi);
    for (int i = 0; i < 7; ++i) EXPECT_NEAR(normals.eigen.values[i], expected[i], 1e-14) << degrees;
    // The plane of the tangent is invariant, with the second pair.
    const AlignedSubspace<3>::Basis tangent = AlignedSubspace<3>(Alignment::Axis(Vector3d::UnitY())).basis;
    const Eigen::MatrixXd image = normals.conflict * tangent;
    const Eigen::Matrix2d block = tangent.transpose() * image;
    EXPECT_LT((image - tangent * block).norm(), 1e-14);
    EXPECT_NEAR(block.trace(), 1, 1e-14);
    EXPECT_NEAR(block(0, 0) * block(1, 1) - block(0, 1) * block(1, 0), (1 - t * t) / 4, 1e-14);
  }
}

TEST(TwoNormals, FixAFrameFromTheAngleOfCosineTwoThirds) {
  const double crossing = std::acos(2. / 3);
  EXPECT_NEAR(crossing * 180 / EIGEN_PI, 48.1897, 1e-4);
  EXPECT_NEAR(TwoNormals(crossing).eigen.values[0], 4. / 9, 1e-14);
  EXPECT_NEAR(TwoNormals(crossing).eigen.values[1], 4. / 9, 1e-14);
  const AlignedSubspace<3> mean(Alignment::Axis(Vector3d::UnitZ())), tangent(Alignment::Axis(Vector3d::UnitY()));
  for (const double phi : {crossing + 1e-6, 1., 1.3, 1.6, 2., 2.3}) {
    const Octupole lowest = TwoNormals(phi).lowest();
    EXPECT_LT(Deviation<3>(lowest), 1e-20) << phi;
    EXPECT_LT((tangent.Project(lowest) - lowest).norm(), 1e-10) << phi;
  }
  // Before, also between 45 degrees and the crossing, it is mostly of the mean normal and no frame.
  for (const double degrees : {20., 44., 46., 48., 48.18}) {
    const Octupole lowest = TwoNormals(degrees * EIGEN_PI / 180).lowest();
    EXPECT_GT(mean.Project(lowest).squaredNorm(), 0.5) << degrees;
    EXPECT_GT(Deviation<3>(lowest), 1e-3) << degrees;
  }
}

TEST(Alignment, RefusesWhatIsNoDirectionOrFrame) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Alignment::Axis(Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(Alignment::Axis({0, nan, 1}), std::invalid_argument);
  EXPECT_THROW(Alignment::Frame(2 * Matrix3d::Identity()), std::invalid_argument);
  EXPECT_THROW(Alignment::Frame(-Matrix3d::Identity()), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
