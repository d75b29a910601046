#include "octupole/singularities/surface_singularities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

#include "octupole/mesh/surface_corners.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;
using Triangles = std::vector<std::array<int, 3>>;

// Two directions of the fan count as equally near to an axis within this, so that rounding does not choose.
constexpr double kTie = 1e-6;
const double kMinNormalCosine = std::cos(M_PI / 180);

// Side 3 t + i goes from corner i of triangle t to the next, and corner 3 t + i lies between the sides 3 t + i and
// before that.
int Before(int i) { return i % 3 == 0 ? i + 2 : i - 1; }
int After(int i) { return i % 3 == 2 ? i - 2 : i + 1; }

void Check(const Points& points, const Triangles& triangles, const std::vector<Matrix3d>& frames) {
  const std::string name = "FindSurfaceSingularities: ";
  if (frames.size() != points.size()) {
    throw std::invalid_argument(name + std::to_string(frames.size()) + " frames for " + std::to_string(points.size()) +
                                " points");
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto [least, largest] = std::minmax({a, b, c});
    if (least >= 0 && largest < static_cast<int>(points.size()) && a != b && b != c && c != a) continue;
    throw std::invalid_argument(name + "triangle " + std::to_string(t) + " has the vertices " + std::to_string(a) +
                                ", " + std::to_string(b) + ", " + std::to_string(c) + " of " +
                                std::to_string(points.size()) + " points");
  }
}

// For each side the one on its other side, or -1.
std::vector<int> PairSides(const Triangles& triangles) {
  struct Side {
    int a, b, side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      sides.push_back({a, b, static_cast<int>(3 * t + i)});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& s, const Side& t) { return std::tie(s.a, s.b, s.side) < std::tie(t.a, t.b, t.side); });
  std::vector<int> partners(sides.size(), -1);
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].a == sides[first].a && sides[last].b == sides[first].b) ++last;
    if (last - first != 2) continue;
    partners[sides[first].side] = sides[first + 1].side;
    partners[sides[first + 1].side] = sides[first].side;
  }
  return partners;
}

// A corner as part of the fan of triangles around its vertex.
struct FanCorner {
  /// 1 when the fan runs from the corner's own side to the one before, as the triangle does, else -1.
  int orientation = 0;
  /// The angle of the corner, scaled with its fan.
  double angle = 0;
  /// The angle of the vertex' cross, less that of the corner's own side and of the one before, as the fan runs.
  double cross_to_own = 0;
  double cross_to_before = 0;
};

class Surface {
 public:
  Surface(const Points& points, const Triangles& triangles, const std::vector<Matrix3d>& frames)
      : points_(points), triangles_(triangles), frames_(frames), partners_(PairSides(triangles)) {
    result_.component_of.assign(triangles.size(), -1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (result_.component_of[t] < 0) AddComponent(static_cast<int>(t));
    }
    corners_.resize(partners_.size());
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (corners_[c].orientation == 0) AddFan(static_cast<int>(c));
    }
    result_.quarter_indices.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      result_.quarter_indices.push_back(QuarterIndex(static_cast<int>(t)));
      ComponentOf(static_cast<int>(3 * t)).quarter_index_sum += result_.quarter_indices.back();
    }
  }

  SurfaceSingularities result() && { return std::move(result_); }

 private:
  int VertexOf(int corner) const { return triangles_[corner / 3][corner % 3]; }
  SurfaceComponent& ComponentOf(int corner) { return result_.components[result_.component_of[corner / 3]]; }

  // The triangles that are joined to this one, and their number less that of their edges.
  void AddComponent(int triangle) {
    const auto number = static_cast<int>(result_.components.size());
    SurfaceComponent& component = result_.components.emplace_back();
    std::vector<int> pending = {triangle};
    result_.component_of[triangle] = number;
    while (!pending.empty()) {
      const int t = pending.back();
      pending.pop_back();
      ++component.triangles;
      ++component.euler_characteristic;
      for (const int side : {3 * t, 3 * t + 1, 3 * t + 2}) {
        const int partner = partners_[side];
        component.is_closed &= partner >= 0;
        component.euler_characteristic -= side > partner;
        if (partner < 0 || result_.component_of[partner / 3] >= 0) continue;
        result_.component_of[partner / 3] = number;
        pending.push_back(partner / 3);
      }
    }
  }

  // A corner and the side by which a walk around its vertex enters or leaves it.
  struct Step {
    int corner;
    int side;
    int OtherSide() const { return side == corner ? Before(corner) : corner; }
  };

  // Across a side that has a partner: the same vertex' corner behind it.
  Step Cross(const Step& step) const {
    const int side = partners_[step.side];
    const int vertex = VertexOf(step.corner);
    return {VertexOf(side) == vertex ? side : After(side), side};
  }

  // The fan to which a corner belongs: each corner with the side by which the fan enters it.
  std::vector<Step> CollectFan(int corner) const {
    Step first = {corner, corner};
    while (partners_[first.side] >= 0) {
      const Step crossed = Cross(first);
      if (crossed.corner == corner) break;
      first = {crossed.corner, crossed.OtherSide()};
    }
    std::vector<Step> fan = {first};
    while (partners_[fan.back().OtherSide()] >= 0) {
      const Step next = Cross({fan.back().corner, fan.back().OtherSide()});
      if (next.corner == first.corner) break;
      fan.push_back(next);
    }
    return fan;
  }

  Vector3d Direction(const Step& step) const {
    const int vertex = VertexOf(step.corner);
    const int end = VertexOf(step.side) == vertex ? VertexOf(After(step.side)) : VertexOf(step.side);
    return (points_[end] - points_[vertex]).stableNormalized();
  }

  void AddFan(int corner) {
    const std::vector<Step> fan = CollectFan(corner);
    const Matrix3d& frame = frames_[VertexOf(corner)];
    const bool is_closed = partners_[fan.back().OtherSide()] >= 0;
    std::vector<SurfaceCorner> shape;
    std::vector<Vector3d> directions;
    double total = 0;
    for (const Step& step : fan) {
      const Vector3d first = Direction(step), last = Direction({step.corner, step.OtherSide()});
      const Vector3d cross = first.cross(last);
      shape.push_back({cross.stableNormalized(), std::atan2(cross.norm(), first.dot(last))});
      directions.push_back(first);
      total += shape.back().angle;
    }
    directions.push_back(Direction({fan.back().corner, fan.back().OtherSide()}));

    SurfaceComponent& component = ComponentOf(corner);
    ++component.euler_characteristic;
    component.is_normal &= (frame.transpose() * MeanNormal(shape)).cwiseAbs().maxCoeff() >= kMinNormalCosine;

    // The scaled angles at which the corners begin, and that of the direction nearest to an axis.
    std::vector<double> angles = {0};
    double cross_angle = 0, nearness = -1;
    const auto try_direction = [&](double dot, double angle) {
      if (dot <= nearness + kTie) return;
      nearness = dot;
      cross_angle = angle;
    };
    for (std::size_t i = 0; i < fan.size(); ++i) {
      double& scaled = corners_[fan[i].corner].angle;
      scaled = shape[i].angle;
      if (is_closed) scaled = total > 0 ? scaled * (2 * M_PI / total) : 2 * M_PI / static_cast<double>(fan.size());
      try_direction((frame.transpose() * directions[i]).cwiseAbs().maxCoeff(), angles[i]);
      const Vector3d& x = directions[i];
      const Vector3d y = shape[i].normal.cross(x);
      for (int k = 0; k < 6; ++k) {
        const Vector3d axis = k < 3 ? Vector3d(frame.col(k)) : Vector3d(-frame.col(k - 3));
        const double angle = std::atan2(axis.dot(y), axis.dot(x));
        if (angle <= 0 || angle >= shape[i].angle) continue;
        try_direction(std::hypot(axis.dot(x), axis.dot(y)), angles[i] + scaled * (angle / shape[i].angle));
      }
      angles.push_back(angles[i] + scaled);
    }
    if (is_closed) {
      // The same number for both triangles of the edge at which the fan begins and ends.
      angles.back() = 0;
    } else {
      try_direction((frame.transpose() * directions.back()).cwiseAbs().maxCoeff(), angles.back());
    }

    for (std::size_t i = 0; i < fan.size(); ++i) {
      FanCorner& at = corners_[fan[i].corner];
      const bool runs_with_triangle = fan[i].side == fan[i].corner;
      at.orientation = runs_with_triangle ? 1 : -1;
      at.cross_to_own = cross_angle - angles[runs_with_triangle ? i : i + 1];
      at.cross_to_before = cross_angle - angles[runs_with_triangle ? i + 1 : i];
    }
  }

  // By how much the cross turns along a side, as its triangle sees it. Exactly the negative of what the triangle on the
  // other side sees.
  double Turn(int side) const {
    const FanCorner &from = corners_[side], &to = corners_[After(side)];
    return std::remainder(to.orientation * to.cross_to_before - from.orientation * from.cross_to_own, M_PI / 2);
  }

  int QuarterIndex(int triangle) const {
    double sum = -M_PI;
    for (const int i : {3 * triangle, 3 * triangle + 1, 3 * triangle + 2}) sum += Turn(i) + corners_[i].angle;
    return static_cast<int>(std::lround(sum / (M_PI / 2)));
  }

  const Points& points_;
  const Triangles& triangles_;
  const std::vector<Matrix3d>& frames_;
  std::vector<int> partners_;
  std::vector<FanCorner> corners_;
  SurfaceSingularities result_;
};

}  // namespace

SurfaceSingularities FindSurfaceSingularities(const Points& points, const Triangles& triangles,
                                              const std::vector<Matrix3d>& frames) {
  Check(points, triangles, frames);
  return Surface(points, triangles, frames).result();
}

std::vector<int> QuarterIndices(const Points& points, const Triangles& triangles, const std::vector<Matrix3d>& frames) {
  return FindSurfaceSingularities(points, triangles, frames).quarter_indices;
}

std::vector<SingularPoint> SingularPoints(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles,
                                          const std::vector<int>& quarter_indices) {
  if (quarter_indices.size() != triangles.size()) {
    throw std::invalid_argument("SingularPoints: " + std::to_string(quarter_indices.size()) + " indices for " +
                                std::to_string(triangles.size()) + " triangles");
  }
  std::vector<SingularPoint> singular;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (quarter_indices[t] != 0) singular.push_back({(points[a] + points[b] + points[c]) / 3, quarter_indices[t]});
  }
  return singular;
}

}  // namespace octupole
