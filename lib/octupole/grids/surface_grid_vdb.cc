#include "octupole/grids/surface_grid_vdb.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "octupole/io/atomic_file.h"

namespace octupole {

void WriteGridVdb(const std::filesystem::path& path, const SurfaceGrid& grid,
                  const std::vector<Eigen::Matrix3d>& frames) {
  if (frames.size() != grid.points.size()) {
    throw std::invalid_argument("WriteGridVdb: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(grid.points.size()) + " nodes");
  }
  openvdb::initialize();
  const Eigen::Vector3d origin = grid.points.empty() ? Eigen::Vector3d::Zero() : grid.points[0];
  const auto transform = openvdb::math::Transform::createLinearTransform(grid.size);
  transform->postTranslate(openvdb::Vec3d(origin.x(), origin.y(), origin.z()));

  const auto distance = openvdb::FloatGrid::create();
  distance->setName("distance");
  std::array<openvdb::Vec3SGrid::Ptr, 3> axes;
  for (int k = 0; k < 3; ++k) {
    axes[k] = openvdb::Vec3SGrid::create();
    axes[k]->setName(std::string("frame_") + "xyz"[k]);
    axes[k]->setVectorType(openvdb::VEC_COVARIANT_NORMALIZE);
  }
  auto distance_at = distance->getAccessor();
  std::array<openvdb::Vec3SGrid::Accessor, 3> axis_at = {axes[0]->getAccessor(), axes[1]->getAccessor(),
                                                         axes[2]->getAccessor()};
  for (std::size_t v = 0; v < grid.points.size(); ++v) {
    const Eigen::Vector3d place = (grid.points[v] - origin) / grid.size;
    const openvdb::Coord voxel = openvdb::Coord::round(openvdb::Vec3d(place.x(), place.y(), place.z()));
    distance_at.setValue(voxel, grid.distances[v]);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f axis = frames[v].col(k).cast<float>();
      axis_at[k].setValue(voxel, openvdb::Vec3s(axis.x(), axis.y(), axis.z()));
    }
  }
  openvdb::GridPtrVec grids = {distance, axes[0], axes[1], axes[2]};
  for (const auto& each : grids) each->setTransform(transform);
  WriteFileAtomically(path, [&](std::ostream& out) { openvdb::io::Stream(out).write(grids); });
}

}  // namespace octupole
