#include "octupole/grids/internal/grid_alignment.h"

#include <openvdb/math/Proximity.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "octupole/alignment/internal/spectral_rule.h"
#include "octupole/alignment/sharp_edges.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole::internal {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// Nodes within this distance of the surface are aligned with it.
constexpr double kReach = 0.9;
// Several sheets of the surface agree up to this conflict, that of two normals 19 or 71 degrees apart.
constexpr double kMaxSheetConflict = 0.1;

// Calls visit(node, weight) for the nodes within reach of a point.
template <typename Visit>
void VisitNodes(const Vector3d& x, const NodeAt& node_at, const Visit& visit) {
  const Vector3i low = (x.array() - kReach).ceil().cast<int>();
  const Vector3i high = (x.array() + kReach).floor().cast<int>();
  for (int i = low.x(); i <= high.x(); ++i) {
    for (int j = low.y(); j <= high.y(); ++j) {
      for (int k = low.z(); k <= high.z(); ++k) {
        const Vector3i p(i, j, k);
        const double distance = (p.cast<double>() - x).norm();
        if (distance >= kReach) continue;
        if (const int node = node_at(p); node >= 0) visit(node, 1 - distance / kReach);
      }
    }
  }
}

// The sum of the normals at each node near the surface.
struct NearbyNormals {
  std::vector<int> nodes;
  std::vector<NormalSum> sums;
};

std::array<Vector3d, 3> CornersOf(const std::vector<Vector3d>& points, const std::array<int, 3>& triangle) {
  return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
}

class NormalSummation {
 public:
  NormalSummation(const NodeAt& node_at, std::size_t num_nodes)
      : node_at_(node_at), places_(num_nodes, -1), weights_(num_nodes, 0) {}

  // Samples of one triangle come near the same nodes again and again: their weights are added up first.
  void Add(const std::array<Vector3d, 3>& corners, const Vector3d& normal) {
    SampleTriangle(corners, kSampleSpacing, [&](const Vector3d& x, double area) {
      VisitNodes(x, node_at_, [&](int node, double weight) {
        if (weights_[node] == 0) nodes_.push_back(node);
        weights_[node] += area * weight;
      });
    });
    NormalSum of_triangle;
    of_triangle.Add(normal, 1);
    for (const int node : nodes_) {
      int& place = places_[node];
      if (place < 0) {
        place = static_cast<int>(result_.sums.size());
        result_.nodes.push_back(node);
        result_.sums.emplace_back();
      }
      result_.sums[place].Add(of_triangle, weights_[node]);
      weights_[node] = 0;
    }
    nodes_.clear();
  }

  NearbyNormals result() && { return std::move(result_); }

 private:
  const NodeAt& node_at_;
  NearbyNormals result_;
  // Of a node, its place among the sums, or -1.
  std::vector<int> places_;
  // Of the triangle at work: the nodes near it, and of each node the weight.
  std::vector<int> nodes_;
  std::vector<double> weights_;
};

NearbyNormals SumNormals(const std::vector<Vector3d>& points, const std::vector<std::array<int, 3>>& triangles,
                         const NodeAt& node_at, std::size_t num_nodes) {
  NormalSummation summation(node_at, num_nodes);
  for (const auto& triangle : triangles) {
    const Vector3d normal = TriangleNormal(points, triangle);
    if (!normal.isZero(0)) summation.Add(CornersOf(points, triangle), normal);
  }
  return std::move(summation).result();
}

// Of each node near an edge, the directions of those edges.
std::unordered_map<int, std::vector<Vector3d>> EdgeDirections(const std::vector<Vector3d>& points,
                                                              const std::vector<std::array<int, 2>>& edges,
                                                              const NodeAt& node_at) {
  std::unordered_map<int, std::vector<Vector3d>> directions_of;
  for (const auto& [a, b] : edges) {
    const Vector3d step = points[b] - points[a];
    const Vector3d direction = step.stableNormalized();
    if (direction.isZero(0)) continue;
    const int num_samples = static_cast<int>(std::ceil(step.norm() / kSampleSpacing));
    std::vector<int> nodes;
    for (int i = 0; i < num_samples; ++i) {
      VisitNodes(points[a] + (i + 0.5) / num_samples * step, node_at, [&](int node, double) { nodes.push_back(node); });
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const int node : nodes) directions_of[node].push_back(direction);
  }
  return directions_of;
}

// Where the surface comes near a node, and with which of its triangles.
struct NearbySample {
  int triangle;
  Vector3d point;
};

// Of some nodes, all samples of the surface near them.
std::unordered_map<int, std::vector<NearbySample>> CollectSamples(const std::vector<Vector3d>& points,
                                                                  const std::vector<std::array<int, 3>>& triangles,
                                                                  const std::unordered_map<int, std::size_t>& nodes,
                                                                  const NodeAt& node_at) {
  std::unordered_map<int, std::vector<NearbySample>> samples_of;
  for (const auto& [node, place] : nodes) samples_of[node];
  if (nodes.empty()) return samples_of;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (TriangleNormal(points, triangles[t]).isZero(0)) continue;
    SampleTriangle(CornersOf(points, triangles[t]), kSampleSpacing, [&](const Vector3d& x, double) {
      VisitNodes(x, node_at, [&](int node, double) {
        const auto found = samples_of.find(node);
        if (found != samples_of.end()) found->second.push_back({static_cast<int>(t), x});
      });
    });
  }
  return samples_of;
}

double DistanceToTriangle(const std::array<Vector3d, 3>& corners, const Vector3d& x) {
  const auto to_vdb = [](const Vector3d& p) { return openvdb::Vec3d(p.x(), p.y(), p.z()); };
  openvdb::Vec3d barycentric;
  const openvdb::Vec3d nearest = openvdb::math::closestPointOnTriangleToPoint(
      to_vdb(corners[0]), to_vdb(corners[1]), to_vdb(corners[2]), to_vdb(x), barycentric);
  return (nearest - to_vdb(x)).length();
}

// Of each sample, a corner that stands for its sheet: triangles belong to one if they are joined by common corners,
// near the node.
std::vector<int> SheetsOf(const std::vector<std::array<int, 3>>& triangles, const std::vector<NearbySample>& samples) {
  std::unordered_map<int, int> parent;
  const auto sheet_of = [&](int v) {
    while (true) {
      const int up = parent.try_emplace(v, v).first->second;
      if (up == v) return v;
      v = up;
    }
  };
  for (const NearbySample& sample : samples) {
    const auto& [a, b, c] = triangles[sample.triangle];
    parent[sheet_of(b)] = sheet_of(a);
    parent[sheet_of(c)] = sheet_of(a);
  }
  std::vector<int> sheets;
  sheets.reserve(samples.size());
  for (const NearbySample& sample : samples) sheets.push_back(sheet_of(triangles[sample.triangle][0]));
  return sheets;
}

// The least distance between two sheets of the surface near a node, or `bound` if it is no less; nothing if there is
// only one sheet.
std::optional<double> DistanceBetweenSheets(const std::vector<Vector3d>& points,
                                            const std::vector<std::array<int, 3>>& triangles,
                                            const std::vector<NearbySample>& samples, double bound) {
  const std::vector<int> sheets = SheetsOf(triangles, samples);
  if (std::all_of(sheets.begin(), sheets.end(), [&](int sheet) { return sheet == sheets[0]; })) return std::nullopt;
  std::vector<double> radii;  // of the triangles, about their samples
  radii.reserve(samples.size());
  for (const NearbySample& sample : samples) {
    double radius = 0;
    for (const Vector3d& corner : CornersOf(points, triangles[sample.triangle])) {
      radius = std::max(radius, (corner - sample.point).norm());
    }
    radii.push_back(radius);
  }
  // As many as a few sheets have; where thousands of triangles meet in one cell, every so many of them.
  constexpr std::size_t kManySamples = 200;
  const std::size_t step = 1 + samples.size() / kManySamples;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    for (std::size_t j = 0; j < samples.size(); ++j) {
      if (sheets[i] == sheets[j] || (samples[i].point - samples[j].point).norm() - radii[j] >= bound) continue;
      bound = std::min(bound, DistanceToTriangle(CornersOf(points, triangles[samples[j].triangle]), samples[i].point));
    }
  }
  return bound;
}

}  // namespace

void SampleTriangle(const std::array<Vector3d, 3>& corners, double spacing, const SurfaceSample& sample) {
  std::vector<std::array<Vector3d, 3>> parts = {corners};
  double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  std::vector<double> areas = {area};
  while (!parts.empty()) {
    const auto [a, b, c] = parts.back();
    area = areas.back();
    parts.pop_back();
    areas.pop_back();
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    if (std::max({ab, bc, ca}) <= spacing * spacing) {
      sample((a + b + c) / 3, area);
      continue;
    }
    // Halves, across the longest side.
    const auto halve = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
      const Vector3d middle = (p + q) / 2;
      parts.push_back({p, middle, r});
      parts.push_back({middle, q, r});
    };
    if (ab >= bc && ab >= ca) {
      halve(a, b, c);
    } else if (bc >= ca) {
      halve(b, c, a);
    } else {
      halve(c, a, b);
    }
    areas.insert(areas.end(), 2, area / 2);
  }
}

GridAlignment AlignGrid(const TriangleMesh& surface, const std::vector<Vector3d>& points, double feature_angle_deg,
                        const NodeAt& node_at, std::vector<Alignment>* alignments) {
  GridAlignment result;
  result.has_marked_features = !surface.feature_edges.empty();
  const std::vector<std::array<int, 2>> edges =
      result.has_marked_features ? surface.feature_edges : SharpEdges(points, surface.triangles, feature_angle_deg);
  result.num_feature_edges = edges.size();
  const NearbyNormals nearby = SumNormals(points, surface.triangles, node_at, alignments->size());
  const auto directions_of = EdgeDirections(points, edges, node_at);
  const std::vector<Vector3d> no_directions;
  std::vector<SurfaceCase> cases;
  std::unordered_map<int, std::size_t> doubtful;  // nodes, with the places of their cases
  for (std::size_t i = 0; i < nearby.nodes.size(); ++i) {
    const int node = nearby.nodes[i];
    const auto found = directions_of.find(node);
    const std::optional<Vector3d> smooth_normal = FindSmoothNormal(nearby.sums[i], feature_angle_deg);
    // As on a mesh, an edge that is not marked does not align the smooth surface beside it.
    const bool has_directions =
        found != directions_of.end() && (result.has_marked_features || !smooth_normal.has_value());
    const SurfaceAlignment aligned =
        AlignToNormals(smooth_normal, nearby.sums[i], has_directions ? found->second : no_directions);
    (*alignments)[node] = aligned.alignment;
    cases.push_back(aligned.is);
    if (aligned.conflict > kMaxSheetConflict) doubtful[node] = i;
  }
  // An edge is the surface's own; sheets that happen to be near are not to be met halfway.
  double least_distance = std::numeric_limits<double>::infinity();
  for (const auto& [node, samples] : CollectSamples(points, surface.triangles, doubtful, node_at)) {
    const std::optional<double> distance = DistanceBetweenSheets(points, surface.triangles, samples, least_distance);
    if (!distance) continue;
    (*alignments)[node] = Alignment();
    cases[doubtful.at(node)] = SurfaceCase::kFree;
    ++result.num_conflicts;
    if (*distance > 0) least_distance = *distance;  // at 0 they touch, and no size separates them
  }
  if (std::isfinite(least_distance)) result.separating_size = least_distance / (2 * kReach);
  for (const SurfaceCase surface_case : cases) Count(surface_case, &result);
  return result;
}

}  // namespace octupole::internal
