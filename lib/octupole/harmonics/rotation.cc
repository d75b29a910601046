#include "octupole/harmonics/rotation.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace octupole {
namespace {

const Eigen::IOFormat kInline(Eigen::StreamPrecision, Eigen::DontAlignCols, ", ", "; ");

// D of degree 1, with rows and columns in the order y, z, x of the harmonics m = -1, 0, 1.
HarmonicMatrix<1> FirstDegree(const Eigen::Matrix3d& rotation) {
  constexpr int kOrder[] = {1, 2, 0};
  HarmonicMatrix<1> d;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) d(i, j) = rotation(kOrder[i], kOrder[j]);
  }
  return d;
}

// The factors of Ivanic and Ruedenberg's tables 1 and 2 for one degree, indexed by order + degree. Their u, v and w are
// products of a factor of one order, here `u`, `v` and `w`, and the same factor of the other order, `other`.
template <int kDegree>
struct RecursionFactors {
  Eigen::Array<double, kDimension<kDegree>, 1> u, v, w, other;

  RecursionFactors() {
    constexpr int l = kDegree;
    for (int m = -l; m <= l; ++m) {
      const int p = std::abs(m);
      u[m + l] = std::sqrt((l + m) * (l - m));
      v[m + l] = m == 0 ? -std::sqrt(l * (l - 1) / 2.) : std::sqrt((p == 1 ? 2 : 1) * (l + p - 1) * (l + p)) / 2;
      w[m + l] = m == 0 ? 0 : -std::sqrt((l - p - 1) * (l - p)) / 2;
      other[m + l] = 1 / std::sqrt(p < l ? (l + m) * (l - m) : 2 * l * (2 * l - 1));
    }
  }
};

// The recursion of Ivanic and Ruedenberg from degree 1 to kDegree. They combine rows; D(R)^T = D(R^-1) lets us combine
// columns, which lie together in memory, in the same way.
template <int kDegree>
HarmonicMatrix<kDegree> UncheckedRotation(const HarmonicMatrix<1>& first) {
  if constexpr (kDegree == 1) {
    return first;
  } else {
    static const RecursionFactors<kDegree> factors;
    constexpr int l = kDegree;
    const HarmonicMatrix<l - 1> previous = UncheckedRotation<l - 1>(first);
    // Their P of i = -1, 0, 1 and |a| < l: column i of degree 1 combined with column a of degree l - 1.
    using Column = Eigen::Array<double, kDimension<l>, 1>;
    Column products[3][2 * l - 1];
    for (int a = 0; a < 2 * l - 1; ++a) {
      const double lowest = previous(0, a), highest = previous(2 * l - 2, a);
      for (int i = 0; i < 3; ++i) {
        Column& product = products[i][a];
        product[0] = first(2, i) * lowest + first(0, i) * highest;
        for (int n = 0; n < 2 * l - 1; ++n) product[n + 1] = first(1, i) * previous(n, a);
        product[2 * l] = first(2, i) * highest - first(0, i) * lowest;
      }
    }
    const auto p = [&](int i, int a) -> const Column& { return products[i + 1][a + l - 1]; };
    HarmonicMatrix<l> d;
    d.col(l) = factors.other * (factors.u[l] * p(0, 0) + factors.v[l] * (p(1, 1) + p(-1, -1)));
    for (int m = 1; m <= l; ++m) {
      const double u = factors.u[l + m], v = factors.v[l + m], w = factors.w[l + m];
      Column plus, minus;
      if (m == 1) {
        plus = v * p(1, 0);
        minus = v * p(-1, 0);
      } else {
        plus = v * (p(1, m - 1) - p(-1, 1 - m));
        minus = v * (p(1, 1 - m) + p(-1, m - 1));
      }
      if (m < l) {
        plus += u * p(0, m);
        minus += u * p(0, -m);
      }
      if (m < l - 1) {
        plus += w * (p(1, m + 1) + p(-1, -m - 1));
        minus += w * (p(1, -m - 1) - p(-1, m + 1));
      }
      d.col(l + m) = factors.other * plus;
      d.col(l - m) = factors.other * minus;
    }
    return d;
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
HarmonicMatrix<kDegree> HarmonicRotation(const Eigen::Quaterniond& rotation) {
  // Written so that a NaN fails, too.
  if (!(std::abs(rotation.squaredNorm() - 1) <= 1e-6)) {
    std::ostringstream message;
    message << "HarmonicRotation: not a unit quaternion: ["
            << Eigen::Vector4d(rotation.w(), rotation.x(), rotation.y(), rotation.z()).transpose().format(kInline)
            << "]";
    throw std::invalid_argument(message.str());
  }
  return UncheckedRotation<kDegree>(FirstDegree(rotation.normalized().toRotationMatrix()));
}

template <int kDegree>
const std::array<HarmonicMatrix<kDegree>, 3>& RotationGenerators() {
  static const std::array<HarmonicMatrix<kDegree>, 3> generators = MakeGenerators<kDegree>();
  return generators;
}

template HarmonicMatrix<3> HarmonicRotation<3>(const Eigen::Matrix3d&);
template HarmonicMatrix<4> HarmonicRotation<4>(const Eigen::Matrix3d&);
template HarmonicMatrix<3> HarmonicRotation<3>(const Eigen::Quaterniond&);
template HarmonicMatrix<4> HarmonicRotation<4>(const Eigen::Quaterniond&);
template const std::array<HarmonicMatrix<3>, 3>& RotationGenerators<3>();
template const std::array<HarmonicMatrix<4>, 3>& RotationGenerators<4>();

void CheckRotation(const char* caller, const Eigen::Matrix3d& matrix) {
  const double error = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  // Written so that a NaN fails, too.
  if (error <= 1e-6 && matrix.determinant() > 0) return;
  std::ostringstream message;
  message << caller << ": not a rotation: [" << matrix.format(kInline) << "]";
  throw std::invalid_argument(message.str());
}

}  // namespace octupole
