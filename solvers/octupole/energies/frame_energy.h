#pragma once

#include <ceres/first_order_function.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/minimization/workers.h"

namespace octupole {

/// The smoothness of frames: half of the sum over edges of weight * FrameDifference<4>(A, B), and its gradient,
/// computed by one sweep over the vertices from the frames' unit harmonics.
///
/// Its parameters turn the given frames. A free vertex has three, x, and the frame A C(x/2): C(r) is the rotation of
/// the quaternion (1, r) (Cayley), by 2 atan |r| about r; so x is nearly the rotation vector and no angle is singular
/// but half a turn. An axis leaves one, the third. A prescribed frame has none. All zero gives the given frames.
///
/// With soft alignments every vertex has three parameters, whatever its alignment, and each aligned one adds half of
/// soft_weight times the squared distance from its harmonic to those of degree 4 that the alignment allows: to
/// AlignedSubspace<4> of an axis, as AlignmentCost, and to the harmonic of a prescribed frame.
///
/// Of a part of a graph, the vertices from num_owned on are ghosts, as of FieldEnergy.
class FrameEnergy final : public ceres::FirstOrderFunction {
 public:
  /// \param frames one per vertex, which keep to the alignments: the third column along an axis (see
  /// NearestAlignedFrame).
  ///     `workers` must outlive the function.
  /// \param soft_weight if given, alignments are soft, and the frames need not keep to them,
  /// \param is_hard but at these vertices: empty, or one value per vertex.
  /// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), there are not as many frames as
  /// vertices, soft_weight is negative or not finite, is_hard has another size, or num_owned is larger than the graph.
  FrameEnergy(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames, Workers* workers,
              std::optional<double> soft_weight = std::nullopt, const std::vector<bool>& is_hard = {},
              std::optional<std::size_t> num_owned = std::nullopt);
  ~FrameEnergy() override;

  int NumParameters() const override;

  /// `gradient` may be null. Not to be called by two threads at once.
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override;

  /// The steps of Evaluate, as of FieldEnergy.
  void Expand(const double* parameters) const;
  double Sweep(std::size_t begin, std::size_t end, const double* parameters, double* gradient) const;
  double* Row(std::size_t v) const;
  static constexpr std::size_t kRowSize = 12;

  /// The turned frames, one per vertex; those of ghosts as they were given.
  /// \throw std::invalid_argument unless there are NumParameters() parameters.
  std::vector<Eigen::Matrix3d> FramesOf(const std::vector<double>& parameters) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace octupole
