#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// What a vertex's frame must keep to: nothing, one axis, or all three.
enum class AlignmentKind : std::uint8_t { kFree, kAxis, kFrame };

/// The alignment of one vertex. It is geometry, not coefficients: the same alignment serves every degree.
class Alignment {
 public:
  /// A free vertex.
  Alignment() = default;

  /// One axis of the frame is parallel to `direction`, of any length and either sign.
  /// \throw std::invalid_argument when `direction` is zero or not finite.
  static Alignment Axis(const Eigen::Vector3d& direction);

  /// The frame's axes are the columns of `axes`, up to order and signs.
  /// \throw std::invalid_argument when `axes` is not orthonormal to 1e-6 or not right-handed.
  static Alignment Frame(const Eigen::Matrix3d& axes);

  /// The frame whose axes are two directions of any lengths and signs, and their cross product. What they lack to a
  /// right angle is split evenly between them. \throw std::invalid_argument when one is zero or not finite, or they are
  /// not within a degree of a right angle.
  static Alignment TwoAxes(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

  AlignmentKind kind() const { return kind_; }

  /// A frame that satisfies the alignment. For kAxis its third column is the prescribed axis; for kFree it is the
  /// identity.
  Eigen::Matrix3d frame() const { return rotation_.toRotationMatrix(); }

 private:
  AlignmentKind kind_ = AlignmentKind::kFree;
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
};

/// The affine subspace offset + span(basis) of the harmonics that an alignment allows (theory.md, section 4).
///
/// `basis` is orthonormal, orthogonal to `offset`, and has
///  - kDimension columns (the identity) for a free vertex,
///  - 2 columns for an axis n: D(R_n) applied to Y_{l,-2}, Y_{l,2} in degree 3 and to Y_{l,-4}, Y_{l,4} in degree 4,
///    where R_n e_z = n. The octahedral harmonics with this axis are a circle in it, of radius 1 in degree 3 and
///    sqrt(5/12) in degree 4,
///  - 1 column for a frame: its unit harmonic.
/// `offset` is zero except for an axis in degree 4, where it is sqrt(7/12) D(R_n) Y_{4,0}.
template <int kDegree>
struct AlignedSubspace {
  using Basis = Eigen::Matrix<double, kDimension<kDegree>, Eigen::Dynamic, Eigen::ColMajor, kDimension<kDegree>,
                              kDimension<kDegree>>;

  explicit AlignedSubspace(const Alignment& alignment);

  /// The nearest point of the subspace.
  Harmonic<kDegree> Project(const Harmonic<kDegree>& h) const {
    return offset + basis * (basis.transpose() * (h - offset));
  }

  Harmonic<kDegree> offset = Harmonic<kDegree>::Zero();
  Basis basis;
};

}  // namespace octupole
