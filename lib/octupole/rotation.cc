#include "octupole/rotation.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace octupole {
namespace {

// The numbers u, v, w of Ivanic and Ruedenberg's table 1 for one degree, indexed [m + degree][n + degree]. The factors
// sqrt(1 + delta) of their table 2 are folded into the recursion below.
template <int kDegree>
struct RecursionTable {
  double u[kDimension<kDegree>][kDimension<kDegree>];
  double v[kDimension<kDegree>][kDimension<kDegree>];
  double w[kDimension<kDegree>][kDimension<kDegree>];

  RecursionTable() {
    constexpr int l = kDegree;
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) {
        const double denominator = std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1);
        const int p = std::abs(m);
        u[m + l][n + l] = std::sqrt((l + m) * (l - m) / denominator);
        v[m + l][n + l] = std::sqrt((m == 0 ? 2 : 1) * (l + p - 1) * (l + p) / denominator) / (m == 0 ? -2 : 2);
        w[m + l][n + l] = m == 0 ? 0 : -std::sqrt((l - p - 1) * (l - p) / denominator) / 2;
      }
    }
  }
};

// D of degree 1, with rows and columns in the order y, z, x of the harmonics m = -1, 0, 1.
HarmonicMatrix<1> FirstDegree(const Eigen::Matrix3d& rotation) {
  constexpr int kOrder[] = {1, 2, 0};
  HarmonicMatrix<1> d;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) d(i, j) = rotation(kOrder[i], kOrder[j]);
  }
  return d;
}

template <int kDegree>
HarmonicMatrix<kDegree> NextDegree(const HarmonicMatrix<1>& first, const HarmonicMatrix<kDegree - 1>& previous) {
  static const RecursionTable<kDegree> table;
  static const double kSqrt2 = std::sqrt(2.);
  constexpr int l = kDegree;
  // Ivanic and Ruedenberg's P: entry (i, n) of degree 1 combined with row a of the previous degree.
  const auto p = [&](int i, int a, int n) {
    const int row = a + l - 1;
    if (n == l) return first(i + 1, 2) * previous(row, 2 * l - 2) - first(i + 1, 0) * previous(row, 0);
    if (n == -l) return first(i + 1, 2) * previous(row, 0) + first(i + 1, 0) * previous(row, 2 * l - 2);
    return first(i + 1, 1) * previous(row, n + l - 1);
  };
  HarmonicMatrix<kDegree> d;
  for (int m = -l; m <= l; ++m) {
    for (int n = -l; n <= l; ++n) {
      double entry = 0;
      if (std::abs(m) < l) entry += table.u[m + l][n + l] * p(0, m, n);
      if (m == 0) {
        entry += table.v[m + l][n + l] * (p(1, 1, n) + p(-1, -1, n));
      } else if (m > 0) {
        entry += table.v[m + l][n + l] * (m == 1 ? kSqrt2 * p(1, 0, n) : p(1, m - 1, n) - p(-1, 1 - m, n));
      } else {
        entry += table.v[m + l][n + l] * (m == -1 ? kSqrt2 * p(-1, 0, n) : p(1, m + 1, n) + p(-1, -m - 1, n));
      }
      if (m > 0 && m < l - 1) entry += table.w[m + l][n + l] * (p(1, m + 1, n) + p(-1, -m - 1, n));
      if (m < 0 && m > 1 - l) entry += table.w[m + l][n + l] * (p(1, m - 1, n) - p(-1, 1 - m, n));
      d(m + l, n + l) = entry;
    }
  }
  return d;
}

template <int kDegree>
HarmonicMatrix<kDegree> UncheckedRotation(const HarmonicMatrix<1>& first) {
  if constexpr (kDegree == 1) {
    return first;
  } else {
    return NextDegree<kDegree>(first, UncheckedRotation<kDegree - 1>(first));
  }
}

template <int kDegree>
std::array<HarmonicMatrix<kDegree>, 3> MakeGenerators() {
  constexpr int l = kDegree;
  HarmonicMatrix<kDegree> x = HarmonicMatrix<kDegree>::Zero(), z = HarmonicMatrix<kDegree>::Zero();
  for (int m = 1; m <= l; ++m) {
    z(l - m, l + m) = m;
    z(l + m, l - m) = -m;
  }
  // z d/dy - y d/dz takes cos(m phi) to sin((m+1) phi) and sin(m phi) to -cos((m+1) phi), and back.
  for (int m = 0; m < l; ++m) {
    const double c = std::sqrt((m == 0 ? 2. : 1.) * (l - m) * (l + m + 1)) / 2;
    x(l - m - 1, l + m) = -c;
    x(l + m, l - m - 1) = c;
    if (m == 0) continue;
    x(l + m + 1, l - m) = c;
    x(l - m, l + m + 1) = -c;
  }
  return {x, z * x - x * z, z};
}

}  // namespace

template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotation(const Eigen::Matrix3d& rotation) {
  CheckRotation("HarmonicRotation", rotation);
  return UncheckedRotation<kDegree>(FirstDegree(rotation));
}

template <int kDegree>
const std::array<HarmonicMatrix<kDegree>, 3>& RotationGenerators() {
  static const std::array<HarmonicMatrix<kDegree>, 3> generators = MakeGenerators<kDegree>();
  return generators;
}

template HarmonicMatrix<3> HarmonicRotation<3>(const Eigen::Matrix3d&);
template HarmonicMatrix<4> HarmonicRotation<4>(const Eigen::Matrix3d&);
template const std::array<HarmonicMatrix<3>, 3>& RotationGenerators<3>();
template const std::array<HarmonicMatrix<4>, 3>& RotationGenerators<4>();

void CheckRotation(const char* caller, const Eigen::Matrix3d& matrix) {
  const double error = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  // Written so that a NaN fails, too.
  if (error <= 1e-6 && matrix.determinant() > 0) return;
  std::ostringstream message;
  message << caller << ": not a rotation: ["
          << matrix.format(Eigen::IOFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", "; ")) << "]";
  throw std::invalid_argument(message.str());
}

}  // namespace octupole
