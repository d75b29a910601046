#include "octupole/solvers/mbo.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "octupole/energies/field_energy.h"
#include "octupole/energies/field_problem.h"
#include "octupole/field/coarse_graph.h"
#include "octupole/solvers/internal/minimizer.h"

namespace octupole {
namespace {

using internal::Frames;
using internal::Minimizer;

// Relative change of the energy or the field at which it is stable.
constexpr double kTolerance = 1e-5;
// Relative decrease per iteration at which a diffusion ends.
constexpr double kDiffusionTolerance = 1e-4;

// f(x) + |x - center|^2 / (2 time).
class ProximalFunction final : public ceres::FirstOrderFunction {
 public:
  ProximalFunction(const ceres::FirstOrderFunction& function, const std::vector<double>& center, double inverse_time)
      : function_(function), center_(center), inverse_time_(inverse_time) {}

  int NumParameters() const override { return function_.NumParameters(); }

  bool Evaluate(const double* x, double* cost, double* gradient) const override {
    if (!function_.Evaluate(x, cost, gradient)) return false;
    double squared_distance = 0;
    for (std::size_t i = 0; i < center_.size(); ++i) {
      const double difference = x[i] - center_[i];
      squared_distance += difference * difference;
      if (gradient != nullptr) gradient[i] += inverse_time_ * difference;
    }
    *cost += inverse_time_ * squared_distance / 2;
    return true;
  }

 private:
  const ceres::FirstOrderFunction& function_;
  const std::vector<double>& center_;
  double inverse_time_;
};

double CostOf(const FieldEnergy<4>& function, const std::vector<double>& x) {
  double cost = 0;
  function.Evaluate(x.data(), &cost, nullptr);
  return cost;
}

double Norm(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum);
}

double Distance(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
  return std::sqrt(sum);
}

}  // namespace

FrameSolution SolveMbo(const FieldGraph& graph, const MinimizerOptions& options) {
  CheckFieldGraph(graph);
  Minimizer minimizer(options);
  const std::vector<int> order = BreadthFirstOrder(graph);
  const FieldGraph ordered = Reorder(graph, order);
  const FieldEnergy<4> energy(ordered, {0, 0}, minimizer.workers());
  // The Laplacian's first eigenvalue above zero on a graph that fills a box, from the mean weight at a vertex.
  const double num_vertices = static_cast<double>(std::max<std::size_t>(1, ordered.num_vertices()));
  const double lambda = 2.5 * (2 * SumOfWeights(graph) / num_vertices) / std::pow(num_vertices, 2. / 3);

  Frames frames;
  std::vector<double> x = energy.ParametersOf(RandomField<4>(ordered, options.seed));
  double cost = CostOf(energy, x);
  for (int step = 1;; ++step) {
    const ProximalFunction diffusion(energy, x, lambda * std::pow(step, 3) / 50);
    std::vector<double> diffused = x;
    minimizer.Minimize(diffusion, ordered, kDiffusionTolerance, &diffused);
    frames = internal::ProjectField<4>(ordered.alignments, energy.FieldOf(diffused), minimizer.workers());
    std::vector<double> projected = energy.ParametersOf(internal::HarmonicsOf<4>(frames));
    const double change = Distance(projected, x);
    const double last_cost = std::exchange(cost, CostOf(energy, projected));
    x = std::move(projected);
    if (minimizer.termination() != ceres::CONVERGENCE) break;
    if (std::abs(last_cost - cost) <= kTolerance * cost || change <= kTolerance * Norm(x)) break;
  }
  return minimizer.MakeSolution(graph, order, frames, 2 * cost, SizeOfProblem(graph, kUnknownsOfKind<4>));
}

}  // namespace octupole
