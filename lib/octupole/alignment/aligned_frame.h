#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// The frame nearest to the harmonic h among those that keep to an alignment. Free: NearestFrame. An axis: the nearest
/// on the circle of AlignedSubspace, in closed form; its third column is the axis. A frame: that frame. Where h says
/// nothing, zero or across the subspace of the axis, any such frame.
/// \throw std::invalid_argument when h is not finite.
template <int kDegree>
Eigen::Matrix3d NearestAlignedFrame(const Alignment& alignment, const Harmonic<kDegree>& h);

/// The nearest frames that keep to the alignments, one each, as NearestAlignedFrame<4> of their harmonics: what soft
/// alignment leaves open, closed. Frames without alignment stay as they are.
/// \throw std::invalid_argument unless there is one alignment per frame, or when one of these is not a rotation.
std::vector<Eigen::Matrix3d> AlignFrames(const std::vector<Alignment>& alignments, std::vector<Eigen::Matrix3d> frames);

}  // namespace octupole
