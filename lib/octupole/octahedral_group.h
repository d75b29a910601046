#pragma once

#include <Eigen/Core>
#include <array>

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
  OctahedralRotation operator*(const OctahedralRotation& other) const;
  bool operator==(const OctahedralRotation& other) const { return axis == other.axis && sign == other.sign; }
  bool operator!=(const OctahedralRotation& other) const { return !(*this == other); }
};

/// All 24 rotations of the cube, the identity first.
const std::array<OctahedralRotation, 24>& OctahedralGroup();

/// The g in S4 for which a g is closest to b: the largest trace of (a g)^T b (theory.md, section 6).
OctahedralRotation MatchFrames(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// Whether the frames at a triangle's corners turn when matched around it: the product of the three matches is not the
/// identity, so that a singular curve crosses the triangle (theory.md, section 6).
bool IsSingularTriangle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, const Eigen::Matrix3d& c);

}  // namespace octupole
