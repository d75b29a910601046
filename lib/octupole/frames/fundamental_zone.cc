#include "octupole/frames/fundamental_zone.h"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

[[noreturn]] void Refuse(const char* complaint, const Eigen::Vector3d& r) {
  std::ostringstream message;
  message << complaint << ": [" << r.transpose() << "]";
  throw std::invalid_argument(message.str());
}

std::vector<ZoneFace> MakeFaces(SymmetryGroup group) {
  std::vector<ZoneFace> faces;
  for (const OctahedralRotation& g : OctahedralGroup()) {
    if (group == SymmetryGroup::kTetrahedral && !g.IsEven()) continue;
    // The vectors nearer to the identity than to g. The faces of half turns lie outside the others.
    const Eigen::AngleAxisd turn(g.matrix());
    if (turn.angle() < 0.1 || turn.angle() > 3) continue;
    const Eigen::Matrix3d inverse = g.matrix().transpose();
    for (const OctahedralRotation& crossing : OctahedralGroup()) {
      if (crossing.matrix() == inverse) faces.push_back({turn.axis(), std::tan(turn.angle() / 4), crossing});
    }
  }
  return faces;
}

}  // namespace

Eigen::Vector3d RodriguesFromRotation(const Eigen::Matrix3d& rotation) {
  CheckRotation("RodriguesFromRotation", rotation);
  const Eigen::Quaterniond q(rotation);
  if (std::abs(q.w()) < 1e-12) Refuse("RodriguesFromRotation: a half turn about", q.vec());
  return q.vec() / q.w();
}

Eigen::Matrix3d RotationFromRodrigues(const Eigen::Vector3d& r) {
  if (!r.allFinite()) Refuse("RotationFromRodrigues: not finite", r);
  // Scaled against overflow.
  const double scale = std::max(1., r.cwiseAbs().maxCoeff());
  const Eigen::Vector3d v = r / scale;
  return Eigen::Quaterniond(1 / scale, v[0], v[1], v[2]).normalized().toRotationMatrix();
}

Eigen::Matrix3d ReduceToZone(const Eigen::Matrix3d& rotation, SymmetryGroup group) {
  CheckRotation("ReduceToZone", rotation);
  Eigen::Matrix3d smallest = rotation;
  for (const OctahedralRotation& g : OctahedralGroup()) {
    if (group == SymmetryGroup::kTetrahedral && !g.IsEven()) continue;
    const Eigen::Matrix3d product = rotation * g.matrix();
    if (product.trace() > smallest.trace()) smallest = product;
  }
  return smallest;
}

double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, SymmetryGroup group) {
  CheckRotation("AngleBetween", a);
  CheckRotation("AngleBetween", b);
  // Of the products a^T b g the trace is as good as of (b g) a^T, the rotation that takes a to b g.
  return Eigen::AngleAxisd(ReduceToZone(a.transpose() * b, group)).angle();
}

const std::vector<ZoneFace>& ZoneFaces(SymmetryGroup group) {
  static const std::vector<ZoneFace> tetrahedral = MakeFaces(SymmetryGroup::kTetrahedral);
  static const std::vector<ZoneFace> octahedral = MakeFaces(SymmetryGroup::kOctahedral);
  return group == SymmetryGroup::kTetrahedral ? tetrahedral : octahedral;
}

bool IsInZone(const Eigen::Vector3d& r, SymmetryGroup group, double tolerance) {
  for (const ZoneFace& face : ZoneFaces(group)) {
    // Written so that a NaN is outside.
    if (!(face.normal.dot(r) <= face.distance + tolerance)) return false;
  }
  return true;
}

Eigen::Vector3d GluedPoint(const Eigen::Vector3d& r, const ZoneFace& face) {
  // Written so that a NaN fails, too.
  if (!(std::abs(face.normal.dot(r) - face.distance) <= 1e-6)) Refuse("GluedPoint: not on the face", r);
  return RodriguesFromRotation(RotationFromRodrigues(r) * face.crossing.matrix());
}

}  // namespace octupole
