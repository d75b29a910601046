#include "octupole/map_solvers/internal/hessian_solver.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace octupole::internal {
namespace {

// Above, the factor's fill makes it slower than conjugate gradients (docs/maps.md).
constexpr std::size_t kMaxFactored = 6000;

}  // namespace

struct HessianSolver::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
  bool is_analysed = false;
};

HessianSolver::HessianSolver(MapEnergy* energy) : energy_(energy) {
  if (energy->num_unknowns() <= kMaxFactored) factor_ = std::make_unique<Factor>();
}

HessianSolver::~HessianSolver() = default;

void HessianSolver::Solve(const Vector& right, double tolerance, int max_iterations, Vector* x) {
  x->assign(right.size(), 0);
  if (factor_) {
    Eigen::SparseMatrix<double> hessian = energy_->Assemble();
    if (!factor_->is_analysed) factor_->ldlt.analyzePattern(hessian);
    factor_->is_analysed = true;
    factor_->ldlt.factorize(hessian);
    if (factor_->ldlt.info() == Eigen::Success) {
      Eigen::Map<Eigen::VectorXd> result(x->data(), static_cast<Eigen::Index>(x->size()));
      result =
          factor_->ldlt.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), static_cast<Eigen::Index>(right.size())));
      if (result.allFinite()) return;
    }
    x->assign(right.size(), 0);
  }
  SolveByConjugateGradients(energy_, right, tolerance, max_iterations, x);
}

}  // namespace octupole::internal
