#include "octupole/alignment/interfaces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "octupole/alignment/internal/averaged_projector.h"
#include "octupole/frames/internal/symmetric_eigen.h"
#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using internal::ForEachDistinct;
using internal::kTetFaces;
using internal::kTriangleEdges;
using internal::Simplex;
using Triangles = std::vector<std::array<int, 3>>;

// See FindInterfaces.
constexpr double kMaxConflict = 0.25;
constexpr double kMinFittingShare = 0.5;
constexpr std::size_t kMaxSample = 1000;

// The triangles with ascending vertices, in ascending order, each once.
Triangles Sorted(Triangles triangles) {
  for (std::array<int, 3>& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

// Whether a triangle has the edge a, b in this direction.
bool Traverses(const std::array<int, 3>& triangle, const std::array<int, 2>& edge) {
  const auto a = std::find(triangle.begin(), triangle.end(), edge[0]) - triangle.begin();
  return triangle[(a + 1) % 3] == edge[1];
}

// Whether a vertex with these corners is in order.
bool IsInOrder(std::vector<SurfaceCorner> corners, double feature_angle_deg) {
  corners = internal::WithNormal(std::move(corners));
  if (corners.empty()) return false;
  const double min_cosine = std::cos(feature_angle_deg * M_PI / 180);
  bool is_smooth = true;
  for (std::size_t i = 0; i < corners.size() && is_smooth; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      is_smooth = is_smooth && std::abs(corners[i].normal.dot(corners[j].normal)) >= min_cosine;
    }
  }
  return is_smooth || internal::DecomposeSymmetric(internal::AveragedProjector(corners)).values[0] <= kMaxConflict;
}

double FittingShare(const TetMesh& mesh, const Triangles& faces, double feature_angle_deg) {
  const auto corners_of = SurfaceCorners(mesh.points, faces);
  const auto num_vertices = static_cast<std::size_t>(
      std::count_if(corners_of.begin(), corners_of.end(), [](const auto& corners) { return !corners.empty(); }));
  const std::size_t stride = 1 + num_vertices / kMaxSample;
  std::size_t num_seen = 0, num_sampled = 0, num_fitting = 0;
  for (const std::vector<SurfaceCorner>& corners : corners_of) {
    if (corners.empty() || num_seen++ % stride != 0) continue;
    ++num_sampled;
    num_fitting += IsInOrder(corners, feature_angle_deg);
  }
  return static_cast<double>(num_fitting) / static_cast<double>(std::max<std::size_t>(1, num_sampled));
}

// Turns triangles so that neighbours across an edge of exactly two of them are oriented alike.
void Orient(std::size_t num_points, Triangles* triangles) {
  struct Neighbour {
    int triangle;
    std::array<int, 2> edge;
  };
  std::vector<std::vector<Neighbour>> neighbours_of(triangles->size());
  ForEachDistinct(*triangles, kTriangleEdges, num_points, [&](const Simplex<2>& edge, int count) {
    if (count != 2) return;
    const int one = (&edge)[0].cell, other = (&edge)[1].cell;
    neighbours_of[one].push_back({other, edge.vertices});
    neighbours_of[other].push_back({one, edge.vertices});
  });
  std::vector<bool> is_reached(triangles->size(), false);
  std::vector<int> open;
  for (int root = 0; root < static_cast<int>(triangles->size()); ++root) {
    if (is_reached[root]) continue;
    is_reached[root] = true;
    open.push_back(root);
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (const auto& [neighbour, edge] : neighbours_of[t]) {
        if (is_reached[neighbour]) continue;
        is_reached[neighbour] = true;
        std::array<int, 3>& other = (*triangles)[neighbour];
        if (Traverses((*triangles)[t], edge) == Traverses(other, edge)) std::swap(other[1], other[2]);
        open.push_back(neighbour);
      }
    }
  }
}

std::size_t NumRegions(const TetMesh& mesh) {
  std::vector<int> regions = mesh.regions;
  std::sort(regions.begin(), regions.end());
  return static_cast<std::size_t>(std::unique(regions.begin(), regions.end()) - regions.begin());
}

}  // namespace

Interfaces FindInterfaces(const TetMesh& mesh, const std::vector<std::array<int, 3>>& boundary_triangles, RegionUse use,
                          double feature_angle_deg) {
  Interfaces result;
  result.num_regions = NumRegions(mesh);
  if (use == RegionUse::kIgnore) return result;
  Triangles tagged;
  if (!mesh.surface_triangles.empty()) {
    const Triangles all = Sorted(mesh.surface_triangles), boundary = Sorted(boundary_triangles);
    std::set_difference(all.begin(), all.end(), boundary.begin(), boundary.end(), std::back_inserter(tagged));
  }
  // Most meshes end here, without a look at all their faces.
  if (result.num_regions < 2 && tagged.empty()) return result;

  Triangles between_regions, tagged_faces;
  auto next_tagged = tagged.begin();
  const auto visit = [&](const Simplex<3>& face, int count) {
    next_tagged = std::find_if(next_tagged, tagged.end(), [&](const auto& t) { return t >= face.vertices; });
    if (next_tagged != tagged.end() && *next_tagged == face.vertices) tagged_faces.push_back(face.vertices);
    for (int i = 1; i < count && result.num_regions > 1; ++i) {
      if (mesh.regions[(&face)[i].cell] == mesh.regions[face.cell]) continue;
      between_regions.push_back(face.vertices);
      break;
    }
  };
  ForEachDistinct(mesh.tets, kTetFaces, mesh.points.size(), visit);

  const auto judge = [&](const Triangles& faces, InnerFaces* inner) {
    inner->count = faces.size();
    inner->fitting_share = FittingShare(mesh, faces, feature_angle_deg);
    inner->are_followed = !faces.empty() && (use == RegionUse::kFollow || inner->fitting_share >= kMinFittingShare);
    if (inner->are_followed) result.triangles.insert(result.triangles.end(), faces.begin(), faces.end());
  };
  judge(between_regions, &result.between_regions);
  judge(tagged_faces, &result.tagged);
  result.triangles = Sorted(std::move(result.triangles));
  Orient(mesh.points.size(), &result.triangles);
  return result;
}

std::vector<std::string> InterfaceWarnings(const Interfaces& interfaces) {
  std::vector<std::string> warnings;
  const auto warn = [&](const InnerFaces& faces, const std::string& what) {
    if (faces.count == 0 || faces.are_followed) return;
    std::ostringstream warning;
    warning << what << " are taken for no interfaces, being ragged: a frame fits them at "
            << std::floor(100 * faces.fitting_share) << " % of their vertices, less than half";
    warnings.push_back(warning.str());
  };
  warn(interfaces.between_regions, "the " + std::to_string(interfaces.between_regions.count) + " faces between the " +
                                       std::to_string(interfaces.num_regions) + " regions");
  warn(interfaces.tagged, "the " + std::to_string(interfaces.tagged.count) + " tagged triangles inside");
  return warnings;
}

}  // namespace octupole
