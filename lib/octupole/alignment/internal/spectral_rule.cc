#include "octupole/alignment/internal/spectral_rule.h"

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"

namespace octupole::internal {
namespace {

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using AxisBasis = Eigen::Matrix<double, 7, 2>;

// Above this lowest eigenvalue no frame is near all the normals. The worst even split of a straight edge, normals at
// 48 degrees, has 0.45; the tip of a cone has 0.47 or more.
constexpr double kMaxConflict = 0.46;
// The share of squared length above which an octupole counts as lying in a subspace.
constexpr double kMostly = 0.5;
// The lowest eigenvector counts as a frame when its cosine with its nearest frame's octupole is at least this.
constexpr double kMinFrameFit = 0.9;
// Directions lie on one line when their main direction holds at least this share of their squared lengths: two of
// them 60 degrees apart, or a cone of half-aperture 30 degrees.
constexpr double kMinLineShare = 0.75;

AxisBasis BasisOfAxis(const Eigen::Vector3d& axis) { return AlignedSubspace<3>(Alignment::Axis(axis)).basis; }

// The main direction of d, given the sum of d d^T, if it holds at least a share of their squared lengths.
std::optional<Eigen::Vector3d> FindLine(const Eigen::Matrix3d& directions, double min_share = kMinLineShare) {
  const double total = directions.trace();
  const SymmetricEigen eigen = DecomposeSymmetric(directions);
  if (total == 0 || eigen.values[2] < min_share * total) return std::nullopt;
  return eigen.vectors.col(2);
}

// Whether the harmonics in which the faces' normals agree best are those with `axis`, however turned about it. If
// turning about it is far from free, it is but one of the axes of a frame.
bool IsOnlyAxis(const Eigen::Vector3d& axis, const Matrix7& conflict, const Octupole& lowest) {
  const AxisBasis basis = BasisOfAxis(axis);
  if ((basis.transpose() * lowest).squaredNorm() < kMostly) return false;
  const Eigen::Vector2d conflicts = DecomposeSymmetric(basis.transpose() * conflict * basis).values;
  return conflicts[0] > kMostly * conflicts[1];
}

// The frame with the axis `normal` that is nearest to having the directions as axes, all of them together.
std::optional<Eigen::Matrix3d> FindFrameAbout(const Eigen::Vector3d& normal,
                                              const std::vector<Eigen::Vector3d>& directions) {
  const Eigen::Matrix3d basis = Alignment::Axis(normal).frame();
  // Turning a direction by a quarter about the normal leaves its fourth power.
  std::complex<double> sum = 0;
  for (const Eigen::Vector3d& d : directions) {
    sum += std::pow(std::complex<double>(basis.col(0).dot(d), basis.col(1).dot(d)), 4);
  }
  if (std::abs(sum) < kMostly * static_cast<double>(directions.size())) return std::nullopt;
  const double angle = std::arg(sum) / 4;
  return basis * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

void NormalSum::Add(const Eigen::Vector3d& normal, double weight) {
  const AxisBasis basis = BasisOfAxis(normal);
  conflict_ += weight * (Matrix7::Identity() - basis * basis.transpose());
  spread_ += weight * normal * normal.transpose();
  total_ += weight;
}

void NormalSum::Add(const NormalSum& other, double weight) {
  conflict_ += weight * other.conflict_;
  spread_ += weight * other.spread_;
  total_ += weight * other.total_;
}

CommonAlignment FindCommonAlignment(const NormalSum& normals) {
  const Matrix7 conflict = normals.conflict() / normals.total();
  const SymmetricEigen eigen = DecomposeSymmetric(conflict);
  const Octupole lowest = eigen.vectors.col(0);
  CommonAlignment common;
  common.conflict = eigen.values[0];
  const std::optional<Eigen::Vector3d> axis = FindLine(normals.spread());
  if (axis && IsOnlyAxis(*axis, conflict, lowest)) {
    common.axis = axis;
  } else if (eigen.values[0] < kMaxConflict) {
    const Eigen::Matrix3d frame = NearestFrame<3>(lowest);
    if (lowest.dot(HarmonicFromFrame<3>(frame)) >= kMinFrameFit) common.frame = frame;
  }
  return common;
}

std::optional<Eigen::Vector3d> FindLine(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions) sum += d * d.transpose();
  return FindLine(sum);
}

std::optional<Eigen::Vector3d> FindSmoothNormal(const NormalSum& normals, double angle_deg) {
  const double cosine = std::cos(angle_deg * M_PI / 360);
  return FindLine(normals.spread(), cosine * cosine);
}

void Count(SurfaceCase surface_case, AlignmentCounts* counts) {
  counts->num_normals += surface_case == SurfaceCase::kNormal;
  counts->num_frames += surface_case == SurfaceCase::kFrame;
  counts->num_tangents += surface_case == SurfaceCase::kTangent;
  counts->num_free += surface_case == SurfaceCase::kFree;
}

SurfaceAlignment AlignToNormals(const std::optional<Eigen::Vector3d>& smooth_normal, const NormalSum& normals,
                                const std::vector<Eigen::Vector3d>& directions) {
  CommonAlignment common;
  if (smooth_normal) {
    if (!directions.empty()) common.frame = FindFrameAbout(*smooth_normal, directions);
  } else if (normals.total() > 0) {
    common = FindCommonAlignment(normals);
  }
  if (common.frame) return {Alignment::Frame(*common.frame), SurfaceCase::kFrame, common.conflict};
  if (smooth_normal) return {Alignment::Axis(*smooth_normal), SurfaceCase::kNormal, common.conflict};
  if (const auto tangent = FindLine(directions))
    return {Alignment::Axis(*tangent), SurfaceCase::kTangent, common.conflict};
  if (common.axis && directions.empty()) return {Alignment::Axis(*common.axis), SurfaceCase::kNormal, common.conflict};
  return {Alignment(), SurfaceCase::kFree, common.conflict};
}

}  // namespace octupole::internal
