#include "octupole/frames/octahedral_group.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "octupole/frames/frame.h"

namespace octupole {
namespace {

std::array<OctahedralRotation, 24> MakeGroup() {
  std::array<OctahedralRotation, 24> group;
  auto next = group.begin();
  std::array<int, 3> axis = {0, 1, 2};
  do {
    const int parity = (axis[1] - axis[0]) * (axis[2] - axis[0]) * (axis[2] - axis[1]) > 0 ? 1 : -1;
    for (int signs = 0; signs < 4; ++signs) {
      const int x = signs & 1 ? -1 : 1, y = signs & 2 ? -1 : 1;
      *next++ = {axis, {x, y, parity * x * y}};
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return group;
}

// Rotations 40 degrees or more from all those of the cube have at most this sum of fourth powers, 3 - sin(80 deg)^2,
// reached by turns about axes; here with a margin for rounding.
constexpr double kWithin40Degrees = 2.0302;

}  // namespace

Eigen::Matrix3d OctahedralRotation::matrix() const {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) m(i, axis[i]) = sign[i];
  return m;
}

OctahedralRotation OctahedralRotation::Inverse() const {
  OctahedralRotation inverse;
  for (int i = 0; i < 3; ++i) {
    inverse.axis[axis[i]] = i;
    inverse.sign[axis[i]] = sign[i];
  }
  return inverse;
}

OctahedralRotation OctahedralRotation::operator*(const OctahedralRotation& other) const {
  OctahedralRotation product;
  for (int i = 0; i < 3; ++i) {
    product.axis[i] = other.axis[axis[i]];
    product.sign[i] = sign[i] * other.sign[axis[i]];
  }
  return product;
}

const std::array<OctahedralRotation, 24>& OctahedralGroup() {
  static const std::array<OctahedralRotation, 24> group = MakeGroup();
  return group;
}

int IndexOf(const OctahedralRotation& g) {
  const auto& group = OctahedralGroup();
  return static_cast<int>(std::find(group.begin(), group.end(), g) - group.begin());
}

OctahedralRotation MatchFrames(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d q = a.transpose() * b;
  // For each order of the axes the best signs are those of the entries, but for the smallest entry's when they would
  // make a reflection.
  OctahedralRotation best;
  double best_trace = -std::numeric_limits<double>::infinity();
  for (int first = 0; first < 3; ++first) {
    for (const int parity : {1, -1}) {
      OctahedralRotation g;
      g.axis = {first, (first + 3 + parity) % 3, (first + 3 - parity) % 3};
      double trace = 0;
      int product = parity, smallest = 0;
      std::array<double, 3> entries;
      for (int i = 0; i < 3; ++i) {
        entries[i] = std::abs(q(i, g.axis[i]));
        g.sign[i] = q(i, g.axis[i]) < 0 ? -1 : 1;
        product *= g.sign[i];
        trace += entries[i];
        if (entries[i] < entries[smallest]) smallest = i;
      }
      if (product < 0) {
        g.sign[smallest] = -g.sign[smallest];
        trace -= 2 * entries[smallest];
      }
      if (trace <= best_trace) continue;
      best_trace = trace;
      best = g;
    }
  }
  return best;
}

TurnType TypeOf(const OctahedralRotation& g) {
  int trace = 0;
  for (int i = 0; i < 3; ++i) trace += g.axis[i] == i ? g.sign[i] : 0;
  switch (trace) {
    case 3:
      return TurnType::kNone;
    case 1:
      return TurnType::kQuarter;
    case 0:
      return TurnType::kThird;
    default:
      return g.IsEven() ? TurnType::kHalf : TurnType::kDiagonalHalf;
  }
}

OctahedralRotation Holonomy(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c) {
  return MatchFrames(a, b) * MatchFrames(b, c) * MatchFrames(a, c).Inverse();
}

TurnType HolonomyType(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c) {
  const Eigen::Matrix3d ab = a.transpose() * b, bc = b.transpose() * c, ac = a.transpose() * c;
  if (std::min({SumOfFourthPowers(ab), SumOfFourthPowers(bc), SumOfFourthPowers(ac)}) > kWithin40Degrees) {
    const bool is_odd = (Permanent(ab) < 0) ^ (Permanent(bc) < 0) ^ (Permanent(ac) < 0);
    return is_odd ? TurnType::kQuarter : TurnType::kNone;
  }
  return TypeOf(Holonomy(a, b, c));
}

}  // namespace octupole
