#include "octupole/alignment/aligned_frame.h"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "octupole/frames/frame.h"

namespace octupole {

template <int kDegree>
Eigen::Matrix3d NearestAlignedFrame(const Alignment& alignment, const Harmonic<kDegree>& h) {
  if (!h.allFinite()) {
    std::ostringstream message;
    message << "NearestAlignedFrame: no frame is nearest to [" << h.transpose() << "]";
    throw std::invalid_argument(message.str());
  }
  if (alignment.kind() == AlignmentKind::kFrame || h.isZero(0)) return alignment.frame();
  if (alignment.kind() == AlignmentKind::kFree) return NearestFrame<kDegree>(h);
  // Turning the reference by t about the axis gives (cos 2t, -sin 2t) in the basis of degree 3 and, of radius
  // sqrt(5/12), (sin 4t, cos 4t) in that of degree 4.
  const Eigen::Vector2d x = AlignedSubspace<kDegree>(alignment).basis.transpose() * h;
  const double angle = kDegree == 3 ? std::atan2(-x[1], x[0]) / 2 : std::atan2(x[0], x[1]) / 4;
  return alignment.frame() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

std::vector<Eigen::Matrix3d> AlignFrames(const std::vector<Alignment>& alignments,
                                         std::vector<Eigen::Matrix3d> frames) {
  if (alignments.size() != frames.size()) {
    throw std::invalid_argument("AlignFrames: " + std::to_string(alignments.size()) + " alignments for " +
                                std::to_string(frames.size()) + " frames");
  }
  for (std::size_t v = 0; v < frames.size(); ++v) {
    if (alignments[v].kind() == AlignmentKind::kFree) continue;
    frames[v] = NearestAlignedFrame<4>(alignments[v], HarmonicFromFrame<4>(frames[v]));
  }
  return frames;
}

template Eigen::Matrix3d NearestAlignedFrame<3>(const Alignment&, const Octupole&);
template Eigen::Matrix3d NearestAlignedFrame<4>(const Alignment&, const Hexadecapole&);

}  // namespace octupole
