#include "octupole/alignment/constraints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/octahedral_group.h"

namespace octupole {
namespace {

constexpr double kDegrees = 180 / EIGEN_PI;

Eigen::Vector3d AxisOf(const Alignment& alignment) { return alignment.frame().col(2); }

// Between two lines, in degrees, at most 90.
double LineAngleDeg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return kDegrees * std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

double AxisToFrameDeg(const Eigen::Vector3d& axis, const Eigen::Matrix3d& frame) {
  double angle = LineAngleDeg(axis, frame.col(0));
  for (int k = 1; k < 3; ++k) angle = std::min(angle, LineAngleDeg(axis, frame.col(k)));
  return angle;
}

double FrameAngleDeg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d turn = a * MatchFrames(a, b).matrix() * b.transpose();
  return kDegrees * Eigen::AngleAxisd(turn).angle();
}

// The constraint, completed by what `boundary` asks of the turn about a prescribed axis.
Alignment Complete(const Alignment& constraint, const Alignment& boundary) {
  if (constraint.kind() == AlignmentKind::kFrame) return constraint;
  if (boundary.kind() == AlignmentKind::kFree) return constraint;
  if (boundary.kind() == AlignmentKind::kFrame) {
    return Alignment::Frame(NearestAlignedFrame<4>(constraint, HarmonicFromFrame<4>(boundary.frame())));
  }
  const Eigen::Vector3d axis = AxisOf(constraint), normal = AxisOf(boundary);
  if (LineAngleDeg(axis, normal) < 45) return constraint;
  Eigen::Matrix3d frame;
  frame.col(2) = axis;
  frame.col(0) = (normal - axis * axis.dot(normal)).normalized();
  frame.col(1) = axis.cross(frame.col(0));
  return Alignment::Frame(frame);
}

std::string Describe(const Alignment& alignment) {
  std::ostringstream text;
  // Without the rounding of its rotation.
  const Eigen::Matrix3d frame = alignment.frame().unaryExpr([](double x) { return std::abs(x) < 1e-12 ? 0 : x; });
  if (alignment.kind() == AlignmentKind::kAxis) {
    text << "the axis [" << frame.col(2).transpose() << "]";
  } else {
    text << "the axes [" << frame.col(0).transpose() << "] and [" << frame.col(1).transpose() << "]";
  }
  return text.str();
}

}  // namespace

double ContradictionDeg(const Alignment& a, const Alignment& b) {
  if (a.kind() == AlignmentKind::kFree || b.kind() == AlignmentKind::kFree) return 0;
  if (a.kind() == AlignmentKind::kFrame && b.kind() == AlignmentKind::kFrame) {
    return FrameAngleDeg(a.frame(), b.frame());
  }
  if (a.kind() == AlignmentKind::kFrame) return AxisToFrameDeg(AxisOf(b), a.frame());
  if (b.kind() == AlignmentKind::kFrame) return AxisToFrameDeg(AxisOf(a), b.frame());
  const double angle = LineAngleDeg(AxisOf(a), AxisOf(b));
  return std::min(angle, 90 - angle);
}

bool AreSame(const Alignment& a, const Alignment& b) {
  constexpr double kSameDeg = 1e-6;
  if (a.kind() != b.kind()) return false;
  if (a.kind() == AlignmentKind::kAxis) return LineAngleDeg(AxisOf(a), AxisOf(b)) < kSameDeg;
  return ContradictionDeg(a, b) < kSameDeg;
}

ConstraintSummary ApplyConstraints(const std::vector<Constraint>& constraints, std::vector<Alignment>* alignments) {
  ConstraintSummary summary;
  std::vector<Alignment> constraint_of(constraints.empty() ? 0 : alignments->size());
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const auto& [vertex, alignment] = constraints[i];
    const auto fail = [&, v = vertex](const std::string& what) {
      throw std::invalid_argument("ApplyConstraints: constraint " + std::to_string(i) + " of vertex " +
                                  std::to_string(v) + what);
    };
    if (vertex < 0 || vertex >= static_cast<int>(alignments->size())) {
      fail(", out of range 0.." + std::to_string(static_cast<std::int64_t>(alignments->size()) - 1));
    }
    if (alignment.kind() == AlignmentKind::kFree) fail(" prescribes nothing");
    Alignment& earlier = constraint_of[vertex];
    if (earlier.kind() != AlignmentKind::kFree) {
      if (AreSame(earlier, alignment)) continue;
      fail(" asks for " + Describe(alignment) + ", an earlier one for " + Describe(earlier));
    }
    earlier = alignment;
    ++(alignment.kind() == AlignmentKind::kAxis ? summary.num_axes : summary.num_frames);
    Alignment& boundary = (*alignments)[vertex];
    const double contradiction = ContradictionDeg(boundary, alignment);
    summary.num_contradictions += contradiction > kContradictionDeg;
    summary.largest_contradiction_deg = std::max(summary.largest_contradiction_deg, contradiction);
    boundary = Complete(alignment, boundary);
  }
  return summary;
}

}  // namespace octupole
