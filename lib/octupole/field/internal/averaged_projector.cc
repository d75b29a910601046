#include "octupole/field/internal/averaged_projector.h"

#include <algorithm>

#include "octupole/field/alignment.h"

namespace octupole::internal {

Matrix7 AveragedProjector(const std::vector<SurfaceCorner>& corners) {
  Matrix7 sum = Matrix7::Zero();
  double total = 0;
  for (const SurfaceCorner& corner : corners) {
    const Eigen::Matrix<double, 7, 2> basis = AlignedSubspace<3>(Alignment::Axis(corner.normal)).basis;
    sum += corner.angle * (Matrix7::Identity() - basis * basis.transpose());
    total += corner.angle;
  }
  return sum / total;
}

std::vector<SurfaceCorner> WithNormal(std::vector<SurfaceCorner> corners) {
  const auto has_none = [](const SurfaceCorner& corner) { return corner.normal.isZero(0); };
  corners.erase(std::remove_if(corners.begin(), corners.end(), has_none), corners.end());
  return corners;
}

}  // namespace octupole::internal
