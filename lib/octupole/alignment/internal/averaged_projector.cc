#include "octupole/alignment/internal/averaged_projector.h"

#include <algorithm>

namespace octupole::internal {

NormalSum SumOfNormals(const std::vector<SurfaceCorner>& corners) {
  NormalSum sum;
  for (const SurfaceCorner& corner : corners) sum.Add(corner.normal, corner.angle);
  return sum;
}

Matrix7 AveragedProjector(const std::vector<SurfaceCorner>& corners) {
  const NormalSum sum = SumOfNormals(corners);
  return sum.conflict() / sum.total();
}

std::vector<SurfaceCorner> WithNormal(std::vector<SurfaceCorner> corners) {
  const auto has_none = [](const SurfaceCorner& corner) { return corner.normal.isZero(0); };
  corners.erase(std::remove_if(corners.begin(), corners.end(), has_none), corners.end());
  return corners;
}

}  // namespace octupole::internal
