#include "octupole/distributed/internal/tao_minimizer.h"

#include <petsctao.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "octupole/distributed/internal/petsc.h"

namespace octupole::internal {
namespace {

// As of MinimizeLbfgs.
constexpr double kGradientTolerance = 1e-8;
constexpr int kWindow = 5;

// What the ranks tell each other with their shares of the cost.
enum Message { kCost, kStops, kAborts, kIsDue, kNumMessages };

// Options of ours, for as long as this lives, where the user has given none.
class DefaultOptions {
 public:
  DefaultOptions() {
    for (const auto& [name, value] : {std::pair("-tao_lmvm_mat_lmvm_scale_type", "scalar")}) {
      PetscBool is_set = PETSC_FALSE;
      Check(PetscOptionsHasName(nullptr, nullptr, name, &is_set));
      if (is_set == PETSC_TRUE) continue;
      Check(PetscOptionsSetValue(nullptr, name, value));
      names_.push_back(name);
    }
  }
  ~DefaultOptions() {
    for (const char* name : names_) PetscOptionsClearValue(nullptr, name);
  }
  DefaultOptions(const DefaultOptions&) = delete;
  DefaultOptions& operator=(const DefaultOptions&) = delete;

 private:
  std::vector<const char*> names_;
};

}  // namespace

// One minimisation.
struct TaoMinimizer::Run {
  TaoMinimizer* minimizer;
  const Function& function;
  double cost_tolerance;
  double function_tolerance;
  std::vector<double>* parameters;
  const Keep& keep;
  int num_iterations = 0;
  double cost = 0;
  double last_cost = 0;
  std::array<double, kWindow> last_costs = {};
  std::array<double, kNumMessages> messages = {};
  bool is_finite = true;
  ceres::TerminationType termination = ceres::CONVERGENCE;
};

struct TaoCallbacks {
  static PetscErrorCode Evaluate(Tao /*tao*/, Vec x, PetscReal* cost, Vec gradient, void* context) {
    auto& run = *static_cast<TaoMinimizer::Run*>(context);
    TaoMinimizer& minimizer = *run.minimizer;
    const PetscScalar* parameters = nullptr;
    PetscScalar* derivatives = nullptr;
    PetscFunctionBeginUser;
    PetscCall(VecGetArrayRead(x, &parameters));
    PetscCall(VecGetArrayWrite(gradient, &derivatives));
    run.messages = {};
    run.messages[kCost] = run.function(parameters, derivatives);
    run.messages[kStops] = minimizer.answer_ == ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    run.messages[kAborts] = minimizer.answer_ == ceres::SOLVER_ABORT;
    run.messages[kIsDue] = minimizer.is_due_ && minimizer.is_due_();
    MPI_Allreduce(MPI_IN_PLACE, run.messages.data(), kNumMessages, MPI_DOUBLE, MPI_SUM, minimizer.comm_);
    PetscCall(VecRestoreArrayRead(x, &parameters));
    PetscCall(VecRestoreArrayWrite(gradient, &derivatives));
    *cost = run.messages[kCost];
    run.is_finite = std::isfinite(*cost);
    ++minimizer.num_evaluations_;
    PetscFunctionReturn(0);
  }

  // Called once an iteration, before the first, too.
  static PetscErrorCode Test(Tao tao, void* context) {
    auto& run = *static_cast<TaoMinimizer::Run*>(context);
    TaoMinimizer& minimizer = *run.minimizer;
    PetscInt iteration = 0;
    PetscReal cost = 0, gradient_norm = 0, step = 0;
    PetscFunctionBeginUser;
    PetscCall(TaoGetSolutionStatus(tao, &iteration, &cost, &gradient_norm, nullptr, &step, nullptr));
    const auto end = [&](ceres::TerminationType termination) {
      run.termination = termination;
      return TaoSetConvergedReason(tao, TAO_CONVERGED_USER);
    };
    run.cost = cost;
    if (iteration == 0) {
      run.last_costs.fill(cost);
    } else {
      run.num_iterations = static_cast<int>(iteration);
      ceres::IterationSummary summary;
      summary.iteration = static_cast<int>(minimizer.iterations_.size()) + 1;
      summary.cost = cost;
      summary.cost_change = run.last_cost - cost;
      summary.gradient_max_norm = gradient_norm;
      summary.step_size = step;
      summary.cumulative_time_in_seconds = minimizer.Seconds();
      minimizer.iterations_.push_back(summary);
      // The others hear of it at the next evaluation.
      if (minimizer.options_.callback != nullptr) minimizer.answer_ = (*minimizer.options_.callback)(summary);
      if (run.messages[kIsDue] > 0 && run.keep) {
        Vec x = nullptr;
        const PetscScalar* parameters = nullptr;
        PetscCall(TaoGetSolution(tao, &x));
        PetscCall(VecGetArrayRead(x, &parameters));
        run.keep({parameters, parameters + run.parameters->size()});
        PetscCall(VecRestoreArrayRead(x, &parameters));
      }
    }
    run.last_cost = cost;
    if (run.messages[kAborts] > 0) PetscFunctionReturn(end(ceres::USER_FAILURE));
    if (run.messages[kStops] > 0) PetscFunctionReturn(end(ceres::USER_SUCCESS));
    if (gradient_norm <= kGradientTolerance || cost < run.cost_tolerance) PetscFunctionReturn(end(ceres::CONVERGENCE));
    if (minimizer.IterationsLeft() <= 0) PetscFunctionReturn(end(ceres::NO_CONVERGENCE));
    if (iteration == 0) PetscFunctionReturn(0);
    double& oldest_cost = run.last_costs[run.num_iterations % kWindow];
    if (run.num_iterations >= kWindow && oldest_cost - cost <= kWindow * run.function_tolerance * cost) {
      PetscFunctionReturn(end(ceres::CONVERGENCE));
    }
    oldest_cost = cost;
    PetscFunctionReturn(0);
  }
};

double TaoMinimizer::Minimize(const std::string& name, const GraphLevel& level, const Function& function,
                              double cost_tolerance, double function_tolerance, std::vector<double>* parameters,
                              const Keep& keep) {
  Run run = {this, function, cost_tolerance, function_tolerance, parameters, keep};
  const DefaultOptions defaults;
  PetscHandle<Vec, VecDestroy> x;
  PetscHandle<Tao, TaoDestroy> tao;
  Check(
      VecCreateMPIWithArray(comm_, 1, static_cast<PetscInt>(parameters->size()), PETSC_DECIDE, parameters->data(), &x));
  Check(TaoCreate(comm_, &tao));
  Check(TaoSetType(tao, TAOLMVM));
  Check(TaoSetMaximumFunctionEvaluations(tao, PETSC_MAX_INT));
  Check(TaoSetMaximumIterations(tao, PETSC_MAX_INT));
  Check(TaoSetSolution(tao, x));
  Check(TaoSetObjectiveAndGradient(tao, nullptr, TaoCallbacks::Evaluate, &run));
  Check(TaoSetConvergenceTest(tao, TaoCallbacks::Test, &run));
  Check(TaoSetFromOptions(tao));
  PetscInt num_parameters = 0;
  Check(VecGetSize(x, &num_parameters));
  if (num_parameters > 0 && !IsEnded() && IterationsLeft() > 0) {
    const PetscErrorCode code = TaoSolve(tao);
    if (run.is_finite) {
      Check(code);
    } else {
      run.termination = ceres::FAILURE;
    }
  } else {
    if (num_parameters > 0) run.termination = ceres::NO_CONVERGENCE;
    run.cost = function(parameters->data(), nullptr);
    MPI_Allreduce(MPI_IN_PLACE, &run.cost, 1, MPI_DOUBLE, MPI_SUM, comm_);
  }
  if (!IsEnded()) termination_ = run.termination;
  const double energy = 2 * run.cost;
  if (options_.step_callback) {
    options_.step_callback({name, static_cast<std::size_t>(level.num_vertices), run.num_iterations, energy, Seconds()});
  }
  return energy;
}

void TaoMinimizer::Continue(const std::vector<ceres::IterationSummary>& iterations,
                            ceres::TerminationType termination) {
  auto num_iterations = static_cast<int>(iterations.size());
  auto reason = static_cast<int>(termination);
  MPI_Bcast(&num_iterations, 1, MPI_INT, 0, comm_);
  MPI_Bcast(&reason, 1, MPI_INT, 0, comm_);
  iterations_.insert(iterations_.end(), iterations.begin(), iterations.end());
  iterations_.resize(std::max<std::size_t>(iterations_.size(), num_iterations));
  termination_ = static_cast<ceres::TerminationType>(reason);
}

}  // namespace octupole::internal
