#pragma once

#include <Eigen/Core>

#include "octupole/harmonics/harmonics.h"

namespace octupole {

// A frame is a rotation matrix whose columns are its three axes. Its axes have neither order nor sign: the 24 products
// F g with a rotation g of the cube (octahedral_group.h) are the same frame.

/// The unit octahedral harmonic of a frame, D(frame) times the reference. In degree 3 the frame fixes it up to sign.
/// \throw std::invalid_argument when `frame` is not a rotation.
template <int kDegree>
Harmonic<kDegree> HarmonicFromFrame(const Eigen::Matrix3d& frame);

/// The frame whose harmonic is nearest to h: the global maximum of h . D(R) reference over all rotations R
/// (theory.md, section 5). Orthonormal to rounding. In degree 3 the signs are such that h . HarmonicFromFrame(frame) >
/// 0.
///
/// Newton's method on the rotation group, from the best rotation of a fixed covering of it, and, unless the maximum
/// found is within the manifold's reach of h and therefore the global one, from every local maximum of the covering.
/// When several frames are equally near, it is one of them, always the same for the same h. \throw
/// std::invalid_argument when h is zero or not finite: no frame is nearest then.
template <int kDegree>
Eigen::Matrix3d NearestFrame(const Harmonic<kDegree>& h);

/// The same, from a frame that may be near: faster where it is. The result does not depend on it but by rounding and
/// where several frames are equally near.
template <int kDegree>
Eigen::Matrix3d NearestFrame(const Harmonic<kDegree>& h, const Eigen::Matrix3d& guess);

/// The distance from h to the nearest unit octahedral harmonic, |h - HarmonicFromFrame(NearestFrame(h))|.
/// \throw std::invalid_argument when h is zero or not finite.
template <int kDegree>
double DistanceToFrames(const Harmonic<kDegree>& h);

/// The permanent of a 3 x 3 matrix. For unit semisymmetric octupoles a, b of the frames A, B it is a . b, with
/// Q = A^T B (theory.md, section 3).
double Permanent(const Eigen::Matrix3d& q);

/// The sum of the fourth powers of the entries. For unit octahedral hexadecapoles g, h of the frames A, B,
/// g . h = (SumOfFourthPowers(Q) - 9/5) / (6/5) with Q = A^T B (theory.md, section 3).
double SumOfFourthPowers(const Eigen::Matrix3d& q);

/// The smoothness term of an edge between two frames, from their unit harmonics a, b and Q = A^T B, in closed form:
/// degree 3: |a - b|^2 |a + b|^2 = 4 (1 - Permanent(Q)^2); degree 4: |a - b|^2 = 5/3 (3 - SumOfFourthPowers(Q)).
/// For frames a small angle t apart these are 16 t^2 and 20/3 t^2.
template <int kDegree>
double FrameDifference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace octupole
