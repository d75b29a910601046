#include "octupole/distributed/internal/part_alignment.h"

#include <algorithm>
#include <array>
#include <utility>

#include "octupole/distributed/distributed_error.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole::internal {
namespace {

// As FindInterfaces has it.
constexpr double kMinFittingShare = 0.5;

std::array<int, 3> Ascending(std::array<int, 3> triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

// Leaves out tagged triangles that are not on the boundary.
void RemoveInnerTags(const std::vector<std::array<int, 3>>& boundary_triangles, TetMesh* mesh) {
  std::vector<std::array<int, 3>> boundary;
  for (const std::array<int, 3>& triangle : boundary_triangles) boundary.push_back(Ascending(triangle));
  std::sort(boundary.begin(), boundary.end());
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < mesh->surface_triangles.size(); ++i) {
    if (!std::binary_search(boundary.begin(), boundary.end(), Ascending(mesh->surface_triangles[i]))) continue;
    mesh->surface_triangles[num_kept] = mesh->surface_triangles[i];
    mesh->surface_tags[num_kept++] = mesh->surface_tags[i];
  }
  mesh->surface_triangles.resize(num_kept);
  mesh->surface_tags.resize(num_kept);
}

// Settles for all ranks which faces inside are followed: afterwards all that are left in `mesh` are, or none is.
RegionUse SettleInterfaces(MPI_Comm comm, double feature_angle_deg, TetMesh* mesh) {
  std::array<double, 4> sums = {};
  std::vector<std::array<int, 3>> boundary;
  DoTogether(comm, [&] {
    if (mesh->tets.empty()) return;
    boundary = BoundaryTriangles(*mesh);
    const Interfaces interfaces = FindInterfaces(*mesh, boundary, RegionUse::kAutomatic, feature_angle_deg);
    const auto add = [&](const InnerFaces& faces, std::size_t i) {
      sums[i] = static_cast<double>(faces.count);
      sums[i + 1] = sums[i] * faces.fitting_share;
    };
    add(interfaces.between_regions, 0);
    add(interfaces.tagged, 2);
  });
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 4, MPI_DOUBLE, MPI_SUM, comm);
  const bool follow_regions = sums[0] > 0 && sums[1] >= kMinFittingShare * sums[0];
  const bool follow_tagged = sums[2] > 0 && sums[3] >= kMinFittingShare * sums[2];
  if (!follow_regions && !follow_tagged) return RegionUse::kIgnore;
  if (!follow_regions) mesh->regions.clear();
  if (!follow_tagged) RemoveInnerTags(boundary, mesh);
  return RegionUse::kFollow;
}

}  // namespace

BoundaryAlignment AlignPart(MPI_Comm comm, const MeshPart& part, double feature_angle_deg, RegionUse regions) {
  BoundaryOptions options = {feature_angle_deg, regions};
  // What may be interfaces, somewhere.
  int may_have_interfaces =
      regions == RegionUse::kAutomatic && (!part.mesh.regions.empty() || !part.mesh.surface_triangles.empty());
  MPI_Allreduce(MPI_IN_PLACE, &may_have_interfaces, 1, MPI_INT, MPI_MAX, comm);
  TetMesh settled;
  if (may_have_interfaces != 0) {
    settled = part.mesh;
    options.regions = SettleInterfaces(comm, feature_angle_deg, &settled);
  }
  const TetMesh& mesh = may_have_interfaces != 0 ? settled : part.mesh;
  BoundaryAlignment alignment;
  const auto align = [&] {
    if (!mesh.tets.empty()) alignment = AlignToBoundary(mesh, options);
  };
  DoTogether(comm, align);
  int is_marked_somewhere = alignment.has_marked_features;
  MPI_Allreduce(MPI_IN_PLACE, &is_marked_somewhere, 1, MPI_INT, MPI_MAX, comm);
  options.has_marked_features = is_marked_somewhere != 0;
  DoTogether(comm, [&] {
    if (options.has_marked_features != alignment.has_marked_features) align();
  });
  return alignment;
}

}  // namespace octupole::internal
