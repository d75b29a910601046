#include "octupole/field/mesh_summary.h"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/seams.h"

namespace octupole {

MeshSummary SummarizeMesh(const TetMesh& mesh) {
  MeshSummary summary;
  summary.vertices = mesh.points.size();
  summary.edges = MeshEdges(mesh).size();
  summary.triangles = MeshTriangles(mesh).size();
  for (const Eigen::Vector3d& point : mesh.points) summary.bounding_box.extend(point);
  for (const int region : mesh.regions) ++summary.tets_of_region[region];
  summary.inspection = InspectMesh(mesh);

  const auto boundary = BoundaryTriangles(mesh);
  summary.boundary_triangles = boundary.size();
  // The topology of the shells does not depend on the frames, so that a constant field will do.
  const std::vector<Eigen::Matrix3d> constant(mesh.points.size(), Eigen::Matrix3d::Identity());
  summary.shells = FindSurfaceSingularities(mesh.points, boundary, constant).components;
  summary.interfaces = FindInterfaces(mesh, boundary);
  auto surface = boundary;
  surface.insert(surface.end(), summary.interfaces.triangles.begin(), summary.interfaces.triangles.end());
  summary.seams = FindSeams(mesh, surface).size();
  summary.sharp_edges = AlignToSurface({mesh.points, boundary}).feature_edges.size();

  const std::vector<double> ratios = MeanRatios(mesh);
  const auto [least, largest] = std::minmax_element(ratios.begin(), ratios.end());
  summary.least_mean_ratio = *least;
  summary.average_mean_ratio = std::accumulate(ratios.begin(), ratios.end(), 0.) / static_cast<double>(ratios.size());
  summary.largest_mean_ratio = *largest;
  return summary;
}

}  // namespace octupole
