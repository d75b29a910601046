#include "octupole/mesh/mesh_inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using internal::ForEachDistinct;
using internal::Simplex;

/// The magnitude up to which six times a tetrahedron's volume may be rounding error.
double VolumeTolerance(const TetMesh& mesh, const std::array<int, 4>& tet) {
  constexpr double kRelative = 1e-12;
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  double max_squared_length = 0.0;
  double max_coordinate = 0.0;
  for (const auto& [a, b] : internal::kTetEdges) {
    max_squared_length = std::max(max_squared_length, (mesh.points[tet[a]] - mesh.points[tet[b]]).squaredNorm());
  }
  for (const int v : tet) {
    max_coordinate = std::max(max_coordinate, mesh.points[v].cwiseAbs().maxCoeff());
  }
  // An error of the coordinates moves a face of at most this area by a few times that much.
  return max_squared_length * (kRelative * std::sqrt(max_squared_length) + 4.0 * kEpsilon * max_coordinate);
}

void InspectVolumes(const TetMesh& mesh, MeshInspection* result) {
  const std::vector<double> volumes = SixfoldVolumes(mesh);
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    if (std::abs(volumes[t]) <= VolumeTolerance(mesh, mesh.tets[t])) {
      ++result->zero_volume_tets;
    } else if (volumes[t] < 0.0) {
      ++result->inverted_tets;
    }
  }
}

// Doubled ones once.
std::size_t NumMidEdgeNodes(const TetMesh& mesh) {
  std::vector<bool> is_node(mesh.points.size(), false);
  for (const auto& [node, a, b] : mesh.mid_edge_nodes) is_node[node] = true;
  return static_cast<std::size_t>(std::count(is_node.begin(), is_node.end(), true));
}

void InspectVertices(const TetMesh& mesh, MeshInspection* result) {
  // Sets of connected vertices as trees; every vertex without tetrahedra is a set of its own.
  std::vector<int> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<bool> is_used(mesh.points.size(), false);
  const auto root = [&](int v) {
    while (parent[v] != v) {
      v = parent[v] = parent[parent[v]];
    }
    return v;
  };
  for (const std::array<int, 4>& tet : mesh.tets) {
    for (const int v : tet) {
      is_used[v] = true;
      parent[root(v)] = root(tet[0]);
    }
  }
  std::vector<int> used;
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
    if (is_used[v]) {
      used.push_back(v);
      result->components += parent[v] == v;
    }
  }
  result->isolated_vertices = static_cast<int>(mesh.points.size() - used.size() - NumMidEdgeNodes(mesh));

  const auto position = [&](int v) {
    const Eigen::Vector3d& p = mesh.points[v];
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  std::sort(used.begin(), used.end(), [&](int a, int b) { return position(a) < position(b); });
  for (std::size_t i = 1; i < used.size(); ++i) {
    result->duplicate_vertices += position(used[i]) == position(used[i - 1]);
  }
}

void InspectNeighbours(const TetMesh& mesh, MeshInspection* result) {
  const std::size_t num_points = mesh.points.size();
  std::vector<std::array<int, 3>> boundary;
  std::vector<int> tops;
  ForEachDistinct(mesh.tets, internal::kTetFaces, num_points, [&](const Simplex<3>& face, int count) {
    result->overfull_triangles += count > 2;
    if (count == 1) {
      boundary.push_back(face.vertices);
      return;
    }
    // Tetrahedra that repeat another share their three smallest vertices, and the fourth above them.
    tops.clear();
    for (int i = 0; i < count; ++i) {
      const std::array<int, 4>& tet = mesh.tets[(&face + i)->cell];
      const int top = *std::max_element(tet.begin(), tet.end());
      if (top != face.vertices[2]) tops.push_back(top);
    }
    std::sort(tops.begin(), tops.end());
    result->duplicate_tets += static_cast<int>(tops.end() - std::unique(tops.begin(), tops.end()));
  });
  ForEachDistinct(boundary, internal::kTriangleEdges, num_points,
                  [&](const Simplex<2>&, int count) { result->non_manifold_boundary_edges += count != 2; });
}

}  // namespace

MeshInspection InspectMesh(const TetMesh& mesh) {
  MeshInspection result;
  result.tets = static_cast<int>(mesh.tets.size());
  InspectVolumes(mesh, &result);
  InspectVertices(mesh, &result);
  InspectNeighbours(mesh, &result);
  return result;
}

std::vector<std::string> MeshWarnings(const MeshInspection& inspection) {
  std::vector<std::string> warnings;
  const auto warn = [&](int count, const std::string& one, const std::string& several) {
    if (count > 0) {
      warnings.push_back(count == 1 ? "1 " + one : std::to_string(count) + " " + several);
    }
  };
  if (inspection.inverted_tets > 0 && inspection.inverted_tets == inspection.tets) {
    warnings.push_back("all tetrahedra are negatively oriented");
  } else {
    warn(inspection.inverted_tets, "tetrahedron is inverted", "tetrahedra are inverted");
  }
  warn(inspection.zero_volume_tets, "tetrahedron has zero volume", "tetrahedra have zero volume");
  warn(inspection.duplicate_tets, "tetrahedron repeats another", "tetrahedra repeat another");
  warn(inspection.isolated_vertices, "vertex belongs to no tetrahedron", "vertices belong to no tetrahedron");
  warn(inspection.duplicate_vertices, "vertex coincides with another (a crack?)",
       "vertices coincide with another (cracks?)");
  if (inspection.components > 1) {
    warnings.push_back("the mesh has " + std::to_string(inspection.components) + " separate components");
  }
  warn(inspection.overfull_triangles, "triangle belongs to more than two tetrahedra",
       "triangles belong to more than two tetrahedra");
  warn(inspection.non_manifold_boundary_edges, "edge of the boundary is not shared by exactly two of its triangles",
       "edges of the boundary are not shared by exactly two of its triangles");
  return warnings;
}

std::vector<double> MeanRatios(const TetMesh& mesh) {
  std::vector<double> ratios = SixfoldVolumes(mesh);
  for (std::size_t t = 0; t < ratios.size(); ++t) {
    double sum_of_squares = 0;
    for (const auto& [a, b] : internal::kTetEdges) {
      sum_of_squares += (mesh.points[mesh.tets[t][a]] - mesh.points[mesh.tets[t][b]]).squaredNorm();
    }
    const double root = std::cbrt(ratios[t] / 2);
    ratios[t] = sum_of_squares > 0 ? std::copysign(12 * root * root / sum_of_squares, ratios[t]) : 0;
  }
  return ratios;
}

}  // namespace octupole
