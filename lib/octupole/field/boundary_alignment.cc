#include "octupole/field/boundary_alignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/field/internal/averaged_projector.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/internal/symmetric_eigen.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/seams.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using internal::DecomposeSymmetric;
using internal::Matrix7;
using internal::SymmetricEigen;
using internal::WithNormal;
using AxisBasis = Eigen::Matrix<double, 7, 2>;

// Above this lowest eigenvalue no frame is near all the normals. The worst even split of a straight edge, normals at
// 48 degrees, has 0.45; the tip of a cone has 0.47 or more.
constexpr double kMaxConflict = 0.46;
// The share of squared length above which an octupole counts as lying in a subspace.
constexpr double kMostly = 0.5;
// The lowest eigenvector counts as a frame when its cosine with its nearest frame's octupole is at least this.
constexpr double kMinFrameFit = 0.9;
// Directions lie on one line when their main direction holds at least this share of their squared lengths: two of
// them 60 degrees apart, or a cone of half-aperture 30 degrees.
constexpr double kMinLineShare = 0.75;

AxisBasis BasisOfAxis(const Eigen::Vector3d& axis) { return AlignedSubspace<3>(Alignment::Axis(axis)).basis; }

// The line on which directions d lie up to sign, if they do, given the sum of d d^T.
std::optional<Eigen::Vector3d> FindLine(const Eigen::Matrix3d& directions) {
  const double total = directions.trace();
  const SymmetricEigen eigen = DecomposeSymmetric(directions);
  if (total == 0 || eigen.values[2] < kMinLineShare * total) return std::nullopt;
  return eigen.vectors.col(2);
}

// Whether the harmonics in which the faces' normals agree best are those with `axis`, however turned about it. If
// turning about it is far from free, it is but one of the axes of a frame.
bool IsOnlyAxis(const Eigen::Vector3d& axis, const Matrix7& conflict, const Octupole& lowest) {
  const AxisBasis basis = BasisOfAxis(axis);
  if ((basis.transpose() * lowest).squaredNorm() < kMostly) return false;
  const Eigen::Vector2d conflicts = DecomposeSymmetric(basis.transpose() * conflict * basis).values;
  return conflicts[0] > kMostly * conflicts[1];
}

// What the normals at a vertex have in common, from the averaged projectors of theory.md, section 4.
struct CommonAlignment {
  /// The normals' main axis, when they belong to one.
  std::optional<Eigen::Vector3d> axis;
  /// The frame that meets the normals, when there is one.
  std::optional<Eigen::Matrix3d> frame;
};

CommonAlignment FindCommonAlignment(const std::vector<SurfaceCorner>& corners) {
  const Matrix7 conflict = internal::AveragedProjector(corners);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const SurfaceCorner& corner : corners) {
    spread += corner.angle * corner.normal * corner.normal.transpose();
  }
  const SymmetricEigen eigen = DecomposeSymmetric(conflict);
  const Octupole lowest = eigen.vectors.col(0);
  CommonAlignment common;
  const std::optional<Eigen::Vector3d> axis = FindLine(spread);
  if (axis && IsOnlyAxis(*axis, conflict, lowest)) {
    common.axis = axis;
  } else if (eigen.values[0] < kMaxConflict) {
    const Eigen::Matrix3d frame = NearestFrame<3>(lowest);
    if (lowest.dot(HarmonicFromFrame<3>(frame)) >= kMinFrameFit) common.frame = frame;
  }
  return common;
}

}  // namespace

std::vector<std::array<int, 2>> SharpEdges(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<std::array<int, 3>>& triangles, double feature_angle_deg,
                                           int min_faces) {
  const double min_cosine = std::cos(feature_angle_deg * M_PI / 180);
  struct Side {
    int a, b;
    Eigen::Vector3d normal;
  };
  std::vector<Side> sides;
  for (const auto& triangle : triangles) {
    const Eigen::Vector3d normal = TriangleNormal(points, triangle);
    // A face of zero area has nothing to compare.
    if (normal.isZero(0)) continue;
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
      sides.push_back({a, b, normal});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& s, const Side& t) { return std::pair(s.a, s.b) < std::pair(t.a, t.b); });
  std::vector<std::array<int, 2>> edges;
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last =
        std::find_if(first, sides.end(), [&](const Side& s) { return s.a != first->a || s.b != first->b; });
    // Where more than two faces meet, any pair makes a feature.
    bool is_feature = false;
    for (auto s = first; s != last; ++s) {
      for (auto t = first; t != s; ++t) {
        is_feature |= s->normal.dot(t->normal) < min_cosine;
      }
    }
    if (is_feature && last - first >= min_faces) edges.push_back({first->a, first->b});
    first = last;
  }
  return edges;
}

namespace {

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

// The frame with the axis `normal` that is nearest to having the directions as axes, all of them together.
std::optional<Eigen::Matrix3d> FindFrameAbout(const Eigen::Vector3d& normal,
                                              const std::vector<Eigen::Vector3d>& directions) {
  const Eigen::Matrix3d basis = Alignment::Axis(normal).frame();
  // Turning a direction by a quarter about the normal leaves its fourth power.
  std::complex<double> sum = 0;
  for (const Eigen::Vector3d& d : directions) {
    sum += std::pow(std::complex<double>(basis.col(0).dot(d), basis.col(1).dot(d)), 4);
  }
  if (std::abs(sum) < kMostly * static_cast<double>(directions.size())) return std::nullopt;
  const double angle = std::arg(sum) / 4;
  return basis * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// The line on which directions lie up to sign, if there are any and they do.
std::optional<Eigen::Vector3d> FindLine(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions) sum += d * d.transpose();
  return FindLine(sum);
}

std::vector<SurfaceCorner> WithEqualWeights(const std::vector<Eigen::Vector3d>& directions) {
  std::vector<SurfaceCorner> corners;
  corners.reserve(directions.size());
  for (const Eigen::Vector3d& direction : directions) corners.push_back({direction, 1});
  return corners;
}

// What AlignToSurface finds at a vertex.
enum class VertexCase { kNone, kNormal, kFrame, kTangent, kFree };

void Count(VertexCase vertex_case, AlignmentCounts* counts) {
  counts->num_normals += vertex_case == VertexCase::kNormal;
  counts->num_frames += vertex_case == VertexCase::kFrame;
  counts->num_tangents += vertex_case == VertexCase::kTangent;
  counts->num_free += vertex_case == VertexCase::kFree;
}

void CheckFeatureAngle(double feature_angle_deg) {
  if (feature_angle_deg > 0 && feature_angle_deg < 180) return;
  std::ostringstream message;
  message << "AlignToSurface: the feature angle must lie between 0 and 180 degrees, not " << feature_angle_deg;
  throw std::invalid_argument(message.str());
}

// AlignToSurface; `cases` become those of the vertices.
BoundaryAlignment AlignVertices(const TriangleMesh& surface, double feature_angle_deg, OpenBoundary open_boundary,
                                std::vector<VertexCase>* cases) {
  const std::vector<Eigen::Vector3d>& points = surface.points;
  const auto corners_of = SurfaceCorners(points, surface.triangles);
  BoundaryAlignment result;
  result.has_marked_features = !surface.feature_edges.empty();
  auto edges =
      result.has_marked_features ? surface.feature_edges : SharpEdges(points, surface.triangles, feature_angle_deg);
  result.num_feature_edges = edges.size();
  if (open_boundary == OpenBoundary::kAligned) {
    const std::vector<std::array<int, 2>> open_edges = OpenEdges(surface);
    edges.insert(edges.end(), open_edges.begin(), open_edges.end());
  }
  const auto directions_of = FeatureDirections(points, edges);

  result.alignments.resize(points.size());
  cases->assign(points.size(), VertexCase::kNone);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const std::vector<Eigen::Vector3d>& directions = directions_of[v];
    const auto prescribe = [&](const Alignment& alignment, VertexCase vertex_case) {
      result.alignments[v] = alignment;
      (*cases)[v] = vertex_case;
    };
    const auto tangent = FindLine(directions);
    if (corners_of[v].empty()) {
      if (directions.empty()) continue;
      if (tangent) {
        prescribe(Alignment::Axis(*tangent), VertexCase::kTangent);
      } else if (const auto frame = FindCommonAlignment(WithEqualWeights(directions)).frame) {
        prescribe(Alignment::Frame(*frame), VertexCase::kFrame);
      } else {
        (*cases)[v] = VertexCase::kFree;
      }
      continue;
    }
    const std::vector<SurfaceCorner> corners = WithNormal(corners_of[v]);
    const Eigen::Vector3d mean_normal = MeanNormal(corners);
    const bool is_smooth = NormalsAgree(corners, feature_angle_deg) && !mean_normal.isZero(0);
    CommonAlignment common;
    if (is_smooth) {
      if (!directions.empty()) common.frame = FindFrameAbout(mean_normal, directions);
    } else if (!corners.empty()) {
      common = FindCommonAlignment(corners);
    }
    if (common.frame) {
      prescribe(Alignment::Frame(*common.frame), VertexCase::kFrame);
    } else if (is_smooth) {
      prescribe(Alignment::Axis(mean_normal), VertexCase::kNormal);
    } else if (tangent) {
      prescribe(Alignment::Axis(*tangent), VertexCase::kTangent);
    } else if (common.axis && directions.empty()) {
      prescribe(Alignment::Axis(*common.axis), VertexCase::kNormal);
    } else {
      (*cases)[v] = VertexCase::kFree;
    }
  }
  for (const VertexCase vertex_case : *cases) Count(vertex_case, &result);
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
  std::vector<VertexCase> cases;
  return AlignVertices(surface, feature_angle_deg, open_boundary, &cases);
}

BoundaryAlignment AlignToBoundary(const TetMesh& mesh, const BoundaryOptions& options) {
  CheckFeatureAngle(options.feature_angle_deg);
  TriangleMesh surface = BoundarySurface(mesh);
  Interfaces interfaces = FindInterfaces(mesh, surface.triangles, options.regions, options.feature_angle_deg);
  surface.triangles.insert(surface.triangles.end(), interfaces.triangles.begin(), interfaces.triangles.end());
  const auto seams = FindSeams(mesh, surface.triangles, options.feature_angle_deg);
  RemoveEdges(seams, &surface.feature_edges);
  if (!interfaces.triangles.empty() && !surface.feature_edges.empty()) {
    AddJunctions(interfaces, options.feature_angle_deg, &surface);
  }
  std::vector<VertexCase> cases;
  BoundaryAlignment result = AlignVertices(surface, options.feature_angle_deg, OpenBoundary::kAligned, &cases);
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
