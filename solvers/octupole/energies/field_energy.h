#pragma once

#include <ceres/first_order_function.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "octupole/energies/field_problem.h"
#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/minimization/workers.h"

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
///
/// Of a part of a graph whose other parts lie elsewhere, the vertices from num_owned on are ghosts: they are owned by
/// other parts, which tell their values. The part's energy holds half of each edge to a ghost, so that those of the
/// parts add up to the graph's, and the gradient by owned vertices is complete. Values travel between the steps of an
/// evaluation: Expand, what Row says to the rows of ghosts elsewhere, Sweep.
template <int kDegree>
class FieldEnergy final : public ceres::FirstOrderFunction {
 public:
  /// `workers` must outlive the function.
  /// \param num_owned the vertices that are no ghosts: all, if not given. The alignments of ghosts do not matter.
  /// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), num_owned is larger than it or a
  /// weight is negative or not finite.
  FieldEnergy(const FieldGraph& graph, const EnergyWeights& weights, Workers* workers,
              std::optional<std::size_t> num_owned = std::nullopt);
  ~FieldEnergy() override;

  int NumParameters() const override;

  /// `gradient` may be null. Not to be called by two threads at once.
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override;

  /// The first step of Evaluate: sets the values of the owned vertices.
  void Expand(const double* parameters) const;
  /// The second: the share of the owned vertices begin to end in the cost, and, unless `gradient` is null, their part
  /// of it. \param begin a multiple of 4. \param end another, or the number of owned vertices.
  double Sweep(std::size_t begin, std::size_t end, const double* parameters, double* gradient) const;
  /// The value of a vertex, kRowSize numbers.
  double* Row(std::size_t v) const;
  static constexpr std::size_t kRowSize = kDegree == 3 ? 8 : 12;

  /// The parameters of the allowed field nearest to `field`, one harmonic per vertex.
  /// \throw std::invalid_argument when it has another size.
  std::vector<double> ParametersOf(const std::vector<Harmonic<kDegree>>& field) const;
  /// The field, one harmonic per vertex, for ghosts as they were told.
  /// \throw std::invalid_argument unless there are NumParameters() parameters.
  std::vector<Harmonic<kDegree>> FieldOf(const std::vector<double>& parameters) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace octupole
