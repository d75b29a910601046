#include "octupole/mesh/mesh_topology.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "octupole/mesh/internal/sorted_simplices.h"

namespace octupole {
namespace {

using internal::DistinctVertices;
using internal::ForEachDistinct;
using internal::kTetFaces;
using internal::Simplex;

double SixfoldVolume(const TetMesh& mesh, const std::array<int, 4>& tet) {
  const Eigen::Vector3d& a = mesh.points[tet[0]];
  return (mesh.points[tet[1]] - a).cross(mesh.points[tet[2]] - a).dot(mesh.points[tet[3]] - a);
}

/// The face of a tetrahedron with the given ascending vertices, turned outward.
std::array<int, 3> OutwardFace(const TetMesh& mesh, const Simplex<3>& face) {
  // In a tetrahedron of positive volume these corners turn outward.
  constexpr std::array<std::array<int, 3>, 4> kOutwardFaces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const std::array<int, 4>& tet = mesh.tets[face.cell];
  std::array<int, 3> triangle;
  for (const std::array<int, 3>& corners : kOutwardFaces) {
    triangle = {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
    if (std::is_permutation(triangle.begin(), triangle.end(), face.vertices.begin())) {
      break;
    }
  }
  if (SixfoldVolume(mesh, tet) < 0.0) {
    std::swap(triangle[1], triangle[2]);
  }
  return triangle;
}

}  // namespace

std::vector<std::array<int, 2>> MeshEdges(const TetMesh& mesh) {
  return internal::DistinctEdges(mesh.tets, mesh.points.size());
}

std::vector<std::array<int, 3>> MeshTriangles(const TetMesh& mesh) {
  return DistinctVertices(mesh.tets, kTetFaces, mesh.points.size());
}

std::vector<std::array<int, 3>> BoundaryTriangles(const TetMesh& mesh) {
  std::vector<std::array<int, 3>> boundary;
  ForEachDistinct(mesh.tets, kTetFaces, mesh.points.size(), [&](const Simplex<3>& face, int count) {
    if (count == 1) {
      boundary.push_back(OutwardFace(mesh, face));
    }
  });
  return boundary;
}

std::vector<double> SixfoldVolumes(const TetMesh& mesh) {
  std::vector<double> volumes;
  volumes.reserve(mesh.tets.size());
  for (const std::array<int, 4>& tet : mesh.tets) {
    volumes.push_back(SixfoldVolume(mesh, tet));
  }
  return volumes;
}

}  // namespace octupole
