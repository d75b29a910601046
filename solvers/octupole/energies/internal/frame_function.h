#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "octupole/energies/internal/harmonic_rows.h"
#include "octupole/energies/internal/sweep_graph.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/minimization/workers.h"

namespace octupole::internal {

/// FrameEnergy in floats or doubles: half the smoothness of frames and its gradient over their turns.
template <typename Scalar>
class FrameFunction {
 public:
  /// `graph`, `frames` and `workers` must outlive the function.
  FrameFunction(const SweepGraph& graph, const std::vector<Eigen::Matrix3d>& frames, Workers* workers,
                std::optional<double> soft_weight = std::nullopt, const std::vector<bool>& is_hard = {});

  int num_parameters() const { return first_parameter_.back(); }
  void Evaluate(const Scalar* parameters, double* cost, Scalar* gradient) const;
  /// The steps of Evaluate, see FieldEnergy.
  void Expand(const Scalar* parameters) const;
  double Sweep(std::size_t begin, std::size_t end, const Scalar* parameters, Scalar* gradient) const;
  Scalar* RowOf(std::size_t v) const { return rows_[v].values; }
  /// The turned frames, rotations to the last bits of a double.
  std::vector<Eigen::Matrix3d> FramesOf(const std::vector<Scalar>& parameters) const;

 private:
  using Row = HarmonicRow<4, Scalar>;
  struct SoftAlignment {
    Hexadecapole offset;
    Eigen::Matrix<double, kDimension<4>, 2> basis;
  };
  /// Of as many vertices as there are lanes, the columns of their frames one after another.
  struct alignas(32) FrameLanes {
    Scalar entries[9][kLanes<Scalar>];
  };

  int NumParameters(std::size_t v) const { return first_parameter_[v + 1] - first_parameter_[v]; }
  void GatherTurns(const Scalar* parameters, std::size_t first, Lanes<Scalar>* turns) const;
  void ExpandRange(const Scalar* parameters, std::size_t begin, std::size_t end) const;
  template <bool kWeighted>
  double SweepRange(const Scalar* parameters, std::size_t begin, std::size_t end, Scalar* gradient) const;
  double AddSoftAlignment(std::size_t v, Scalar* gradient) const;

  const SweepGraph& graph_;
  const std::vector<Eigen::Matrix3d>& frames_;
  std::vector<FrameLanes> frame_lanes_;
  /// Of each vertex and those that fill up the rows, and the end.
  std::vector<int> first_parameter_;
  /// The subspaces of soft alignments, and for each vertex the number of its own or -1.
  std::vector<SoftAlignment> soft_alignments_;
  std::vector<int> soft_alignment_of_;
  double soft_weight_ = 0;
  Workers* workers_;
  /// The harmonics of the last evaluation, with rows of zeros for the filling of the neighbour lists.
  mutable std::vector<Row> rows_;
};

}  // namespace octupole::internal
