#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "octupole/harmonics/harmonics.h"

namespace octupole {

template <int kDegree>
using HarmonicMatrix = Eigen::Matrix<double, kDimension<kDegree>, kDimension<kDegree>>;

/// D(R), the orthogonal matrix by which the rotation R acts on the coefficients of a harmonic: D(R) h are the
/// coefficients of x -> f(R^-1 x) when h are those of f. D(R1 R2) = D(R1) D(R2) (theory.md, section 1).
///
/// Polynomial in the entries of R, no trigonometry: the recursion of Ivanic and Ruedenberg, J. Phys. Chem. 100 (1996)
/// 6342, with the erratum of 102 (1998) 9099, in the sign convention of `Harmonic`. Degrees 3 and 4.
///
/// \throw std::invalid_argument when `rotation` is not a rotation (orthonormal to 1e-6 and right-handed).
template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotation(const Eigen::Matrix3d& rotation);

/// The same for the rotation of a unit quaternion; q and -q give the same.
/// \throw std::invalid_argument when the squared norm differs from 1 by more than 1e-6.
template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotation(const Eigen::Quaterniond& rotation);

/// The generators G_x, G_y, G_z of D: D(rotation by t about axis k) = exp(t G_k), right-handed. Antisymmetric, with
/// G_x G_y - G_y G_x = G_z and cyclically. Degrees 3 and 4.
template <int kDegree>
const std::array<HarmonicMatrix<kDegree>, 3>& RotationGenerators();

/// Throws std::invalid_argument, its message beginning with `caller`, unless `matrix` is orthonormal to 1e-6 and
/// right-handed: what every function that takes a rotation or a frame asks of it.
void CheckRotation(const char* caller, const Eigen::Matrix3d& matrix);

}  // namespace octupole
