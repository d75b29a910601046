#include "octupole/harmonics/quadrics.h"

#include <cmath>

namespace octupole {
namespace {

template <int kDegree>
std::array<HarmonicMatrix<kDegree>, 5> MakeQuadrics() {
  const auto& [x, y, z] = RotationGenerators<kDegree>();
  const double c = 1 / std::sqrt(3.);
  const std::array<HarmonicMatrix<kDegree>, 5> quadrics = {
      (2 * z * z - x * x - y * y) / 3,  //
      c * (y * z + z * y),              //
      c * (x * z + z * x),              //
      c * (x * y + y * x),              //
      c * (x * x - y * y),
  };
  // Rounding leaves entries near 1e-16 where zeros belong; QuadricValues skips exact zeros.
  std::array<HarmonicMatrix<kDegree>, 5> clean;
  for (int k = 0; k < 5; ++k) {
    clean[k] = (quadrics[k].array().abs() < 1e-12).select(HarmonicMatrix<kDegree>::Zero(), quadrics[k]);
  }
  return clean;
}

}  // namespace

template <int kDegree>
const std::array<HarmonicMatrix<kDegree>, 5>& Quadrics() {
  static const std::array<HarmonicMatrix<kDegree>, 5> quadrics = MakeQuadrics<kDegree>();
  return quadrics;
}

std::array<HarmonicMatrix<3>, 3> PaperQuadrics() {
  const auto& quadrics = Quadrics<3>();
  return {quadrics[0], std::sqrt(2.) * quadrics[2], std::sqrt(2.) * quadrics[1]};
}

template const std::array<HarmonicMatrix<3>, 5>& Quadrics<3>();
template const std::array<HarmonicMatrix<4>, 5>& Quadrics<4>();

}  // namespace octupole
