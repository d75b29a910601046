#pragma once

#include <Eigen/Core>

namespace octupole {

/// Number of real spherical harmonics of a degree: 7 for degree 3, 9 for degree 4.
template <int kDegree>
inline constexpr int kDimension = 2 * kDegree + 1;

/// Coefficients of a harmonic in the real orthonormal basis of its degree, order m = -kDegree .. kDegree, without
/// Condon-Shortley sign (theory.md, section 1).
template <int kDegree>
using Harmonic = Eigen::Matrix<double, kDimension<kDegree>, 1>;

/// Degree 3. A frame is an octupole up to sign.
using Octupole = Harmonic<3>;
/// Degree 4. A frame is exactly one octahedral hexadecapole.
using Hexadecapole = Harmonic<4>;

/// The basis functions Y_{kDegree,m} at `direction`, in the order of `Harmonic`.
///
/// They are evaluated as homogeneous polynomials of degree kDegree: for a unit vector these are the orthonormal
/// harmonics, and a vector of length r gives r^kDegree times as much. A harmonic h has the value
/// h.dot(EvaluateBasis<kDegree>(direction)). Degrees 3 and 4.
template <int kDegree>
Harmonic<kDegree> EvaluateBasis(const Eigen::Vector3d& direction);

/// The gradient at `point` of the homogeneous polynomial of a harmonic h, h.dot(EvaluateBasis<kDegree>(x)). Degrees 3
/// and 4.
template <int kDegree>
Eigen::Vector3d EvaluateGradient(const Harmonic<kDegree>& h, const Eigen::Vector3d& point);

/// The unit harmonic of the frame of coordinate axes: Y_{3,-2} (that is c xyz) in degree 3, and
/// sqrt(7/12) Y_{4,0} + sqrt(5/12) Y_{4,4} in degree 4. Degrees 3 and 4.
template <int kDegree>
Harmonic<kDegree> ReferenceHarmonic();

}  // namespace octupole
