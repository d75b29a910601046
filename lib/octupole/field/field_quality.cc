#include "octupole/field/field_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

constexpr double kSmoothAngleDeg = 35;

void CheckFrames(const char* caller, const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Matrix3d>& frames) {
  if (frames.size() == points.size()) return;
  std::ostringstream message;
  message << caller << ": " << frames.size() << " frames for " << points.size() << " points";
  throw std::invalid_argument(message.str());
}

}  // namespace

NormalErrors MeasureNormals(const std::vector<Eigen::Vector3d>& points,
                            const std::vector<std::array<int, 3>>& triangles,
                            const std::vector<Eigen::Matrix3d>& frames, std::optional<std::size_t> num_measured) {
  CheckFrames("MeasureNormals", points, frames);
  const auto corners_of = SurfaceCorners(points, triangles);
  NormalErrors errors;
  double sum_of_squares = 0;
  for (std::size_t v = 0; v < num_measured.value_or(points.size()); ++v) {
    if (corners_of[v].empty() || !NormalsAgree(corners_of[v], kSmoothAngleDeg)) continue;
    const Eigen::Vector3d normal = MeanNormal(corners_of[v]);
    double angle = M_PI;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = frames[v].col(k);
      angle = std::min(angle, std::atan2(axis.cross(normal).norm(), std::abs(axis.dot(normal))));
    }
    angle *= 180 / M_PI;
    sum_of_squares += angle * angle;
    errors.max_deg = std::max(errors.max_deg, angle);
    ++errors.smooth_vertices;
  }
  if (errors.smooth_vertices > 0) {
    errors.rms_deg = std::sqrt(sum_of_squares / static_cast<double>(errors.smooth_vertices));
  }
  return errors;
}

FieldQuality MeasureField(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  CheckFrames("MeasureField", mesh.points, frames);
  return MeasureField(mesh, frames, FindSingularTriangles(mesh, frames), BoundaryTriangles(mesh));
}

FieldQuality MeasureField(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                          const std::vector<SingularTriangle>& singular_triangles,
                          const std::vector<std::array<int, 3>>& boundary_triangles) {
  CheckFrames("MeasureField", mesh.points, frames);
  FieldQuality quality;
  for (const auto& [a, b] : MeshEdges(mesh)) {
    ++quality.edges;
    quality.energy3 += FrameDifference<3>(frames[a], frames[b]);
    quality.energy4 += FrameDifference<4>(frames[a], frames[b]);
  }
  for (const SingularTriangle& triangle : singular_triangles) {
    ++quality.singular_triangles;
    ++quality.singular_triangles_of_type[static_cast<std::size_t>(triangle.type)];
  }
  const NormalErrors boundary = MeasureNormals(mesh.points, boundary_triangles, frames);
  quality.boundary_rms_deg = boundary.rms_deg;
  quality.boundary_max_deg = boundary.max_deg;
  quality.smooth_boundary_vertices = boundary.smooth_vertices;
  return quality;
}

template <int kDegree>
double SmoothnessOfFrames(const std::vector<WeightedEdge>& edges, const std::vector<Eigen::Matrix3d>& frames) {
  double energy = 0;
  for (const auto& [a, b, weight] : edges) energy += weight * FrameDifference<kDegree>(frames[a], frames[b]);
  return energy;
}

double FiniteElementEnergy(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  CheckFrames("FiniteElementEnergy", mesh.points, frames);
  const std::vector<Alignment> none(mesh.points.size());
  return SmoothnessOfFrames<4>(MakeFieldGraph(mesh, none, EdgeWeights::kFiniteElement).edges, frames);
}

std::vector<double> MeanDifferences(const std::vector<std::array<int, 2>>& edges,
                                    const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<double> means(frames.size(), 0);
  std::vector<int> counts(frames.size(), 0);
  for (const auto& [a, b] : edges) {
    const double difference = FrameDifference<3>(frames[a], frames[b]);
    for (const int v : {a, b}) {
      means[v] += difference;
      ++counts[v];
    }
  }
  for (std::size_t v = 0; v < means.size(); ++v) means[v] /= std::max(counts[v], 1);
  return means;
}

template double SmoothnessOfFrames<3>(const std::vector<WeightedEdge>&, const std::vector<Eigen::Matrix3d>&);
template double SmoothnessOfFrames<4>(const std::vector<WeightedEdge>&, const std::vector<Eigen::Matrix3d>&);

}  // namespace octupole
