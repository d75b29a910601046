#include "octupole/harmonics/penalty.h"

namespace octupole {

template <int kDegree>
Harmonic<kDegree> DeviationGradient(const Harmonic<kDegree>& h) {
  Harmonic<kDegree> gradient = Harmonic<kDegree>::Zero();
  for (const HarmonicMatrix<kDegree>& quadric : Quadrics<kDegree>()) {
    const Harmonic<kDegree> image = quadric * h;
    gradient += 4 * h.dot(image) * image;
  }
  return gradient;
}

template <int kDegree>
HarmonicMatrix<kDegree> DeviationHessian(const Harmonic<kDegree>& h) {
  HarmonicMatrix<kDegree> hessian = HarmonicMatrix<kDegree>::Zero();
  for (const HarmonicMatrix<kDegree>& quadric : Quadrics<kDegree>()) {
    const Harmonic<kDegree> image = quadric * h;
    hessian += 4 * h.dot(image) * quadric + 8 * image * image.transpose();
  }
  return hessian;
}

template <int kDegree>
double Penalty(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight) {
  const double scale = h.squaredNorm() - 1;
  return scale_weight * scale * scale + deviation_weight * Deviation<kDegree>(h);
}

template <int kDegree>
Harmonic<kDegree> PenaltyGradient(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight) {
  return 4 * scale_weight * (h.squaredNorm() - 1) * h + deviation_weight * DeviationGradient<kDegree>(h);
}

template <int kDegree>
HarmonicMatrix<kDegree> PenaltyHessian(const Harmonic<kDegree>& h, double scale_weight, double deviation_weight) {
  return 4 * scale_weight * (h.squaredNorm() - 1) * HarmonicMatrix<kDegree>::Identity() +
         8 * scale_weight * h * h.transpose() + deviation_weight * DeviationHessian<kDegree>(h);
}

template Octupole DeviationGradient<3>(const Octupole&);
template Hexadecapole DeviationGradient<4>(const Hexadecapole&);
template HarmonicMatrix<3> DeviationHessian<3>(const Octupole&);
template HarmonicMatrix<4> DeviationHessian<4>(const Hexadecapole&);
template double Penalty<3>(const Octupole&, double, double);
template double Penalty<4>(const Hexadecapole&, double, double);
template Octupole PenaltyGradient<3>(const Octupole&, double, double);
template Hexadecapole PenaltyGradient<4>(const Hexadecapole&, double, double);
template HarmonicMatrix<3> PenaltyHessian<3>(const Octupole&, double, double);
template HarmonicMatrix<4> PenaltyHessian<4>(const Hexadecapole&, double, double);

}  // namespace octupole
