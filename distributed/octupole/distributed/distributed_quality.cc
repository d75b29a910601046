#include "octupole/distributed/distributed_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "octupole/distributed/distributed_error.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/singularities/singular_triangles.h"

namespace octupole {
namespace {

// Whether the vertex of lowest number is owned.
template <std::size_t kSize>
bool IsCountedHere(const MeshPart& part, const std::array<int, kSize>& simplex) {
  const int first = *std::min_element(simplex.begin(), simplex.end(),
                                      [&](int v, int w) { return part.numbers[v] < part.numbers[w]; });
  return static_cast<std::size_t>(first) < part.num_owned_points;
}

// MeasureField of what is counted on this rank. Of ghosts the part lacks what is around them, but for edges and
// triangles that also have an owned vertex.
FieldQuality MeasureHere(const MeshPart& part, const std::vector<Eigen::Matrix3d>& frames) {
  const TetMesh& mesh = part.mesh;
  if (frames.size() != mesh.points.size()) {
    throw std::invalid_argument("MeasureField: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  FieldQuality quality;
  if (mesh.tets.empty()) return quality;
  for (const std::array<int, 2>& edge : MeshEdges(mesh)) {
    if (!IsCountedHere(part, edge)) continue;
    ++quality.edges;
    quality.energy3 += FrameDifference<3>(frames[edge[0]], frames[edge[1]]);
    quality.energy4 += FrameDifference<4>(frames[edge[0]], frames[edge[1]]);
  }
  for (const SingularTriangle& triangle : FindSingularTriangles(mesh, frames)) {
    if (!IsCountedHere(part, triangle.vertices)) continue;
    ++quality.singular_triangles;
    ++quality.singular_triangles_of_type[static_cast<std::size_t>(triangle.type)];
  }
  const NormalErrors boundary = MeasureNormals(mesh.points, BoundaryTriangles(mesh), frames, part.num_owned_points);
  quality.boundary_rms_deg = boundary.rms_deg;
  quality.boundary_max_deg = boundary.max_deg;
  quality.smooth_boundary_vertices = boundary.smooth_vertices;
  return quality;
}

}  // namespace

FieldQuality MeasureField(MPI_Comm comm, const MeshPart& part, const std::vector<Eigen::Matrix3d>& frames) {
  FieldQuality quality;
  DoTogether(comm, [&] { quality = MeasureHere(part, frames); });
  const auto smooth = static_cast<double>(quality.smooth_boundary_vertices);
  std::array<double, 3> sums = {quality.energy3, quality.energy4,
                                smooth * quality.boundary_rms_deg * quality.boundary_rms_deg};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, &quality.boundary_max_deg, 1, MPI_DOUBLE, MPI_MAX, comm);
  std::array<std::uint64_t, 8> counts = {quality.edges, quality.smooth_boundary_vertices, quality.singular_triangles};
  std::copy(quality.singular_triangles_of_type.begin(), quality.singular_triangles_of_type.end(), counts.begin() + 3);
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), counts.size(), MPI_UINT64_T, MPI_SUM, comm);
  quality.energy3 = sums[0];
  quality.energy4 = sums[1];
  quality.edges = counts[0];
  quality.smooth_boundary_vertices = counts[1];
  quality.boundary_rms_deg = counts[1] == 0 ? 0 : std::sqrt(sums[2] / static_cast<double>(counts[1]));
  quality.singular_triangles = counts[2];
  std::copy(counts.begin() + 3, counts.end(), quality.singular_triangles_of_type.begin());
  return quality;
}

MeshSize SizeOfMesh(MPI_Comm comm, const MeshPart& part) {
  std::array<std::uint64_t, 2> counts = {part.num_owned_points, part.num_owned_tets};
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), counts.size(), MPI_UINT64_T, MPI_SUM, comm);
  return {counts[0], counts[1]};
}

}  // namespace octupole
