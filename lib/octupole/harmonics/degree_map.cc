#include "octupole/harmonics/degree_map.h"

#include <array>
#include <cmath>

#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

using Matrix7 = HarmonicMatrix<3>;

// The nine quadratic forms H_k, scaled for the map. As functions of the octupole they turn like the harmonics of degree
// 4: G_j H_k - H_k G_j, with the generators G of degree 3, is the sum over i of (generator j of degree 4)_{ik} H_i.
// That gives all of them from the one of m = 0, which is diagonal.
std::array<Matrix7, 9> MakeForms() {
  const auto& [x3, y3, z3] = RotationGenerators<3>();
  const auto& [x4, y4, z4] = RotationGenerators<4>();
  const auto commutator = [](const Matrix7& a, const Matrix7& b) { return Matrix7(a * b - b * a); };
  constexpr int l = 4;
  std::array<Matrix7, 9> forms;
  Octupole diagonal;
  diagonal << 3, -7, 1, 6, 1, -7, 3;
  forms[l] = -std::sqrt(7. / 12) / 7 * Matrix7(diagonal.asDiagonal());
  for (int m = 0; m < l; ++m) {
    // G_x couples the order m with -(m + 1) and -(m - 1).
    Matrix7 next = commutator(x3, forms[l + m]);
    if (m > 0) next -= x4(l - m + 1, l + m) * forms[l - m + 1];
    forms[l - m - 1] = next / x4(l - m - 1, l + m);
    forms[l + m + 1] = commutator(z3, forms[l - m - 1]) / z4(l + m + 1, l - m - 1);
  }
  return forms;
}

}  // namespace

Hexadecapole HexadecapoleFromOctupole(const Octupole& a) {
  static const std::array<Matrix7, 9> forms = MakeForms();
  Hexadecapole h;
  for (int k = 0; k < 9; ++k) h[k] = a.dot(forms[k] * a);
  return h;
}

}  // namespace octupole
