#include "octupole/field/cross_field.h"

#include <stdexcept>
#include <string>

#include "octupole/mesh/surface_corners.h"

namespace octupole {

std::vector<Eigen::Matrix3d> CrossField(const TriangleMesh& surface, const std::vector<Eigen::Matrix3d>& frames) {
  if (frames.size() != surface.points.size()) {
    throw std::invalid_argument("CrossField: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(surface.points.size()) + " points");
  }
  std::vector<Eigen::Matrix3d> crosses = frames;
  const std::vector<Eigen::Vector3d> normals = VertexNormals(surface.points, surface.triangles);
  for (std::size_t v = 0; v < frames.size(); ++v) {
    if (normals[v].isZero(0)) continue;
    const Eigen::Vector3d cosines = frames[v].transpose() * normals[v];
    int n = 0;
    cosines.cwiseAbs().maxCoeff(&n);
    // Turned about v, when n points the other way.
    const double sign = cosines[n] < 0 ? -1 : 1;
    crosses[v] << sign * frames[v].col((n + 1) % 3), frames[v].col((n + 2) % 3), sign * frames[v].col(n);
  }
  return crosses;
}

}  // namespace octupole
