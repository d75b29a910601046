#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/alignment/boundary_alignment.h"

namespace octupole::internal {

/// The normals of the surface about a spot, as sums weighted by w: of I - U_n U_n^T, of n n^T and of w itself.
class NormalSum {
 public:
  /// \param normal of unit length.
  void Add(const Eigen::Vector3d& normal, double weight);
  /// Adds `weight` times another sum.
  void Add(const NormalSum& other, double weight);

  const Eigen::Matrix<double, 7, 7>& conflict() const { return conflict_; }
  const Eigen::Matrix3d& spread() const { return spread_; }
  double total() const { return total_; }

 private:
  Eigen::Matrix<double, 7, 7> conflict_ = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix3d spread_ = Eigen::Matrix3d::Zero();
  double total_ = 0;
};

/// What normals have in common, from their averaged projectors (theory.md, section 4).
struct CommonAlignment {
  /// The normals' main axis, when they belong to one.
  std::optional<Eigen::Vector3d> axis;
  /// The frame that meets the normals, when there is one.
  std::optional<Eigen::Matrix3d> frame;
  /// The lowest eigenvalue: 0 where a frame has all of them as axes.
  double conflict = 0;
};
/// \param normals of positive total.
CommonAlignment FindCommonAlignment(const NormalSum& normals);

/// The line on which directions lie up to sign, if there are any and they do.
std::optional<Eigen::Vector3d> FindLine(const std::vector<Eigen::Vector3d>& directions);

/// The main axis of normals that are as near to it as two of equal weight, `angle_deg` apart, are to theirs: those with
/// at least cos^2(angle / 2) of their squared length along it.
std::optional<Eigen::Vector3d> FindSmoothNormal(const NormalSum& normals, double angle_deg);

/// What AlignToSurface finds at a spot.
enum class SurfaceCase : std::uint8_t { kNone, kNormal, kFrame, kTangent, kFree };

void Count(SurfaceCase surface_case, AlignmentCounts* counts);

/// The alignment that a surface asks of a spot on it, and as which case of AlignToSurface.
struct SurfaceAlignment {
  Alignment alignment;
  SurfaceCase is;
  /// CommonAlignment::conflict; 0 where the surface is smooth.
  double conflict;
};
/// \param smooth_normal the mean normal where the surface is smooth.
/// \param normals where it is not.
/// \param directions of the feature edges there, of unit length.
SurfaceAlignment AlignToNormals(const std::optional<Eigen::Vector3d>& smooth_normal, const NormalSum& normals,
                                const std::vector<Eigen::Vector3d>& directions);

}  // namespace octupole::internal
