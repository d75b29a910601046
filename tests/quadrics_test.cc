#include "octupole/quadrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "octupole/frame.h"
#include "octupole/symmetric_eigen.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;

// d at the basis functions (theory.md, section 2): 25, 0, 21, 16, 21, 0, 25.
TEST(Deviation, HasThePapersValuesAtTheBasis) {
  const double expected[] = {25, 0, 21, 16, 21, 0, 25};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(Deviation<3>(Octupole::Unit(i)), expected[i], 1e-13) << "m = " << i - 3;
}

TEST(Quadrics, AreOrthogonalAndOfSquaredNorm84InDegree3) {
  const auto& quadrics = Quadrics<3>();
  for (int k = 0; k < 5; ++k) {
    for (int l = 0; l < 5; ++l) {
      EXPECT_NEAR((quadrics[k].transpose() * quadrics[l]).trace(), k == l ? 84 : 0, 1e-12);
    }
  }
}

// Paper, eqs. 2.2 to 2.4.
TEST(Quadrics, BeginWithThePapersMatrices) {
  const double r = std::sqrt(15.);
  HarmonicMatrix<3> m1 = HarmonicMatrix<3>::Zero(), m2 = m1, m3 = m1;
  m1.diagonal() << -5, 0, 3, 4, 3, 0, -5;
  m2(0, 1) = m2(5, 6) = 5;
  m2(1, 2) = m2(4, 5) = r;
  m2(3, 4) = 2;
  m3(0, 5) = 5;
  m3(1, 6) = -5;
  m3(1, 4) = r;
  m3(2, 5) = -r;
  m3(2, 3) = 2;
  const auto symmetric = [](const HarmonicMatrix<3>& m) { return HarmonicMatrix<3>(m + m.transpose()); };
  const auto& quadrics = Quadrics<3>();
  EXPECT_LT((quadrics[0] - m1).norm(), 1e-13);
  const auto up_to_sign = [](const HarmonicMatrix<3>& a, const HarmonicMatrix<3>& b) {
    return std::min((a - b).norm(), (a + b).norm());
  };
  EXPECT_LT(up_to_sign(std::sqrt(2.) * quadrics[2], symmetric(m2)), 1e-13);
  EXPECT_LT(up_to_sign(std::sqrt(2.) * quadrics[1], symmetric(m3)), 1e-13);
}

template <int kDegree>
void ExpectInvariantAndZeroOnFrames() {
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d rotation = RandomFrame(&generator);
    const Harmonic<kDegree> h = RandomHarmonic<kDegree>(&generator);
    const double d = Deviation<kDegree>(h);
    EXPECT_NEAR(Deviation<kDegree>(HarmonicRotation<kDegree>(rotation) * h), d, 1e-12 * d);
    EXPECT_LT(Deviation<kDegree>(HarmonicFromFrame<kDegree>(rotation)), 1e-25);
    EXPECT_GT(d, 1e-3) << "a random harmonic is not octahedral";
  }
}

TEST(Deviation, IsInvariantAndZeroOnFramesInDegree3) { ExpectInvariantAndZeroOnFrames<3>(); }
TEST(Deviation, IsInvariantAndZeroOnFramesInDegree4) { ExpectInvariantAndZeroOnFrames<4>(); }

// The eigenvalues of the Hessian of d at the reference, by central differences of d itself.
template <int kDegree>
Eigen::VectorXd CurvaturesAtReference() {
  const double h = 1e-3;
  const auto at = [&](int i, double s, int j, double t) {
    return Deviation<kDegree>(ReferenceHarmonic<kDegree>() + s * Harmonic<kDegree>::Unit(i) +
                              t * Harmonic<kDegree>::Unit(j));
  };
  HarmonicMatrix<kDegree> hessian;
  for (int i = 0; i < kDimension<kDegree>; ++i) {
    for (int j = 0; j < kDimension<kDegree>; ++j) {
      hessian(i, j) = (at(i, h, j, h) - at(i, h, j, -h) - at(i, -h, j, h) + at(i, -h, j, -h)) / (4 * h * h);
    }
  }
  return internal::DecomposeSymmetric(hessian).values;
}

TEST(Deviation, HasCurvature160AcrossTheManifoldInDegree3) {
  const Eigen::VectorXd curvatures = CurvaturesAtReference<3>();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(curvatures[i], 0, 0.01);
  for (int i = 4; i < 7; ++i) EXPECT_NEAR(curvatures[i], 160, 0.01);
}

// Two of the five stiff directions are four times as stiff as the other three, unlike in degree 3.
TEST(Deviation, HasTwoCurvaturesAcrossTheManifoldInDegree4) {
  const Eigen::VectorXd curvatures = CurvaturesAtReference<4>();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(curvatures[i], 0, 0.01);
  for (int i = 4; i < 7; ++i) EXPECT_NEAR(curvatures[i], 1120. / 9, 0.01);
  for (int i = 7; i < 9; ++i) EXPECT_NEAR(curvatures[i], 4480. / 9, 0.01);
}

}  // namespace
}  // namespace octupole
