#pragma once

#include <ceres/first_order_function.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/solvers/field_problem.h"
#include "octupole/solvers/workers.h"

namespace octupole {

/// The energy that BuildFieldProblem makes of residual blocks, as one function: half of E (cost_weight.h) with
/// its gradient, by one sweep over the vertices. With n = |a|^2, an edge contributes to the gradient of E at its end a
///
///   degree 3: weight (4 (n_a + n_b) a - 8 (a . b) b),   degree 4: weight (2 a - 2 b)
///
/// (theory.md, section 3). A vertex gathers this from its neighbours, so that nothing is written twice.
///
/// Its parameters are the free unknowns alone, vertex after vertex: kDimension coefficients where the vertex is free,
/// two coordinates in the AlignedSubspace of an axis, none where the frame is prescribed. Use it with
/// ceres::GradientProblem or MinimizeLbfgs. The sum over vertices does not depend on the number of threads.
template <int kDegree>
class FieldEnergy final : public ceres::FirstOrderFunction {
 public:
  /// `workers` must outlive the function.
  /// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph) or a weight is negative or not
  /// finite.
  FieldEnergy(const FieldGraph& graph, const EnergyWeights& weights, Workers* workers);
  ~FieldEnergy() override;

  int NumParameters() const override;

  /// `gradient` may be null. Not to be called by two threads at once.
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override;

  /// The parameters of the allowed field nearest to `field`, one harmonic per vertex.
  /// \throw std::invalid_argument when it has another size.
  std::vector<double> ParametersOf(const std::vector<Harmonic<kDegree>>& field) const;
  /// The field, one harmonic per vertex.
  /// \throw std::invalid_argument unless there are NumParameters() parameters.
  std::vector<Harmonic<kDegree>> FieldOf(const std::vector<double>& parameters) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace octupole
