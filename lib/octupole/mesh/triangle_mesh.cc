#include "octupole/mesh/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/mesh/internal/mesh_checks.h"
#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using internal::ForEachDistinct;
using internal::kTriangleEdges;
using internal::Simplex;
using internal::SortedSimplices;

// The corner of the triangle at which its side with these vertices begins: the one after that which it leaves out.
int SideOf(const std::array<int, 3>& triangle, const std::array<int, 2>& edge) {
  int opposite = 0;
  while (triangle[opposite] == edge[0] || triangle[opposite] == edge[1]) ++opposite;
  return (opposite + 1) % 3;
}

}  // namespace

void CheckTriangleMesh(const TriangleMesh& mesh) {
  const internal::MeshChecker checker("CheckTriangleMesh", mesh.points);
  if (mesh.triangles.empty()) checker.Fail("the mesh has no triangles");
  checker.CheckCells("triangle", mesh.triangles);
  checker.CheckFeatures(mesh.feature_edges, mesh.feature_points);
}

std::vector<std::array<int, 2>> MeshEdges(const TriangleMesh& mesh) {
  return internal::DistinctEdges(mesh.triangles, mesh.points.size());
}

std::vector<std::array<int, 2>> OpenEdges(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  const auto visit = [&](const Simplex<2>& edge, int count) {
    if (count != 1) return;
    const std::array<int, 3>& triangle = mesh.triangles[edge.cell];
    const int side = SideOf(triangle, edge.vertices);
    edges.push_back({triangle[side], triangle[(side + 1) % 3]});
  };
  ForEachDistinct(mesh.triangles, kTriangleEdges, mesh.points.size(), visit);
  return edges;
}

std::vector<std::array<int, 3>> FanOfPolygon(const std::vector<Eigen::Vector3d>& points,
                                             const std::vector<int>& polygon) {
  const std::size_t size = polygon.size();
  if (size < 3) {
    throw std::invalid_argument("FanOfPolygon: a polygon of " + std::to_string(size) + " corners");
  }
  const auto fan_from = [&](std::size_t apex) {
    std::vector<std::array<int, 3>> fan;
    for (std::size_t i = 1; i + 1 < size; ++i) {
      fan.push_back({polygon[apex], polygon[(apex + i) % size], polygon[(apex + i + 1) % size]});
    }
    return fan;
  };
  std::vector<std::array<int, 3>> best = fan_from(0);
  if (size == 3) return best;
  const auto area = [&](const std::array<int, 3>& t) -> Eigen::Vector3d {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
  };
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto& triangle : best) normal += area(triangle);
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t apex = 0; apex < size; ++apex) {
    const std::vector<std::array<int, 3>> fan = fan_from(apex);
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& triangle : fan) smallest = std::min(smallest, area(triangle).dot(normal));
    if (smallest <= largest) continue;
    largest = smallest;
    best = fan;
  }
  return best;
}

TriangleMesh BoundarySurface(const TetMesh& mesh) {
  return {mesh.points, BoundaryTriangles(mesh), mesh.feature_edges, mesh.feature_points};
}

ManifoldSurface CutToManifold(const TriangleMesh& mesh) {
  // Corner 3 t + i of triangle t. Those of one fan become a set, kept as a tree.
  std::vector<int> parent(3 * mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int corner) {
    while (parent[corner] != corner) corner = parent[corner] = parent[parent[corner]];
    return corner;
  };
  const std::vector<Simplex<2>> sides = SortedSimplices(mesh.triangles, kTriangleEdges, mesh.points.size());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const auto& side) { return side.vertices != first->vertices; });
    if (last - first == 2) {
      const int t = first[0].cell, u = first[1].cell;
      const int i = SideOf(mesh.triangles[t], first->vertices), j = SideOf(mesh.triangles[u], first->vertices);
      if (mesh.triangles[t][i] != mesh.triangles[u][j]) {
        parent[root(3 * t + i)] = root(3 * u + (j + 1) % 3);
        parent[root(3 * t + (i + 1) % 3)] = root(3 * u + j);
      }
    }
    first = last;
  }

  std::vector<std::pair<int, int>> point_and_root;
  for (int corner = 0; corner < static_cast<int>(parent.size()); ++corner) {
    if (parent[corner] == corner) point_and_root.emplace_back(mesh.triangles[corner / 3][corner % 3], corner);
  }
  std::sort(point_and_root.begin(), point_and_root.end());
  ManifoldSurface surface;
  std::vector<int> vertex_of_root(parent.size());
  for (const auto& [point, corner] : point_and_root) {
    vertex_of_root[corner] = static_cast<int>(surface.points.size());
    surface.points.push_back(point);
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    surface.triangles.push_back(
        {vertex_of_root[root(3 * t)], vertex_of_root[root(3 * t + 1)], vertex_of_root[root(3 * t + 2)]});
  }
  return surface;
}

}  // namespace octupole
