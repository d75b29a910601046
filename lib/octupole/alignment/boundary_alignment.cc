#include "octupole/alignment/boundary_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/alignment/internal/averaged_projector.h"
#include "octupole/alignment/internal/spectral_rule.h"
#include "octupole/alignment/sharp_edges.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/seams.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using internal::AlignToNormals;
using internal::Count;
using internal::FindCommonAlignment;
using internal::FindLine;
using internal::NormalSum;
using internal::SumOfNormals;
using internal::SurfaceAlignment;
using internal::SurfaceCase;
using internal::WithNormal;

// For every point, the unit directions of the feature edges there.
std::vector<std::vector<Eigen::Vector3d>> FeatureDirections(const std::vector<Eigen::Vector3d>& points,
                                                            const std::vector<std::array<int, 2>>& edges) {
  std::vector<std::vector<Eigen::Vector3d>> directions(points.size());
  for (const auto& [a, b] : edges) {
    const Eigen::Vector3d direction = (points[b] - points[a]).stableNormalized();
    if (direction.isZero(0)) continue;
    directions[a].push_back(direction);
    directions[b].push_back(direction);
  }
  return directions;
}

NormalSum SumOf(const std::vector<Eigen::Vector3d>& directions) {
  NormalSum sum;
  for (const Eigen::Vector3d& direction : directions) sum.Add(direction, 1);
  return sum;
}

void CheckFeatureAngle(double feature_angle_deg) {
  if (feature_angle_deg > 0 && feature_angle_deg < 180) return;
  std::ostringstream message;
  message << "AlignToSurface: the feature angle must lie between 0 and 180 degrees, not " << feature_angle_deg;
  throw std::invalid_argument(message.str());
}

// AlignToSurface; `cases` become those of the vertices.
BoundaryAlignment AlignVertices(const TriangleMesh& surface, double feature_angle_deg, bool has_marked_features,
                                OpenBoundary open_boundary, std::vector<SurfaceCase>* cases) {
  const std::vector<Eigen::Vector3d>& points = surface.points;
  const auto corners_of = SurfaceCorners(points, surface.triangles);
  BoundaryAlignment result;
  result.has_marked_features = has_marked_features;
  result.feature_edges =
      result.has_marked_features ? surface.feature_edges : SharpEdges(points, surface.triangles, feature_angle_deg);
  auto edges = result.feature_edges;
  if (open_boundary == OpenBoundary::kAligned) {
    const std::vector<std::array<int, 2>> open_edges = OpenEdges(surface);
    edges.insert(edges.end(), open_edges.begin(), open_edges.end());
  }
  const auto directions_of = FeatureDirections(points, edges);

  result.alignments.resize(points.size());
  cases->assign(points.size(), SurfaceCase::kNone);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const std::vector<Eigen::Vector3d>& directions = directions_of[v];
    const auto prescribe = [&](const Alignment& alignment, SurfaceCase vertex_case) {
      result.alignments[v] = alignment;
      (*cases)[v] = vertex_case;
    };
    if (corners_of[v].empty()) {
      if (directions.empty()) continue;
      if (const auto tangent = FindLine(directions)) {
        prescribe(Alignment::Axis(*tangent), SurfaceCase::kTangent);
      } else if (const auto frame = FindCommonAlignment(SumOf(directions)).frame) {
        prescribe(Alignment::Frame(*frame), SurfaceCase::kFrame);
      } else {
        (*cases)[v] = SurfaceCase::kFree;
      }
      continue;
    }
    const std::vector<SurfaceCorner> corners = WithNormal(corners_of[v]);
    const Eigen::Vector3d mean_normal = MeanNormal(corners);
    const bool is_smooth = NormalsAgree(corners, feature_angle_deg) && !mean_normal.isZero(0);
    const SurfaceAlignment aligned = is_smooth ? AlignToNormals(mean_normal, NormalSum(), directions)
                                               : AlignToNormals(std::nullopt, SumOfNormals(corners), directions);
    prescribe(aligned.alignment, aligned.is);
  }
  for (const SurfaceCase vertex_case : *cases) Count(vertex_case, &result);
  return result;
}

void RemoveEdges(const std::vector<std::array<int, 2>>& sorted, std::vector<std::array<int, 2>>* edges) {
  const auto is_in = [&](const std::array<int, 2>& edge) {
    return std::binary_search(sorted.begin(), sorted.end(),
                              std::array{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
  };
  edges->erase(std::remove_if(edges->begin(), edges->end(), is_in), edges->end());
}

// Marks the sharp edges at which an interface meets another or the boundary, as far as they are not.
void AddJunctions(const Interfaces& interfaces, double feature_angle_deg, TriangleMesh* surface) {
  const auto edges_of_interfaces = MeshEdges(TriangleMesh{surface->points, interfaces.triangles});
  auto junctions = SharpEdges(surface->points, surface->triangles, feature_angle_deg, 3);
  const auto is_of_none = [&](const std::array<int, 2>& edge) {
    return !std::binary_search(edges_of_interfaces.begin(), edges_of_interfaces.end(), edge);
  };
  junctions.erase(std::remove_if(junctions.begin(), junctions.end(), is_of_none), junctions.end());
  RemoveEdges(junctions, &surface->feature_edges);
  surface->feature_edges.insert(surface->feature_edges.end(), junctions.begin(), junctions.end());
}

}  // namespace

BoundaryAlignment AlignToSurface(const TriangleMesh& surface, double feature_angle_deg, OpenBoundary open_boundary) {
  CheckFeatureAngle(feature_angle_deg);
  std::vector<SurfaceCase> cases;
  return AlignVertices(surface, feature_angle_deg, !surface.feature_edges.empty(), open_boundary, &cases);
}

BoundaryAlignment AlignToBoundary(const TetMesh& mesh, const BoundaryOptions& options) {
  CheckFeatureAngle(options.feature_angle_deg);
  TriangleMesh surface = BoundarySurface(mesh);
  auto boundary_triangles = surface.triangles;
  Interfaces interfaces = FindInterfaces(mesh, surface.triangles, options.regions, options.feature_angle_deg);
  surface.triangles.insert(surface.triangles.end(), interfaces.triangles.begin(), interfaces.triangles.end());
  const auto seams = FindSeams(mesh, surface.triangles, options.feature_angle_deg);
  RemoveEdges(seams, &surface.feature_edges);
  const bool has_marked_features = options.has_marked_features || !surface.feature_edges.empty();
  if (!interfaces.triangles.empty() && has_marked_features) {
    AddJunctions(interfaces, options.feature_angle_deg, &surface);
  }
  std::vector<SurfaceCase> cases;
  BoundaryAlignment result =
      AlignVertices(surface, options.feature_angle_deg, has_marked_features, OpenBoundary::kAligned, &cases);
  result.boundary_triangles = std::move(boundary_triangles);
  result.num_seam_edges = seams.size();
  std::vector<bool> is_on_interface(mesh.points.size(), false);
  for (const std::array<int, 3>& triangle : interfaces.triangles) {
    for (const int v : triangle) is_on_interface[v] = true;
  }
  for (std::size_t v = 0; v < cases.size(); ++v) {
    if (is_on_interface[v]) Count(cases[v], &result.interface_vertices);
  }
  result.interfaces = std::move(interfaces);
  return result;
}

}  // namespace octupole
