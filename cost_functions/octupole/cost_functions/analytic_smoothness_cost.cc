#include "octupole/cost_functions/analytic_smoothness_cost.h"

#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

using RowMajor7 = Eigen::Matrix<double, 7, 7, Eigen::RowMajor>;
using RowMajor9 = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

}  // namespace

template <>
bool AnalyticSmoothnessCost<3>::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
  const Eigen::Map<const Octupole> a(parameters[0]), b(parameters[1]);
  const double sign = a.dot(b) >= 0 ? 1 : -1;
  const Octupole p = a + sign * b, q = a - sign * b;
  const double norm = p.norm();
  Eigen::Map<Octupole> r(residuals);
  r = root_ * norm * q;
  if (jacobians == nullptr) return true;
  // |p| is zero only where a and b are; the derivative is zero there.
  const Octupole direction = norm > 0 ? Octupole(root_ / norm * p) : Octupole(Octupole::Zero());
  for (int block = 0; block < 2; ++block) {
    if (jacobians[block] == nullptr) continue;
    Eigen::Map<RowMajor7> jacobian(jacobians[block]);
    const double factor = block == 0 ? 1 : sign;
    jacobian.noalias() = factor * q * direction.transpose();
    jacobian.diagonal().array() += (block == 0 ? 1 : -sign) * root_ * norm;
  }
  return true;
}

template <>
bool AnalyticSmoothnessCost<4>::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
  const Eigen::Map<const Hexadecapole> a(parameters[0]), b(parameters[1]);
  Eigen::Map<Hexadecapole> r(residuals);
  r = root_ * (a - b);
  if (jacobians == nullptr) return true;
  for (int block = 0; block < 2; ++block) {
    if (jacobians[block] == nullptr) continue;
    Eigen::Map<RowMajor9> jacobian(jacobians[block]);
    jacobian = (block == 0 ? root_ : -root_) * RowMajor9::Identity();
  }
  return true;
}

}  // namespace octupole
