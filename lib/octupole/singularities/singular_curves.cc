#include "octupole/singularities/singular_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A curve's valence is defined when the axis of the turn is nearer to its direction than to the directions across.
constexpr double kMinMeanCosine = 0.7;

// How the frame turns on its way around a triangle, from its first vertex to the second to the third.
struct Turn {
  /// The axis, by the right hand, of unit length.
  Vector3d axis;
  /// Where its centre is.
  Vector3d point;
};

// The rotation vector that takes one frame to the nearest copy of the other.
Vector3d RotationVector(const Matrix3d& from, const Matrix3d& to) {
  const Eigen::AngleAxisd turn(to * (from * MatchFrames(from, to).matrix()).transpose());
  return turn.angle() * turn.axis();
}

Turn MeasureTurn(const std::array<Vector3d, 3>& points, const std::array<const Matrix3d*, 3>& frames) {
  // Rotations from vertex i to the next. Together they make the turn.
  std::array<Vector3d, 3> rotations;
  for (int i = 0; i < 3; ++i) rotations[i] = RotationVector(*frames[i], *frames[(i + 1) % 3]);
  const Vector3d whole = rotations[0] + rotations[1] + rotations[2];
  Turn turn;
  turn.axis = whole.stableNormalized();
  // With the angles scaled so that they sum to 2 pi, the vectors (cos, sin) of the angle at the vertices, interpolated,
  // vanish at the point whose weights are the sines of the angles between the other two.
  turn.point = Vector3d::Zero();
  double total = 0;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * M_PI * rotations[(i + 1) % 3].dot(whole) / whole.squaredNorm();
    const double weight = std::max(0., std::sin(std::clamp(angle, 0., M_PI)));
    turn.point += weight * points[i];
    total += weight;
  }
  turn.point = total > 1e-3 ? Vector3d(turn.point / total) : Vector3d((points[0] + points[1] + points[2]) / 3);
  return turn;
}

// A triangle as a face of a tetrahedron.
struct CurvePassage {
  int tet;
  int triangle;
  bool is_done;
};

// A triangle on a curve. The directions, 1 or -1, are such that the curve crosses all triangles alike, from below or
// from above as their vertices turn by the right hand, but for those of direction -1.
struct Crossing {
  int triangle;
  int direction;
};

// One way from a triangle along its curve.
struct Walk {
  std::vector<Crossing> crossings;
  CurveEnd end;
  std::optional<Vector3d> node;
};

class Tracer {
 public:
  Tracer(const TetMesh& mesh, const std::vector<Matrix3d>& frames, const std::vector<SingularTriangle>& triangles)
      : mesh_(mesh), triangles_(triangles) {
    turns_.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i].vertices;
      turns_.push_back(
          MeasureTurn({mesh.points[a], mesh.points[b], mesh.points[c]}, {&frames[a], &frames[b], &frames[c]}));
      for (const int tet : triangles[i].tets) passages_.push_back({tet, static_cast<int>(i), false});
    }
    std::sort(passages_.begin(), passages_.end(), IsBefore);
    for (std::size_t p = 0; p < passages_.size(); ++p) {
      if (!passages_[p].is_done) TraceFrom(p);
    }
    AddNodes();
  }

  SingularCurves result() && { return std::move(result_); }

 private:
  static bool IsBefore(const CurvePassage& p, const CurvePassage& q) {
    return std::pair(p.tet, p.triangle) < std::pair(q.tet, q.triangle);
  }

  std::size_t FindPassage(int tet, int triangle) const {
    return std::lower_bound(passages_.begin(), passages_.end(), CurvePassage{tet, triangle, false}, IsBefore) -
           passages_.begin();
  }

  // The passages of a tetrahedron, from the first to that before the second.
  std::pair<std::size_t, std::size_t> PassagesOfTet(std::size_t passage) const {
    const int tet = passages_[passage].tet;
    std::size_t first = passage, last = passage;
    while (first > 0 && passages_[first - 1].tet == tet) --first;
    while (last < passages_.size() && passages_[last].tet == tet) ++last;
    return {first, last};
  }

  // The mean of the points of a tetrahedron's singular faces.
  Vector3d Centre(std::size_t first, std::size_t last) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = first; i < last; ++i) sum += turns_[passages_[i].triangle].point;
    return sum / static_cast<double>(last - first);
  }

  // The place, among the tetrahedron's vertices in ascending order, of the one that the triangle leaves out.
  int OppositePlace(const CurvePassage& passage) const {
    std::array<int, 4> vertices = mesh_.tets[passage.tet];
    std::sort(vertices.begin(), vertices.end());
    const std::array<int, 3>& face = triangles_[passage.triangle].vertices;
    return static_cast<int>(std::mismatch(face.begin(), face.end(), vertices.begin()).second - vertices.begin());
  }

  // Where a curve that arrives at a triangle through one of its tetrahedra ends, unless it goes on.
  CurveEnd EndAt(int triangle) const {
    switch (triangles_[triangle].tets.size()) {
      case 1:
        return CurveEnd::kBoundary;
      case 2:
        return CurveEnd::kNone;
      default:
        return CurveEnd::kNode;
    }
  }

  int OtherTet(const CurvePassage& passage) const {
    const std::vector<int>& tets = triangles_[passage.triangle].tets;
    return tets[0] == passage.tet ? tets[1] : tets[0];
  }

  // From a triangle through a tetrahedron and on, to the curve's end or back to the triangle, which is then the last.
  Walk WalkFrom(std::size_t passage) {
    const int start = passages_[passage].triangle;
    Walk walk;
    int direction = 1;
    while (true) {
      passages_[passage].is_done = true;
      const auto [first, last] = PassagesOfTet(passage);
      if (last - first != 2) {
        walk.end = last - first == 1 ? CurveEnd::kOpen : CurveEnd::kNode;
        if (walk.end == CurveEnd::kNode) walk.node = Centre(first, last);
        return walk;
      }
      CurvePassage& exit = passages_[passage == first ? first + 1 : first];
      exit.is_done = true;
      // Faces that leave out places of equal parity turn alike, seen from outside; the curve sees one from inside.
      if ((OppositePlace(passages_[passage]) + OppositePlace(exit)) % 2 == 0) direction = -direction;
      walk.crossings.push_back({exit.triangle, direction});
      walk.end = EndAt(exit.triangle);
      if (walk.end != CurveEnd::kNone || exit.triangle == start) return walk;
      passage = FindPassage(OtherTet(exit), exit.triangle);
    }
  }

  void TraceFrom(std::size_t passage) {
    const int triangle = passages_[passage].triangle;
    const Walk forward = WalkFrom(passage);
    Walk backward;
    backward.end = EndAt(triangle);
    const bool is_loop = forward.end == CurveEnd::kNone;
    if (backward.end == CurveEnd::kNone && !is_loop) {
      backward = WalkFrom(FindPassage(OtherTet(passages_[passage]), triangle));
    }
    std::vector<Crossing> crossings(backward.crossings.rbegin(), backward.crossings.rend());
    crossings.push_back({triangle, 1});
    crossings.insert(crossings.end(), forward.crossings.begin(), forward.crossings.end());

    SingularCurve& curve = result_.curves.emplace_back();
    curve.type = triangles_[triangle].type;
    curve.ends = {backward.end, forward.end};
    if (backward.node) curve.points.push_back(*backward.node);
    for (const Crossing& crossing : crossings) curve.points.push_back(turns_[crossing.triangle].point);
    if (forward.node) curve.points.push_back(*forward.node);
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      curve.length += (curve.points[i] - curve.points[i - 1]).norm();
    }
    MeasureAxis(crossings, backward.node ? 1 : 0, &curve);
  }

  // The mean cosine, and from it the valence. Crossing i is point i + offset.
  void MeasureAxis(const std::vector<Crossing>& crossings, std::size_t offset, SingularCurve* curve) const {
    const std::vector<Vector3d>& points = curve->points;
    double along = 0, way_up = 0, total = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const std::size_t at = i + offset;
      const Vector3d step = points[std::min(at + 1, points.size() - 1)] - points[at > 0 ? at - 1 : 0];
      const auto& [triangle, direction] = crossings[i];
      const auto& [a, b, c] = triangles_[triangle].vertices;
      const Vector3d normal = (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
      along += direction * turns_[triangle].axis.dot(step);
      way_up += direction * normal.stableNormalized().dot(step);
      total += step.norm();
    }
    if (total == 0) return;
    curve->mean_cosine = (way_up < 0 ? -along : along) / total;
    if (curve->type == TurnType::kQuarter && std::abs(curve->mean_cosine) > kMinMeanCosine) {
      curve->valence = curve->mean_cosine > 0 ? 3 : 5;
    }
  }

  void AddNodes() {
    for (std::size_t first = 0; first < passages_.size();) {
      const std::size_t last = PassagesOfTet(first).second;
      if (last - first > 2) result_.nodes.push_back({Centre(first, last), static_cast<int>(last - first)});
      first = last;
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (EndAt(static_cast<int>(i)) != CurveEnd::kNode) continue;
      result_.nodes.push_back({turns_[i].point, static_cast<int>(triangles_[i].tets.size())});
    }
  }

  const TetMesh& mesh_;
  const std::vector<SingularTriangle>& triangles_;
  std::vector<Turn> turns_;
  std::vector<CurvePassage> passages_;
  SingularCurves result_;
};

}  // namespace

SingularCurves TraceSingularCurves(const TetMesh& mesh, const std::vector<Matrix3d>& frames,
                                   const std::vector<SingularTriangle>& triangles) {
  if (frames.size() != mesh.points.size()) {
    throw std::invalid_argument("TraceSingularCurves: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  return Tracer(mesh, frames, triangles).result();
}

}  // namespace octupole
