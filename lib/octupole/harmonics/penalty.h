#pragma once

#include "octupole/harmonics/quadrics.h"

namespace octupole {

// Derivatives of the deviation d(h) = sum over k of q_k^2, q_k = h^T N_k h (paper, eq. 3.1), and the penalty
//
//   p(h) = scale_weight (|h|^2 - 1)^2 + deviation_weight d(h)                                        (paper, eq. 4.1)
//
// with its derivatives, in closed form. p is zero exactly on the unit octahedral harmonics, in degree 4 also on their
// negatives. In degree 3 its Hessian there is 8 scale_weight along the radius, 160 deviation_weight in the three other
// directions across the manifold: isotropic when deviation_weight = scale_weight / 20. In degree 4 the five others have
// 1120/9 (three times) and 4480/9 (twice), so no weights make it isotropic (theory.md, section 2). Degrees 3 and 4.

/// 4 sum over k of q_k N_k h.
template <int kDegree>
Harmonic<kDegree> DeviationGradient(const Harmonic<kDegree>& h);

/// 4 sum over k of (q_k N_k + 2 N_k h h^T N_k).
template <int kDegree>
HarmonicMatrix<kDegree> DeviationHessian(const Harmonic<kDegree>& h);

template <int kDegree>
double Penalty(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight);

/// 4 scale_weight (|h|^2 - 1) h plus deviation_weight times the gradient of d.
template <int kDegree>
Harmonic<kDegree> PenaltyGradient(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight);

/// scale_weight (4 (|h|^2 - 1) I + 8 h h^T) plus deviation_weight times the Hessian of d.
template <int kDegree>
HarmonicMatrix<kDegree> PenaltyHessian(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight);

}  // namespace octupole
