#pragma once

#include <cstddef>
#include <vector>

#include "octupole/energies/field_problem.h"
#include "octupole/energies/internal/harmonic_rows.h"
#include "octupole/energies/internal/sweep_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/minimization/workers.h"

namespace octupole::internal {

/// FieldEnergy in floats or doubles: half the energy and its gradient over the free unknowns.
template <int kDegree, typename Scalar>
class FieldFunction {
 public:
  /// `graph` and `workers` must outlive the function.
  FieldFunction(const SweepGraph& graph, const EnergyWeights& weights, Workers* workers);

  int num_parameters() const { return first_parameter_.back(); }
  void Evaluate(const Scalar* parameters, double* cost, Scalar* gradient) const;
  /// The steps of Evaluate, see FieldEnergy.
  void Expand(const Scalar* parameters) const;
  double Sweep(std::size_t begin, std::size_t end, Scalar* gradient) const;
  Scalar* RowOf(std::size_t v) const { return rows_[v].values; }

  std::vector<Scalar> ParametersOf(const std::vector<Harmonic<kDegree>>& field) const;
  /// On the allowed subspaces to the last bits of a double; for ghosts as they were told.
  std::vector<Harmonic<kDegree>> FieldOf(const std::vector<Scalar>& parameters) const;

 private:
  using Row = HarmonicRow<kDegree, Scalar>;

  template <bool kWeighted>
  double SweepRange(std::size_t begin, std::size_t end, Scalar* gradient) const;
  double AddPenalties(std::size_t v, const Lanes<Scalar>* h, Lanes<Scalar>* gradient) const;
  void ExpandRange(const Scalar* parameters, std::size_t begin, std::size_t end) const;
  int NumParameters(std::size_t v) const { return first_parameter_[v + 1] - first_parameter_[v]; }

  const SweepGraph& graph_;
  Scalar scale_;
  Scalar deviation_;
  Workers* workers_;
  /// Of each vertex and those that fill up the rows, and the end.
  std::vector<int> first_parameter_;
  /// Where an axis is prescribed, the place of the basis and offset of its subspace, three rows; else -1.
  std::vector<int> first_axis_row_;
  std::vector<Row> axis_rows_;
  /// The field of the last evaluation, with rows of zeros for the filling of the neighbour lists.
  mutable std::vector<Row> rows_;
};

}  // namespace octupole::internal
