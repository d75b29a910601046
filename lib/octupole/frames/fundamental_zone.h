#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "octupole/frames/octahedral_group.h"

namespace octupole {

/// The group up to which a rotation R is known from what it does to the reference: R and R g give the same octupole for
/// the 12 rotations g of the tetrahedron (A4), and the same frame for the 24 of the cube (S4).
enum class SymmetryGroup : std::uint8_t { kTetrahedral, kOctahedral };

/// The Rodrigues vector n tan(angle / 2) of a rotation (paper, A.2).
/// \throw std::invalid_argument when `rotation` is not a rotation, or is a half turn, whose vector is infinite.
Eigen::Vector3d RodriguesFromRotation(const Eigen::Matrix3d& rotation);

/// The rotation of a Rodrigues vector.
/// \throw std::invalid_argument when r is not finite.
Eigen::Matrix3d RotationFromRodrigues(const Eigen::Vector3d& r);

/// The R g of the smallest angle over the group: the representative in the fundamental zone. On the boundary of the
/// zone, where several have it, one of them. \throw std::invalid_argument when `rotation` is not a rotation.
Eigen::Matrix3d ReduceToZone(const Eigen::Matrix3d& rotation, SymmetryGroup group);

/// The smallest angle, in radians, of a rotation that takes a to b or to another element of b's class.
/// At most 90 degrees between octupoles (kTetrahedral), and about 62.8 degrees between frames (kOctahedral).
/// \throw std::invalid_argument when a or b is not a rotation.
double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, SymmetryGroup group);

/// A face of the fundamental zone, {r : normal . r = distance}; inside is normal . r <= distance.
struct ZoneFace {
  Eigen::Vector3d normal;
  double distance;
  /// When r is on this face, the rotation R of r times `crossing` is on the opposite face.
  OctahedralRotation crossing;
};

/// The faces of the zone of Rodrigues vectors of the smallest angle. kTetrahedral: the octahedron |x| + |y| + |z| <= 1,
/// 8 faces. kOctahedral: the truncated cube, the same with |x|, |y|, |z| <= sqrt(2) - 1, 14 faces (theory.md, section
/// 7).
const std::vector<ZoneFace>& ZoneFaces(SymmetryGroup group);

/// Whether r is in the zone, or outside by no more than `tolerance`.
bool IsInZone(const Eigen::Vector3d& r, SymmetryGroup group, double tolerance);

/// The point to which r on a face is glued, the Rodrigues vector of R(r) crossing: the translate of r to the opposite
/// face, turned there about the normal by half the angle of `crossing`, 45 degrees on the octagons and 60 degrees on
/// the triangles. \throw std::invalid_argument when r is not on the face to 1e-6.
Eigen::Vector3d GluedPoint(const Eigen::Vector3d& r, const ZoneFace& face);

}  // namespace octupole
