#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace octupole {

/// A rotation of the cube: the signed permutation matrix of determinant +1 whose entry (i, axis[i]) is sign[i].
/// The 24 of them are the group S4, the symmetries of a frame.
struct OctahedralRotation {
  std::array<int, 3> axis = {0, 1, 2};
  std::array<int, 3> sign = {1, 1, 1};

  Eigen::Matrix3d matrix() const;
  /// Whether it belongs to A4, the rotations of the tetrahedron. They permute the axes cyclically and leave the
  /// reference octupole alone; the others turn it into its negative.
  bool IsEven() const { return axis[1] == (axis[0] + 1) % 3; }
  OctahedralRotation Inverse() const;
  OctahedralRotation operator*(const OctahedralRotation& other) const;
  bool operator==(const OctahedralRotation& other) const { return axis == other.axis && sign == other.sign; }
  bool operator!=(const OctahedralRotation& other) const { return !(*this == other); }
};

/// All 24 rotations of the cube, the identity first.
const std::array<OctahedralRotation, 24>& OctahedralGroup();

/// The place of `g` in OctahedralGroup().
int IndexOf(const OctahedralRotation& g);

/// The g in S4 for which a g is closest to b: the largest trace of (a g)^T b (theory.md, section 6).
OctahedralRotation MatchFrames(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// The conjugacy classes of S4: what is left of a rotation of the cube when the axes may be named anew. Quarter turns
/// and half turns about face diagonals are the odd ones.
enum class TurnType : std::uint8_t {
  kNone = 0,          ///< the identity
  kQuarter = 1,       ///< by 90 degrees about an axis, 6 of them
  kHalf = 2,          ///< by 180 degrees about an axis, 3
  kDiagonalHalf = 3,  ///< by 180 degrees about a diagonal of a face, 6
  kThird = 4,         ///< by 120 degrees about a diagonal of the cube, 8
};

/// By TurnType, as reports and files call them.
inline constexpr std::array<const char*, 5> kTurnTypeNames = {"none", "quarter", "half", "diagonal_half", "third"};

TurnType TypeOf(const OctahedralRotation& g);

/// The holonomy of a triangle whose corners have the frames a, b, c: the product of the matches around it, from a to b
/// to c to a. The frame turns by a h^T a^T on the way. The last match is taken as the inverse of that from a to c, so
/// triangles agree about the edges they share, ties included, if they have their corners in one order of the vertices.
OctahedralRotation Holonomy(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c);

/// TypeOf(Holonomy(a, b, c)); unless it is kNone, a singular curve crosses the triangle (theory.md, section 6).
///
/// Takes the parity shortcut where it is enough. A SumOfFourthPowers of a^T b above 3 - sin(80 deg)^2 certifies that
/// the frames are less than 40 degrees apart, hence the match is odd exactly if the permanent is negative; and if that
/// holds on all three edges the frame turns by less than 120 degrees, so the holonomy is a quarter turn if it is odd,
/// and the identity if not.
TurnType HolonomyType(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c);

}  // namespace octupole
