#include "octupole/harmonics/quadrics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"
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
TEST(PaperQuadrics, AreThePrintedMatrices) {
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
  const auto [q1, q2, q3] = PaperQuadrics();
  EXPECT_LT((q1 - m1).norm(), 1e-13);
  EXPECT_LT((q2 - symmetric(m2)).norm(), 1e-13);
  EXPECT_LT((q3 - symmetric(m3)).norm(), 1e-13);
}

// The values of some quadrics at h, and |h|^2 - 1.
template <int kDegree, std::size_t kSize>
Eigen::VectorXd Residuals(const std::array<HarmonicMatrix<kDegree>, kSize>& quadrics, const Harmonic<kDegree>& h) {
  Eigen::VectorXd residuals(kSize + 1);
  for (std::size_t k = 0; k < kSize; ++k) residuals[k] = h.dot(quadrics[k] * h);
  residuals[kSize] = h.squaredNorm() - 1;
  return residuals;
}

// Newton's method from a start to a common zero of the quadrics on the unit sphere. False when it does not arrive.
template <int kDegree, std::size_t kSize>
bool FindZero(const std::array<HarmonicMatrix<kDegree>, kSize>& quadrics, Harmonic<kDegree>* h) {
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Eigen::VectorXd residuals = Residuals<kDegree>(quadrics, *h);
    if (residuals.norm() < 1e-13) return true;
    Eigen::MatrixXd jacobian(kSize + 1, kDimension<kDegree>);
    for (std::size_t k = 0; k < kSize; ++k) jacobian.row(k) = 2 * quadrics[k] * *h;
    jacobian.row(kSize) = 2 * *h;
    // The shortest step. On the manifold the jacobian has less than full rank: the rest is rounding.
    const internal::SymmetricEigen eigen = internal::DecomposeSymmetric(jacobian * jacobian.transpose());
    Eigen::VectorXd along = eigen.vectors.transpose() * residuals;
    for (Eigen::Index i = 0; i < along.size(); ++i) {
      along[i] = eigen.values[i] > 1e-13 * eigen.values.maxCoeff() ? along[i] / eigen.values[i] : 0;
    }
    *h -= jacobian.transpose() * (eigen.vectors * along);
  }
  return false;
}

// Lemma 1 as printed is not sufficient (theory.md, errata 1).
TEST(PaperQuadrics, HaveZerosThatAreNotSemisymmetric) {
  Octupole a = Octupole::Zero();
  a[4] = std::sqrt(5. / 8);
  a[6] = -std::sqrt(3. / 8);
  EXPECT_LT(Residuals<3>(PaperQuadrics(), a).norm(), 1e-14);
  EXPECT_NEAR(Deviation<3>(a), 75. / 4, 1e-13);
  // With the other sign it is semisymmetric.
  a[6] = -a[6];
  EXPECT_LT(Deviation<3>(a), 1e-25);
}

TEST(PaperQuadrics, HaveSuchZerosAtTheEndOfMostSearches) {
  std::mt19937 generator(4);
  int num_found = 0, num_not_semisymmetric = 0;
  for (int i = 0; i < 500; ++i) {
    Octupole a = RandomHarmonic<3>(&generator).normalized();
    if (!FindZero<3>(PaperQuadrics(), &a)) continue;
    ++num_found;
    num_not_semisymmetric += Deviation<3>(a) > 1e-3;
  }
  EXPECT_GT(num_found, 400);
  EXPECT_GT(num_not_semisymmetric, num_found / 4);
}

// All five are (theory.md, section 2, proves it); every zero that the search finds belongs to a frame.
template <int kDegree>
void ExpectOnlyOctahedralZeros() {
  std::mt19937 generator(5);
  int num_found = 0;
  for (int i = 0; i < 500; ++i) {
    Harmonic<kDegree> h = RandomHarmonic<kDegree>(&generator).normalized();
    if (!FindZero<kDegree>(Quadrics<kDegree>(), &h)) continue;
    ++num_found;
    // The quadrics do not fix the sign, which in degree 4 matters.
    EXPECT_LT(std::min(DistanceToFrames<kDegree>(h), DistanceToFrames<kDegree>(-h)), 1e-7) << h.transpose();
  }
  EXPECT_GT(num_found, 400);
}

TEST(Quadrics, HaveOnlyOctahedralZerosInDegree3) { ExpectOnlyOctahedralZeros<3>(); }
TEST(Quadrics, HaveOnlyOctahedralZerosInDegree4) { ExpectOnlyOctahedralZeros<4>(); }

// The identities behind the proof that the five quadrics suffice (docs/theory.md, section 2): with z at a stationary
// point of the function, so that the orders +-1 vanish, d is a sum of three squares.
TEST(Deviation, IsThreeSquaresWhereTheFunctionIsStationaryAtZ) {
  using Complex = std::complex<double>;
  std::mt19937 generator(8);
  for (int i = 0; i < 100; ++i) {
    Octupole a = RandomHarmonic<3>(&generator);
    a[2] = a[4] = 0;
    const double a0 = a[3], a2 = a[1] * a[1] + a[5] * a[5], a3 = a[0] * a[0] + a[6] * a[6];
    EXPECT_NEAR(Deviation<3>(a), std::pow(4 * a0 * a0 - 5 * a3, 2) + 50 * a2 * a3 + 80 * a0 * a0 * a2,
                1e-13 * std::pow(a.norm(), 4) * 25);

    Hexadecapole h = RandomHarmonic<4>(&generator);
    h[3] = h[5] = 0;
    const double h0 = h[4];
    const Complex h2(h[6], h[2]), h3(h[7], h[1]), h4(h[8], h[0]);
    const double first = (20 * h0 * h0 + 8 * std::norm(h2) - 7 * std::norm(h3) - 28 * std::norm(h4)) / 3;
    const Complex second = std::sqrt(350.) * std::conj(h2) * h3 + std::sqrt(392.) * std::conj(h3) * h4;
    const Complex third = std::sqrt(720.) * h0 * std::conj(h2) + std::sqrt(112.) * std::conj(h4) * h2;
    EXPECT_NEAR(Deviation<4>(h), first * first + (std::norm(second) + std::norm(third)) / 3,
                1e-13 * std::pow(h.norm(), 4) * 100);
  }
}

// Paper, eq. 3.1, as printed.
double PrintedDeviation(const Octupole& a) {
  const double r = std::sqrt(15.);
  const double p = a[0], q = a[1], s = a[2], t = a[3], u = a[4], v = a[5], w = a[6];
  const double p2 = p * p, q2 = q * q, s2 = s * s, t2 = t * t, u2 = u * u, v2 = v * v, w2 = w * w;
  return 25 * p2 * p2 + 50 * p2 * q2 + 20 * r * p * q2 * s - 10 * p2 * s2 + 30 * q2 * s2 + 8 * r * p * s * s2 +
         21 * s2 * s2 - 40 * p2 * t2 + 80 * q2 * t2 + 32 * s2 * t2 + 16 * t2 * t2 + 120 * p * q * t * u -
         16 * r * q * s * t * u - 10 * p2 * u2 + 30 * q2 * u2 - 24 * r * p * s * u2 + 42 * s2 * u2 + 32 * t2 * u2 +
         21 * u2 * u2 + 120 * p * s * t * v + 8 * r * s2 * t * v + 40 * r * p * q * u * v - 8 * r * t * u2 * v +
         50 * p2 * v2 - 20 * r * p * s * v2 + 30 * s2 * v2 + 80 * t2 * v2 + 30 * u2 * v2 - 120 * q * s * t * w -
         20 * r * q2 * u * w + 24 * r * s2 * u * w - 8 * r * u * u2 * w + 40 * r * q * s * v * w + 120 * t * u * v * w +
         20 * r * u * v2 * w + 50 * p2 * w2 + 50 * q2 * w2 - 10 * s2 * w2 - 40 * t2 * w2 - 10 * u2 * w2 + 50 * v2 * w2 +
         25 * w2 * w2;
}

TEST(Deviation, IsThePrintedPolynomial) {
  std::mt19937 generator(6);
  for (int i = 0; i < 1000; ++i) {
    const Octupole a = RandomHarmonic<3>(&generator);
    EXPECT_NEAR(Deviation<3>(a), PrintedDeviation(a), 1e-13 * std::pow(a.norm(), 4) * 25);
  }
}

// Lemma 2: d is the average over all rotations of the sum of the squares of the paper's three quadrics, here by a rule
// exact for its integrand, which has degree 12 in each Euler angle: the trapezium rule with more than 12 nodes, and
// Gauss and Legendre's with 7.
TEST(Deviation, IsTheAverageOfThePapersThreeQuadrics) {
  const double nodes[] = {0, 0.4058451513773972, 0.7415311855993945, 0.9491079123427585};
  const double weights[] = {0.4179591836734694, 0.3818300505051189, 0.2797053914892766, 0.1294849661688697};
  constexpr int kTurns = 13;
  const auto turn = [](int k, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(2 * EIGEN_PI * k / kTurns, axis).toRotationMatrix();
  };
  std::mt19937 generator(7);
  for (int i = 0; i < 5; ++i) {
    const Octupole a = RandomHarmonic<3>(&generator);
    double average = 0;
    for (int node = -3; node <= 3; ++node) {
      const double cosine = (node < 0 ? -1 : 1) * nodes[std::abs(node)];
      const Matrix3d tilt = Eigen::AngleAxisd(std::acos(cosine), Eigen::Vector3d::UnitX()).toRotationMatrix();
      for (int j = 0; j < kTurns; ++j) {
        for (int k = 0; k < kTurns; ++k) {
          const Matrix3d rotation = turn(j, Eigen::Vector3d::UnitZ()) * tilt * turn(k, Eigen::Vector3d::UnitZ());
          const Octupole b = HarmonicRotation<3>(rotation) * a;
          double trial = 0;
          for (const HarmonicMatrix<3>& m : PaperQuadrics()) trial += std::pow(b.dot(m * b), 2);
          average += weights[std::abs(node)] / (2 * kTurns * kTurns) * trial;
        }
      }
    }
    EXPECT_NEAR(average, Deviation<3>(a), 1e-12 * average);
  }
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

}  // namespace
}  // namespace octupole
