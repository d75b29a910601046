#pragma once

#include "octupole/harmonics/rotation.h"

namespace octupole {

// Rotations about the coordinate axes, in the manner of the paper's appendix A.1: every one is built from rotations
// about z, which turn each pair of orders +-m by m times the angle, and one constant matrix, the quarter turn about x.
// All are right-handed, D(exp(angle G_k)) of RotationGenerators(), except PaperRotationY(). Degrees 3 and 4. \throw
// std::invalid_argument, all of them, when the angle is not finite.

/// The rotation by `angle` about +z; the paper's R_z.
template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationZ(double angle);

/// The quarter turn about +x; the paper's R_x(pi/2).
template <int kDegree>
const HarmonicMatrix<kDegree>& HarmonicQuarterTurnX();

/// The rotation by `angle` about +y, Q^T R_z(angle) Q with Q the quarter turn about x.
template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationY(double angle);

/// The paper's R_y, Q R_z(angle) Q^T: the rotation by -angle about +y (theory.md, errata 2).
template <int kDegree>
HarmonicMatrix<kDegree> PaperRotationY(double angle);

/// The rotation by `angle` about +x; the paper's R_x, R_y(pi/2)^T R_z(angle) R_y(pi/2) with the paper's R_y.
template <int kDegree>
HarmonicMatrix<kDegree> HarmonicRotationX(double angle);

}  // namespace octupole
