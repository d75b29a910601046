#include "octupole/harmonics/harmonics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "octupole/frames/internal/symmetric_eigen.h"
#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

struct Node {
  Vector3d point;
  double weight;
};

// Nodes of a rule that integrates polynomials up to degree 11 over the sphere exactly: Gauss-Legendre in z (Golub and
// Welsch), the trapezium rule around it.
std::vector<Node> SphereRule() {
  constexpr int kGauss = 6, kTurns = 12;
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(kGauss, kGauss);
  for (int i = 1; i < kGauss; ++i) jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4. * i * i - 1);
  const internal::SymmetricEigen eigen = internal::DecomposeSymmetric(jacobi);
  std::vector<Node> nodes;
  for (int i = 0; i < kGauss; ++i) {
    const double z = eigen.values[i], r = std::sqrt(1 - z * z);
    const double weight = 2 * std::pow(eigen.vectors(0, i), 2) * 2 * EIGEN_PI / kTurns;
    for (int j = 0; j < kTurns; ++j) {
      const double phi = 2 * EIGEN_PI * (j + .3) / kTurns;
      nodes.push_back({{r * std::cos(phi), r * std::sin(phi), z}, weight});
    }
  }
  return nodes;
}

template <int kDegree>
void ExpectOrthonormal() {
  HarmonicMatrix<kDegree> gram = HarmonicMatrix<kDegree>::Zero();
  for (const Node& node : SphereRule()) {
    const Harmonic<kDegree> basis = EvaluateBasis<kDegree>(node.point);
    gram += node.weight * basis * basis.transpose();
  }
  EXPECT_TRUE(gram.isApprox(HarmonicMatrix<kDegree>::Identity(), 1e-13)) << gram;
}

TEST(Harmonics, AreOrthonormalOnTheSphere) {
  ExpectOrthonormal<3>();
  ExpectOrthonormal<4>();
}

// A homogeneous polynomial of degree l is a harmonic when its Laplacian vanishes; here by central differences.
template <int kDegree>
void ExpectHarmonic() {
  const Vector3d at(0.3, -0.7, 0.4);
  const double h = 1e-3;
  Harmonic<kDegree> laplacian = -6 * EvaluateBasis<kDegree>(at);
  for (int k = 0; k < 3; ++k) {
    laplacian +=
        EvaluateBasis<kDegree>(at + h * Vector3d::Unit(k)) + EvaluateBasis<kDegree>(at - h * Vector3d::Unit(k));
  }
  // Fourth derivatives of degree-4 polynomials leave h^4 / 12 times a constant.
  EXPECT_LT(laplacian.norm(), 1e-10);
}

TEST(Harmonics, HaveNoLaplacian) {
  ExpectHarmonic<3>();
  ExpectHarmonic<4>();
}

// Central differences with two steps are exact for polynomials of degree 4.
template <int kDegree>
void ExpectGradient() {
  for (const Vector3d& at : {Vector3d(0.3, -0.7, 0.4), Vector3d(-1.1, 0.2, 0.9)}) {
    for (int i = 0; i < kDimension<kDegree>; ++i) {
      const Harmonic<kDegree> h = Harmonic<kDegree>::Unit(i);
      const Vector3d gradient = EvaluateGradient<kDegree>(h, at);
      for (int k = 0; k < 3; ++k) {
        const auto f = [&](double t) { return h.dot(EvaluateBasis<kDegree>(at + t * Vector3d::Unit(k))); };
        EXPECT_NEAR(gradient[k], (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / 12, 1e-12)
            << "m = " << i - kDegree << ", " << k;
      }
    }
  }
}

TEST(Harmonics, HaveTheStatedGradient) {
  ExpectGradient<3>();
  ExpectGradient<4>();
}

TEST(Harmonics, AreHomogeneous) {
  const Vector3d at(0.3, -0.7, 0.4);
  EXPECT_TRUE(EvaluateBasis<3>(2 * at).isApprox(8 * EvaluateBasis<3>(at), 1e-14));
  EXPECT_TRUE(EvaluateBasis<4>(2 * at).isApprox(16 * EvaluateBasis<4>(at), 1e-14));
}

// The convention, by order and sign: what each function is near its defining direction (theory.md, section 1).
TEST(Harmonics, FollowTheConventionOfOrderAndSign) {
  const double c = std::sqrt(0.5);
  const Octupole at_pole = EvaluateBasis<3>(Vector3d::UnitZ());
  EXPECT_NEAR(at_pole[3], std::sqrt(7 / (4 * EIGEN_PI)), 1e-15);
  EXPECT_NEAR(EvaluateBasis<3>({1, 0, 0})[6], std::sqrt(35 / (32 * EIGEN_PI)), 1e-15);
  EXPECT_NEAR(EvaluateBasis<3>({0, -1, 0})[0], std::sqrt(35 / (32 * EIGEN_PI)), 1e-15);
  EXPECT_NEAR(EvaluateBasis<3>({c, 0, c})[5], std::sqrt(105 / (128 * EIGEN_PI)), 1e-15);
  EXPECT_NEAR(EvaluateBasis<3>(Vector3d(1, 1, 1).normalized())[1], std::sqrt(105 / (108 * EIGEN_PI)), 1e-15);
  EXPECT_GT(EvaluateBasis<3>({0.1, 0, 1})[4], 0);
  EXPECT_GT(EvaluateBasis<3>({0, 0.1, 1})[2], 0);
  EXPECT_NEAR(EvaluateBasis<4>(Vector3d::UnitZ())[4], std::sqrt(9 / (4 * EIGEN_PI)), 1e-15);
  EXPECT_GT(EvaluateBasis<4>({1, 0, 0})[8], 0);
  EXPECT_GT(EvaluateBasis<4>({0.1, 0, 1})[5], 0);
  EXPECT_GT(EvaluateBasis<4>({0, 0.1, 1})[3], 0);
}

TEST(ReferenceHarmonic, IsXyzInDegree3) {
  const Vector3d at(0.3, -0.7, 0.4);
  EXPECT_NEAR(ReferenceHarmonic<3>().dot(EvaluateBasis<3>(at)),
              std::sqrt(105 / (4 * EIGEN_PI)) * at.x() * at.y() * at.z(), 1e-15);
}

TEST(ReferenceHarmonic, IsTheSumOfFourthPowersInDegree4) {
  // x^4 + y^4 + z^4 - 3/5 r^4 is the harmonic part; its norm on the sphere is 4/5 sqrt(4 pi / 21).
  for (const Vector3d& at : {Vector3d(0.3, -0.7, 0.4), Vector3d(1, 2, -0.5)}) {
    const double harmonic_part = at.array().pow(4).sum() - 0.6 * std::pow(at.squaredNorm(), 2);
    EXPECT_NEAR(ReferenceHarmonic<4>().dot(EvaluateBasis<4>(at)),
                harmonic_part * 5 / 4 * std::sqrt(21 / (4 * EIGEN_PI)), 1e-13);
  }
  EXPECT_NEAR(ReferenceHarmonic<4>().norm(), 1, 1e-15);
}

}  // namespace
}  // namespace octupole
