#pragma once

#include <ceres/first_order_function.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "octupole/field_graph.h"
#include "octupole/harmonic_rows.h"
#include "octupole/neighbour_lists.h"
#include "octupole/workers.h"

namespace octupole {

/// The smoothness of frames: half of the sum over edges of weight * FrameDifference<4>(A, B), and its gradient,
/// computed by one sweep over the vertices from the frames' unit harmonics.
///
/// Its parameters turn the given frames. A free vertex has three, x, and the frame A C(x/2): C(r) is the rotation of
/// the quaternion (1, r) (Cayley), by 2 atan |r| about r; so x is nearly the rotation vector and no angle is singular
/// but half a turn. An axis leaves one, the angle about it. A prescribed frame has none. All zero gives the given
/// frames.
class FrameEnergy final : public ceres::FirstOrderFunction {
 public:
  /// \param frames one per vertex, which keep to the alignments: the third column along an axis (see
  /// NearestAlignedFrame).
  ///     `workers` must outlive the function.
  /// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph) or there are not as many frames as
  /// vertices.
  FrameEnergy(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames, Workers* workers);

  int NumParameters() const override { return static_cast<int>(first_parameter_.back()); }

  /// `gradient` may be null. Not to be called by two threads at once.
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override;

  /// The turned frames, one per vertex.
  /// \throw std::invalid_argument unless there are NumParameters() parameters.
  std::vector<Eigen::Matrix3d> FramesOf(const std::vector<double>& parameters) const;

 private:
  Eigen::Matrix3d FrameOf(const double* parameters, std::size_t v) const;
  void Expand(const double* parameters, std::size_t begin, std::size_t end) const;

  internal::NeighbourLists neighbours_;
  std::vector<Eigen::Matrix3d> frames_;
  /// Of each vertex, and the end.
  std::vector<std::size_t> first_parameter_;
  Workers* workers_;
  /// The harmonics of the last evaluation, with a row of zeros for the filling of the neighbour lists.
  mutable std::vector<internal::HarmonicRow<4>> rows_;
};

}  // namespace octupole
