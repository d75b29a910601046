#include "octupole/field/field_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/BVH>
#include <utility>

#include "octupole/frames/frame.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/morton_order.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;
using Tree = Eigen::KdBVH<double, 3, int>;

// A barycentric coordinate above this counts as not negative, so that no point falls between two tetrahedra.
constexpr double kLeastCoordinate = -1e-9;

// Up to four vertices and their parts in a mean, which are not negative and add up to one.
struct Mixture {
  std::array<int, 4> vertices = {};
  std::array<double, 4> weights = {};
  int size = 0;
};

// Ericson, Real-Time Collision Detection, 2005, section 5.1.5: the point of a triangle nearest to p.
Vector3d NearestInTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

template <std::size_t kSize>
std::vector<Box> BoxesOf(const std::vector<Vector3d>& points, const std::vector<std::array<int, kSize>>& cells) {
  std::vector<Box> boxes(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const int v : cells[c]) boxes[c].extend(points[v]);
  }
  return boxes;
}

Tree MakeTree(const std::vector<Box>& boxes) {
  std::vector<int> numbers(boxes.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
  return Tree(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

}  // namespace

// What is sampled, and how to find one's way in it.
struct FieldSampler::Trees {
  // The barycentric coordinates of a point in a tetrahedron, if it contains the point.
  bool Contains(int t, const Vector3d& point, Mixture* mixture) const {
    const std::array<int, 4>& tet = tets[t];
    const Vector3d& d = points[tet[3]];
    const Vector3d a = points[tet[0]] - d, b = points[tet[1]] - d, c = points[tet[2]] - d, p = point - d;
    const Vector3d bc = b.cross(c), pa = p.cross(a);
    const double sixfold_volume = a.dot(bc);
    if (sixfold_volume == 0) return false;
    const double x = p.dot(bc) / sixfold_volume, y = -pa.dot(c) / sixfold_volume, z = pa.dot(b) / sixfold_volume;
    const double w = 1 - x - y - z;
    // Written so that a NaN fails, too.
    if (!(x >= kLeastCoordinate && y >= kLeastCoordinate && z >= kLeastCoordinate && w >= kLeastCoordinate)) {
      return false;
    }
    mixture->vertices = tet;
    mixture->weights = {std::max(0., x), std::max(0., y), std::max(0., z), std::max(0., w)};
    mixture->size = 4;
    return true;
  }

  // The tetrahedron that contains a point, or -1.
  int Find(const Vector3d& point, Mixture* mixture) const {
    struct Search {
      // NOLINTNEXTLINE(readability-identifier-naming): Eigen's name, as are those below
      bool intersectVolume(const Box& box) const { return box.contains(*point); }
      bool intersectObject(int t) {  // NOLINT(readability-identifier-naming)
        if (!trees->Contains(t, *point, mixture)) return false;
        found = t;
        return true;
      }
      const Trees* trees;
      const Vector3d* point;
      Mixture* mixture;
      int found = -1;
    } search = {this, &point, mixture};
    Eigen::BVIntersect(tet_tree, search);
    return search.found;
  }

  // The nearest boundary point. `triangle` is one that may be near, and becomes the nearest. Depth first, the nearer of
  // two boxes first: twice as fast as Eigen::BVMinimize, which keeps a heap.
  Mixture NearestOnBoundary(const Vector3d& point, int* triangle) const {
    double least = std::numeric_limits<double>::infinity();
    Mixture nearest;
    const auto look_at = [&](int t) {
      const auto& [a, b, c] = triangles[t];
      const Vector3d x = NearestInTriangle(point, points[a], points[b], points[c]);
      const double distance = (x[0] * points[a] + x[1] * points[b] + x[2] * points[c] - point).squaredNorm();
      if (!(distance < least)) return;  // nor where they overflow
      least = distance;
      nearest = {{a, b, c}, {x[0], x[1], x[2]}, 3};
      *triangle = t;
    };
    look_at(*triangle);
    std::vector<std::pair<double, int>> boxes = {{0, triangle_tree.getRootIndex()}};
    while (!boxes.empty()) {
      const auto [distance, box] = boxes.back();
      boxes.pop_back();
      if (distance >= least) continue;
      Tree::VolumeIterator volume = nullptr, volumes_end = nullptr;
      Tree::ObjectIterator object = nullptr, objects_end = nullptr;
      triangle_tree.getChildren(box, volume, volumes_end, object, objects_end);
      for (; object != objects_end; ++object) look_at(*object);
      const std::size_t first = boxes.size();
      for (; volume != volumes_end; ++volume) {
        boxes.emplace_back(triangle_tree.getVolume(*volume).squaredExteriorDistance(point), *volume);
      }
      std::sort(boxes.begin() + static_cast<std::ptrdiff_t>(first), boxes.end(), std::greater<>());
    }
    return nearest;
  }

  Eigen::Matrix3d FrameOf(const Mixture& mixture) const {
    Hexadecapole mean = Hexadecapole::Zero();
    int heaviest = 0;
    for (int i = 0; i < mixture.size; ++i) {
      mean += mixture.weights[i] * harmonics[mixture.vertices[i]];
      if (mixture.weights[i] > mixture.weights[heaviest]) heaviest = i;
    }
    const Eigen::Matrix3d& guess = frames[mixture.vertices[heaviest]];
    // A vertex itself needs no search, and a mean that cancels has no nearest frame.
    if (mixture.weights[heaviest] > 1 - 1e-12 || mean.isZero(1e-12)) return guess;
    return NearestFrame<4>(mean, guess);
  }

  std::vector<Vector3d> points;
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Eigen::Matrix3d> frames;
  std::vector<Hexadecapole> harmonics;
  Tree tet_tree;
  Tree triangle_tree;
};

FieldSampler::FieldSampler(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  if (mesh.tets.empty()) throw std::invalid_argument("FieldSampler: the mesh has no tetrahedra");
  CheckTetMesh(mesh);
  if (frames.size() != mesh.points.size()) {
    throw std::invalid_argument("FieldSampler: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  auto trees = std::make_unique<Trees>();
  trees->points = mesh.points;
  trees->tets = mesh.tets;
  trees->triangles = BoundaryTriangles(mesh);
  trees->frames = frames;
  trees->harmonics.reserve(frames.size());
  for (const Eigen::Matrix3d& frame : frames) trees->harmonics.push_back(HarmonicFromFrame<4>(frame));
  trees->tet_tree = MakeTree(BoxesOf(mesh.points, mesh.tets));
  trees->triangle_tree = MakeTree(BoxesOf(mesh.points, trees->triangles));
  trees_ = std::move(trees);
}

FieldSampler::~FieldSampler() = default;

FieldSamples FieldSampler::Sample(const std::vector<Vector3d>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    std::ostringstream message;
    message << "FieldSampler: point " << i << " is not finite: [" << points[i].transpose() << "]";
    throw std::invalid_argument(message.str());
  }
  FieldSamples samples;
  samples.frames.resize(points.size());
  samples.is_inside.resize(points.size());
  int tet = -1, triangle = 0;
  // Half the time for points in no order.
  for (const std::size_t i : MortonOrder(points)) {
    Mixture mixture;
    if (tet < 0 || !trees_->Contains(tet, points[i], &mixture)) tet = trees_->Find(points[i], &mixture);
    if (tet < 0) mixture = trees_->NearestOnBoundary(points[i], &triangle);
    samples.frames[i] = trees_->FrameOf(mixture);
    samples.is_inside[i] = tet >= 0;
  }
  return samples;
}

std::vector<Eigen::Matrix3d> TransferFrames(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                                            const std::vector<Vector3d>& points) {
  if (mesh.points == points && frames.size() == points.size()) return frames;
  return FieldSampler(mesh, frames).Sample(points).frames;
}

}  // namespace octupole
