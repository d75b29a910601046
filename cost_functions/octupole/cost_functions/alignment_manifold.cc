#include "octupole/cost_functions/alignment_manifold.h"

namespace octupole {
namespace {

template <int kDegree>
using ConstVector = Eigen::Map<const Harmonic<kDegree>>;
using RowMajorMatrix = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

}  // namespace

template <int kDegree>
bool AlignmentManifold<kDegree>::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Eigen::Map<const Eigen::VectorXd> tangent(delta, basis_.cols());
  Eigen::Map<Harmonic<kDegree>> result(x_plus_delta);
  result = ConstVector<kDegree>(x) + basis_ * tangent;
  return true;
}

template <int kDegree>
bool AlignmentManifold<kDegree>::PlusJacobian(const double* /*x*/, double* jacobian) const {
  RowMajorMatrix result(jacobian, basis_.rows(), basis_.cols());
  result = basis_;
  return true;
}

template <int kDegree>
bool AlignmentManifold<kDegree>::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Eigen::VectorXd> result(y_minus_x, basis_.cols());
  result = basis_.transpose() * (ConstVector<kDegree>(y) - ConstVector<kDegree>(x));
  return true;
}

template <int kDegree>
bool AlignmentManifold<kDegree>::MinusJacobian(const double* /*x*/, double* jacobian) const {
  RowMajorMatrix result(jacobian, basis_.cols(), basis_.rows());
  result = basis_.transpose();
  return true;
}

template class AlignmentManifold<3>;
template class AlignmentManifold<4>;

}  // namespace octupole
