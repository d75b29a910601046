#include "octupole/maps/foldover_energy.h"

#include <algorithm>

namespace octupole {
namespace {

constexpr double kLeastEpsilon = 1e-8;

}  // namespace

FoldoverEnergy EvaluateFoldoverEnergy(double squared_norm, double det, double epsilon) {
  const double root = std::sqrt(epsilon * epsilon + det * det);
  const double chi = RegularisedDeterminant(det, epsilon);
  const double chi1 = chi / root, chi2 = epsilon * epsilon / (2 * root * root * root);
  const double power = 1 / std::cbrt(chi * chi), inverse = 1 / chi;
  const double s = squared_norm, volume = det * det + 1;
  FoldoverEnergy e;
  e.energy = s * power + volume * inverse;
  e.by_norm = power;
  e.by_norm_det = -2. / 3 * power * inverse * chi1;
  e.by_det = s * e.by_norm_det + (2 * det - volume * inverse * chi1) * inverse;
  e.by_det_det = s * power * inverse * (10. / 9 * inverse * chi1 * chi1 - 2. / 3 * chi2) +
                 inverse * (2 - 4 * det * chi1 * inverse + volume * inverse * (2 * chi1 * chi1 * inverse - chi2));
  // In (J, det) the Hessian is 2 by_norm on J, bordered by 2 by_norm_det J and by_det_det.
  e.by_det_det = std::max(e.by_det_det, 2 * e.by_norm_det * e.by_norm_det * s / e.by_norm);
  return e;
}

double FirstEpsilon(double least_det) {
  const double below = std::min(least_det, 0.);
  return std::sqrt(1e-12 + 0.04 * below * below);
}

double NextEpsilon(double epsilon, double least_det, double energy_before, double energy_after) {
  const double sigma = std::max(1 - energy_after / energy_before, 0.1);
  const double mu = (1 - sigma) * RegularisedDeterminant(least_det, epsilon);
  if (least_det >= mu) return kLeastEpsilon;
  return std::max(kLeastEpsilon, 2 * std::sqrt(mu * (mu - least_det)));
}

}  // namespace octupole
