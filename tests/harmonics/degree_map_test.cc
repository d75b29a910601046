#include "octupole/harmonics/degree_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "octupole/frames/frame.h"
#include "octupole/harmonics/rotation.h"
#include "random_inputs.h"

namespace octupole {
namespace {

TEST(HexadecapoleFromOctupole, TakesTheOctupoleOfAFrameToItsHexadecapole) {
  std::mt19937 generator(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d frame = RandomFrame(&generator);
    const Octupole a = HarmonicFromFrame<3>(frame);
    EXPECT_LT((HexadecapoleFromOctupole(a) - HarmonicFromFrame<4>(frame)).norm(), 1e-14);
    EXPECT_EQ(HexadecapoleFromOctupole(-a), HexadecapoleFromOctupole(a));
    EXPECT_LT((HexadecapoleFromOctupole(3 * a) - 9 * HexadecapoleFromOctupole(a)).norm(), 1e-13);
  }
}

TEST(HexadecapoleFromOctupole, CommutesWithRotations) {
  std::mt19937 generator(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d rotation = RandomFrame(&generator);
    const Octupole a = RandomHarmonic<3>(&generator);
    EXPECT_LT((HexadecapoleFromOctupole(HarmonicRotation<3>(rotation) * a) -
               HarmonicRotation<4>(rotation) * HexadecapoleFromOctupole(a))
                  .norm(),
              1e-14 * 10 * a.squaredNorm());
  }
}

// The function that it stands for: the integrals of f^2 against the basis, by the midpoint rule in z, which for
// polynomials of degree 10 converges with the square of the step.
TEST(HexadecapoleFromOctupole, IsTheDegree4PartOfTheSquare) {
  constexpr int kBands = 2000, kTurns = 12;
  std::mt19937 generator(3);
  const Octupole a = RandomHarmonic<3>(&generator).normalized();
  Hexadecapole integral = Hexadecapole::Zero();
  for (int i = 0; i < kBands; ++i) {
    const double z = (2. * i + 1) / kBands - 1, r = std::sqrt(1 - z * z);
    for (int j = 0; j < kTurns; ++j) {
      const double phi = 2 * EIGEN_PI * j / kTurns;
      const Eigen::Vector3d at(r * std::cos(phi), r * std::sin(phi), z);
      integral += 4 * EIGEN_PI / (kBands * kTurns) * std::pow(a.dot(EvaluateBasis<3>(at)), 2) * EvaluateBasis<4>(at);
    }
  }
  EXPECT_LT((HexadecapoleFromOctupole(a) + 5.5 * std::sqrt(4 * EIGEN_PI / 21) * integral).norm(), 1e-5);
}

}  // namespace
}  // namespace octupole
