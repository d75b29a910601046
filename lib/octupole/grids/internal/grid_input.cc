#include "octupole/grids/internal/grid_input.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/mesh/surface_corners.h"

namespace octupole::internal {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

// Disjoint sets of numbers.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(int i, int j) { parent_[Find(i)] = Find(j); }

 private:
  std::vector<int> parent_;
};

std::string Count(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::size_t CountFlatTriangles(const TriangleMesh& surface) {
  return std::count_if(surface.triangles.begin(), surface.triangles.end(),
                       [&](const Triangle& t) { return TriangleNormal(surface.points, t).isZero(0); });
}

std::size_t CountDuplicates(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles.end() - std::unique(triangles.begin(), triangles.end());
}

// Where a surface is open.
struct Hole {
  std::vector<std::array<int, 2>> edges;
  double perimeter = 0;
  Vector3d centre = Vector3d::Zero();
};

std::vector<Hole> FindHoles(const TriangleMesh& surface) {
  const std::vector<std::array<int, 2>> edges = OpenEdges(surface);
  Sets sets(surface.points.size());
  for (const auto& [a, b] : edges) sets.Join(a, b);
  std::map<int, Hole> hole_of;
  for (const auto& [a, b] : edges) {
    Hole& hole = hole_of[sets.Find(a)];
    const double length = (surface.points[b] - surface.points[a]).norm();
    hole.edges.push_back({a, b});
    hole.perimeter += length;
    hole.centre += length * (surface.points[a] + surface.points[b]) / 2;
  }
  std::vector<Hole> holes;
  for (auto& [root, hole] : hole_of) {
    hole.centre = hole.perimeter > 0 ? Vector3d(hole.centre / hole.perimeter) : surface.points[root];
    holes.push_back(std::move(hole));
  }
  return holes;
}

std::string Describe(const std::vector<Hole>& holes) {
  const auto largest = std::max_element(holes.begin(), holes.end(),
                                        [](const Hole& a, const Hole& b) { return a.perimeter < b.perimeter; });
  std::ostringstream text;
  text << Count(holes.size(), "hole", "holes") << ", the largest with a perimeter of " << largest->perimeter
       << " about (" << largest->centre.x() << ", " << largest->centre.y() << ", " << largest->centre.z() << ")";
  return text.str();
}

// Triangles that hang together.
struct Shell {
  /// Turned so that neighbours agree, as far as that is possible.
  std::vector<Triangle> triangles;
  AlignedBox3d box;
  double volume = 0;
  /// How many of the others contain it.
  int depth = 0;
  bool is_cavity = false;
};

// Turns the triangles of a shell so that they agree with their neighbours, and gives how many it turned, or left if
// those are fewer. Edges of other than two triangles do not count.
std::size_t Orient(std::vector<Triangle>* triangles) {
  struct Side {
    std::array<int, 2> edge;
    int triangle;
    bool is_forward;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles->size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = (*triangles)[t][i], b = (*triangles)[t][(i + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.edge < t.edge; });
  struct Neighbour {
    int triangle;
    bool agrees;
  };
  std::vector<std::vector<Neighbour>> neighbours(triangles->size());
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    if (last - first == 2) {
      const Side &s = sides[first], &t = sides[first + 1];
      const bool agrees = s.is_forward != t.is_forward;
      neighbours[s.triangle].push_back({t.triangle, agrees});
      neighbours[t.triangle].push_back({s.triangle, agrees});
    }
    first = last;
  }
  std::vector<int> turn(triangles->size(), 0);  // 1 keep, -1 turn
  std::size_t num_odd = 0;
  for (std::size_t root = 0; root < triangles->size(); ++root) {
    if (turn[root] != 0) continue;
    turn[root] = 1;
    std::vector<int> patch = {static_cast<int>(root)};
    std::size_t num_turned = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const int t = patch[next];
      num_turned += turn[t] < 0;
      for (const Neighbour& neighbour : neighbours[t]) {
        if (turn[neighbour.triangle] != 0) continue;
        turn[neighbour.triangle] = neighbour.agrees ? turn[t] : -turn[t];
        patch.push_back(neighbour.triangle);
      }
    }
    // The majority is right.
    const bool is_minority = 2 * num_turned > patch.size();
    num_odd += is_minority ? patch.size() - num_turned : num_turned;
    if (!is_minority) continue;
    for (const int t : patch) turn[t] = -turn[t];
  }
  for (std::size_t t = 0; t < triangles->size(); ++t) {
    if (turn[t] < 0) std::swap((*triangles)[t][1], (*triangles)[t][2]);
  }
  return num_odd;
}

// How often a shell winds around a point (van Oosterom, Strackee, The solid angle of a plane triangle, 1983).
double WindingNumber(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles, const Vector3d& x) {
  double angle = 0;
  for (const Triangle& triangle : triangles) {
    const Vector3d a = points[triangle[0]] - x, b = points[triangle[1]] - x, c = points[triangle[2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * M_PI);
}

bool Contains(const std::vector<Vector3d>& points, const Shell& outer, const Shell& inner) {
  if (!outer.box.contains(inner.box)) return false;
  // Some of its points; shells that cut each other are no cavities.
  constexpr std::size_t kNumTries = 4;
  for (std::size_t i = 0; i < kNumTries; ++i) {
    const Triangle& triangle = inner.triangles[i * inner.triangles.size() / kNumTries];
    if (std::abs(WindingNumber(points, outer.triangles, points[triangle[0]])) < 0.5) return false;
  }
  return true;
}

std::vector<Shell> FindShells(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles,
                              std::size_t* num_turned) {
  Sets sets(points.size());
  for (const auto& [a, b, c] : triangles) {
    sets.Join(a, b);
    sets.Join(b, c);
  }
  std::map<int, std::size_t> number_of;
  std::vector<Shell> shells;
  for (const Triangle& triangle : triangles) {
    const auto [at, is_new] = number_of.insert({sets.Find(triangle[0]), shells.size()});
    if (is_new) shells.emplace_back();
    shells[at->second].triangles.push_back(triangle);
  }
  for (Shell& shell : shells) {
    *num_turned += Orient(&shell.triangles);
    const Vector3d& origin = points[shell.triangles[0][0]];
    for (const auto& [a, b, c] : shell.triangles) {
      for (const int v : {a, b, c}) shell.box.extend(points[v]);
      shell.volume += (points[a] - origin).dot((points[b] - origin).cross(points[c] - origin)) / 6;
    }
  }
  for (Shell& inner : shells) {
    const Shell* outermost = nullptr;  // of those around it
    for (const Shell& outer : shells) {
      if (&outer == &inner || !Contains(points, outer, inner)) continue;
      ++inner.depth;
      if (outermost == nullptr || outer.box.volume() > outermost->box.volume()) outermost = &outer;
    }
    inner.is_cavity = outermost != nullptr && outermost->volume * inner.volume < 0;
  }
  return shells;
}

// Whether a segment crosses the inside of a triangle.
bool Crosses(const Vector3d& from, const Vector3d& to, const std::array<Vector3d, 3>& triangle) {
  const auto sixfold = [](const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    return (b - a).dot((c - a).cross(d - a));
  };
  const auto& [a, b, c] = triangle;
  const double below = sixfold(a, b, c, from), above = sixfold(a, b, c, to);
  if (!(below * above < 0)) return false;
  const double u = sixfold(from, to, a, b), v = sixfold(from, to, b, c), w = sixfold(from, to, c, a);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

// Pairs of triangles that cross and have no corner in common. Overlaps within one plane do not count.
std::size_t CountIntersections(const TriangleMesh& surface) {
  const std::size_t num_triangles = surface.triangles.size();
  std::vector<std::array<Vector3d, 3>> corners(num_triangles);
  std::vector<AlignedBox3d> boxes(num_triangles);
  AlignedBox3d all;
  for (std::size_t t = 0; t < num_triangles; ++t) {
    for (int i = 0; i < 3; ++i) {
      corners[t][i] = surface.points[surface.triangles[t][i]];
      boxes[t].extend(corners[t][i]);
    }
    all.extend(boxes[t]);
  }
  // Columns along x, swept one by one.
  const int num_bins = std::clamp(static_cast<int>(std::sqrt(num_triangles) / 2), 1, 256);
  const auto bin_of = [&](const Vector3d& p, int axis) {
    const double width = all.sizes()[axis];
    const double place = width > 0 ? (p[axis] - all.min()[axis]) / width : 0;
    return std::clamp(static_cast<int>(place * num_bins), 0, num_bins - 1);
  };
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(num_bins) * num_bins);
  for (std::size_t t = 0; t < num_triangles; ++t) {
    for (int y = bin_of(boxes[t].min(), 1); y <= bin_of(boxes[t].max(), 1); ++y) {
      for (int z = bin_of(boxes[t].min(), 2); z <= bin_of(boxes[t].max(), 2); ++z) {
        columns[y * num_bins + z].push_back(static_cast<int>(t));
      }
    }
  }
  const auto cross = [&](int s, int t) {
    for (const int v : surface.triangles[s]) {
      for (const int w : surface.triangles[t]) {
        if (v == w) return false;
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (Crosses(corners[s][i], corners[s][(i + 1) % 3], corners[t])) return true;
      if (Crosses(corners[t][i], corners[t][(i + 1) % 3], corners[s])) return true;
    }
    return false;
  };
  std::size_t count = 0;
  for (int y = 0; y < num_bins; ++y) {
    for (int z = 0; z < num_bins; ++z) {
      std::vector<int>& column = columns[y * num_bins + z];
      std::sort(column.begin(), column.end(), [&](int s, int t) { return boxes[s].min().x() < boxes[t].min().x(); });
      for (std::size_t i = 0; i < column.size(); ++i) {
        const AlignedBox3d& box = boxes[column[i]];
        for (std::size_t j = i + 1; j < column.size() && boxes[column[j]].min().x() <= box.max().x(); ++j) {
          if (!box.intersects(boxes[column[j]])) continue;
          // A pair counts in the column of the least corner that the two boxes have in common.
          const Vector3d least = box.min().cwiseMax(boxes[column[j]].min());
          if (bin_of(least, 1) == y && bin_of(least, 2) == z) count += cross(column[i], column[j]);
        }
      }
    }
  }
  return count;
}

}  // namespace

SolidBySurface FindSolid(const TriangleMesh& surface, HoleRepair repair, std::vector<std::string>* warnings) {
  const auto warn = [&](const std::string& warning) {
    if (warnings != nullptr) warnings->push_back(warning);
  };
  if (const std::size_t count = CountFlatTriangles(surface); count > 0) {
    warn(Count(count, "triangle", "triangles") + " of zero area");
  }
  if (const std::size_t count = CountDuplicates(surface.triangles); count > 0) {
    warn(Count(count, "triangle lies", "triangles lie") + " twice");
  }
  if (const std::size_t count = CountIntersections(surface); count > 0) {
    warn("the surface intersects itself: " + Count(count, "pair of triangles crosses", "pairs of triangles cross"));
  }
  SolidBySurface solid;
  solid.points = surface.points;
  std::vector<Triangle> triangles = surface.triangles;
  if (const std::vector<Hole> holes = FindHoles(surface); !holes.empty()) {
    if (repair == HoleRepair::kNone) {
      throw std::invalid_argument("MakeGrid: the surface is open: " + Describe(holes) +
                                  "; it bounds no solid unless they are closed");
    }
    for (const Hole& hole : holes) {
      for (const auto& [a, b] : hole.edges) triangles.push_back({b, a, static_cast<int>(solid.points.size())});
      solid.points.push_back(hole.centre);
    }
    warn("the surface is open: " + Describe(holes) + "; closed with caps, along which the field is free");
  }
  std::size_t num_turned = 0;
  std::vector<Shell> shells = FindShells(solid.points, triangles, &num_turned);
  if (num_turned > 0) {
    warn(Count(num_turned, "triangle is", "triangles are") + " oriented against their neighbours");
  }
  const std::size_t num_cavities =
      std::count_if(shells.begin(), shells.end(), [](const Shell& shell) { return shell.is_cavity; });
  const std::size_t num_filled = std::count_if(
      shells.begin(), shells.end(), [](const Shell& shell) { return shell.depth % 2 == 1 && !shell.is_cavity; });
  if (shells.size() > 1) {
    std::string text = std::to_string(shells.size()) + " shells";
    if (num_cavities > 0) text += ", " + Count(num_cavities, "of them a cavity", "of them cavities");
    if (num_filled > 0)
      text += ", " + std::to_string(num_filled) + " inside others but oriented alike, so not cavities";
    warn(text);
  }
  std::stable_sort(shells.begin(), shells.end(), [](const Shell& a, const Shell& b) { return a.depth < b.depth; });
  for (Shell& shell : shells) {
    if (solid.parts.empty() || solid.parts.back().is_cavity != shell.is_cavity) {
      solid.parts.push_back({shell.is_cavity, {}});
    }
    std::vector<Triangle>& part = solid.parts.back().triangles;
    part.insert(part.end(), shell.triangles.begin(), shell.triangles.end());
  }
  return solid;
}

double AvailableMemory() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    double kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) return 1024 * kibibytes;
  }
  return 0;
}

}  // namespace octupole::internal
