#include "octupole/grids/surface_grid.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/grids/internal/grid_alignment.h"
#include "octupole/grids/internal/grid_input.h"
#include "octupole/grids/internal/grid_maker.h"
#include "octupole/grids/internal/grid_springs.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using openvdb::Coord;
using openvdb::FloatTree;
using openvdb::Int32Tree;
using openvdb::MaskTree;

constexpr int kMaxLevels = 8;
// Cells are the finest this far from GridOptions::fine_points, along each coordinate and in their widths.
constexpr double kFineReach = 1;
// Signed distances are exact up to this many widths of a cell.
constexpr float kBandWidth = 3;

// For forecasts, as measured: nodes for each cell's face of surface, the width of the layer of one level in its cells'
// widths, and what SolveFast needs.
constexpr double kNodesBeyond = 0.9;
constexpr double kLayerWidth = 1.8;
constexpr double kBytesPerNode = 1300;

// The corners of a cell in VTK's order.
constexpr std::array<std::array<int, 3>, 8> kCorners = {
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

Coord CornerOf(const Coord& cell, int corner) {
  return cell + Coord(kCorners[corner][0], kCorners[corner][1], kCorners[corner][2]);
}

// Calls visit(cell) for the eight cells about a point of their lattice.
template <typename Visit>
void VisitCellsAt(const Coord& point, const Visit& visit) {
  for (int corner = 0; corner < 8; ++corner) visit(point - CornerOf(Coord(0), corner));
}

// Calls visit(point, value) for all points of a tree for which `wants` its value.
template <typename Tree, typename Wants, typename Visit>
void VisitPoints(const Tree& tree, const Wants& wants, const Visit& visit) {
  for (auto it = tree.cbeginValueAll(); it; ++it) {
    const auto value = it.getValue();
    if (!wants(value)) continue;
    openvdb::CoordBBox box;
    it.getBoundingBox(box);
    for (auto point = box.begin(); point; ++point) visit(*point, value);
  }
}

Coord Half(const Coord& c) { return Coord(c.x() >> 1, c.y() >> 1, c.z() >> 1); }

Coord LatticePoint(const Vector3d& x) {
  const Vector3i floor = x.array().floor().cast<int>();
  return Coord(floor.x(), floor.y(), floor.z());
}

Coord Scaled(const Coord& c, int level) { return Coord(c.x() << level, c.y() << level, c.z() << level); }

// The surface as OpenVDB wants it, in a lattice of cells 2^level times as wide.
struct SurfaceInLattice {
  const std::vector<Vector3d>& points;
  const std::vector<std::array<int, 3>>& triangles;
  double width;

  std::size_t polygonCount() const { return triangles.size(); }
  std::size_t pointCount() const { return points.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& point) const {
    const Vector3d& p = points[triangles[polygon][corner]];
    point = openvdb::Vec3d(p.x(), p.y(), p.z()) / width;
  }
};

// The signed distance at the points of a lattice, in its own widths.
openvdb::FloatGrid::Ptr SignedDistance(const SurfaceInLattice& surface) {
  const auto unit = openvdb::math::Transform::createLinearTransform(1);
  return openvdb::tools::meshToVolume<openvdb::FloatGrid>(surface, *unit, kBandWidth, kBandWidth,
                                                          openvdb::tools::DISABLE_RENORMALIZATION);
}

// Numbers for points of the lattice of the finest cells. Each lies in the tree of the coarsest lattice that has it, as
// a tree stores its points in blocks.
class NodeNumbers {
 public:
  explicit NodeNumbers(int num_levels) {
    for (int l = 0; l < num_levels; ++l) trees_.push_back(std::make_unique<Int32Tree>(-1));
    for (const auto& tree : trees_) accessors_.emplace_back(*tree);
  }

  int Find(const Coord& point) {
    const int level = LevelOf(point);
    return accessors_[level].getValue(InLattice(point, level));
  }

  int FindOrAdd(const Coord& point) {
    const int level = LevelOf(point);
    const Coord place = InLattice(point, level);
    const int number = accessors_[level].getValue(place);
    if (number >= 0) return number;
    accessors_[level].setValue(place, static_cast<int>(points_.size()));
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }

  const std::vector<Coord>& points() const { return points_; }

  int LevelOf(const Coord& point) const {
    int level = 0;
    const int bits = point.x() | point.y() | point.z();
    while (level + 1 < static_cast<int>(trees_.size()) && (bits >> level & 1) == 0) ++level;
    return level;
  }

 private:
  static Coord InLattice(const Coord& point, int level) {
    return Coord(point.x() >> level, point.y() >> level, point.z() >> level);
  }

  std::vector<std::unique_ptr<Int32Tree>> trees_;
  std::vector<openvdb::tree::ValueAccessor<Int32Tree>> accessors_;
  std::vector<Coord> points_;
};

// Of the triangles: points of none do not count.
Eigen::AlignedBox3d BoundingBox(const TriangleMesh& surface) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) box.extend(surface.points[v]);
  }
  return box;
}

class GridMaker {
 public:
  GridMaker(const TriangleMesh& surface, const internal::SolidBySurface& solid, const GridOptions& options)
      : surface_(surface), solid_(solid), options_(options) {
    // Faces of boxes, common in CAD models, lie between nodes, half a cell from both sides; where the box begins, in
    // cells of whose siblings none lies deeper.
    const Vector3d low = BoundingBox(surface).min();
    origin_ = low - Vector3d::Constant(1.5 * options.size);
    points_.reserve(solid.points.size());
    for (const Vector3d& p : solid.points) points_.push_back((p - origin_) / options.size);
  }

  SurfaceGrid Make() {
    for (int level = 0; level < options_.levels; ++level) distances_.push_back(DistanceTo(std::ldexp(1., level)));
    NodeNumbers numbers(options_.levels);
    AddCells(&numbers);
    AddNodes(numbers);
    AddEdges(&numbers);
    grid_.size = options_.size;
    grid_.origin = origin_;
    grid_.graph.alignments.resize(grid_.points.size());
    grid_.alignment = internal::AlignGrid(
        surface_, points_, options_.feature_angle_deg,
        [&numbers](const Vector3i& p) { return numbers.Find(Coord(p.x(), p.y(), p.z())); }, &grid_.graph.alignments);
    if (grid_.alignment.separating_size) *grid_.alignment.separating_size *= options_.size;
    return std::move(grid_);
  }

 private:
  // The signed distance to the solid at the points of a lattice, in its widths.
  FloatTree::Ptr DistanceTo(double width) const {
    openvdb::FloatGrid::Ptr solid;
    for (const auto& [is_cavity, triangles] : solid_.parts) {
      const openvdb::FloatGrid::Ptr part = SignedDistance({points_, triangles, width});
      if (solid == nullptr) {
        solid = part;
      } else if (is_cavity) {
        openvdb::tools::csgDifference(*solid, *part);
      } else {
        openvdb::tools::csgUnion(*solid, *part);
      }
    }
    return solid->treePtr();
  }

  // The cells that the surface runs through.
  MaskTree SurfaceCells() const {
    MaskTree cells;
    openvdb::tree::ValueAccessor<MaskTree> accessor(cells);
    for (const auto& part : solid_.parts) {
      for (const auto& triangle : part.triangles) {
        internal::SampleTriangle({points_[triangle[0]], points_[triangle[1]], points_[triangle[2]]},
                                 internal::kSampleSpacing,
                                 [&](const Vector3d& x, double) { accessor.setValueOn(LatticePoint(x)); });
      }
    }
    return cells;
  }

  // The cells of each level from 1 that are cut into eight: those that the surface runs through, those near the fine
  // points, and those that this makes too large for their neighbours.
  std::vector<MaskTree> CutCells(const MaskTree& surface_cells) const {
    std::vector<MaskTree> cut(options_.levels);
    if (options_.levels == 1) return cut;
    openvdb::tree::ValueAccessor<MaskTree> cells(cut[1]);
    for (auto it = surface_cells.cbeginValueOn(); it; ++it) cells.setValueOn(Half(it.getCoord()));
    // The samples of the surface may have missed a cell of which it cuts off a corner.
    const openvdb::tree::ValueAccessor<const FloatTree> distance(*distances_[0]);
    const auto is_crossed = [&](const Coord& cell) {
      int num_inside = 0;
      for (int c = 0; c < 8; ++c) num_inside += distance.getValue(Scaled(CornerOf(cell, c), 1)) < 0;
      return num_inside % 8 != 0;
    };
    VisitPoints(
        *distances_[1], [](float d) { return std::abs(d) < 1; },
        [&](const Coord& point, float) {
          VisitCellsAt(point, [&](const Coord& cell) {
            if (!cells.isValueOn(cell) && is_crossed(cell)) cells.setValueOn(cell);
          });
        });
    for (const Vector3d& point : options_.fine_points) {
      const Vector3d x = (point - origin_) / options_.size;
      const Vector3d reach = Vector3d::Constant(kFineReach);
      const openvdb::CoordBBox box(Half(LatticePoint(x - reach)), Half(LatticePoint(x + reach)));
      for (auto cell = box.begin(); cell; ++cell) cells.setValueOn(*cell);
    }
    for (int level = 2; level < options_.levels; ++level) {
      openvdb::tree::ValueAccessor<MaskTree> parents(cut[level]);
      for (auto it = cut[level - 1].cbeginValueOn(); it; ++it) {
        const openvdb::CoordBBox around(Half(it.getCoord() - Coord(1)), Half(it.getCoord() + Coord(1)));
        for (auto parent = around.begin(); parent; ++parent) parents.setValueOn(*parent);
      }
    }
    return cut;
  }

  void AddCell(const Coord& cell, int level, NodeNumbers* numbers) {
    std::array<int, 8>& corners = grid_.cells.emplace_back();
    for (int c = 0; c < 8; ++c) corners[c] = numbers->FindOrAdd(Scaled(CornerOf(cell, c), level));
    grid_.levels.push_back(static_cast<std::uint8_t>(level));
  }

  void AddCells(NodeNumbers* numbers) {
    const MaskTree surface_cells = SurfaceCells();
    const std::vector<MaskTree> cut = CutCells(surface_cells);
    const auto is_inside = [](float distance) { return distance < 0; };
    for (int level = 0; level < options_.levels; ++level) {
      const bool is_coarsest = level + 1 == options_.levels;
      // Inside is what the finest lattice calls so: in a coarse one, a narrow way into a hollow is closed.
      const openvdb::tree::ValueAccessor<const FloatTree> distance(*distances_[0]);
      const auto num_inside = [&](const Coord& cell) {
        int count = 0;
        for (int c = 0; c < 8; ++c) count += is_inside(distance.getValue(Scaled(CornerOf(cell, c), level)));
        return count;
      };
      MaskTree cells;
      openvdb::tree::ValueAccessor<MaskTree> accessor(cells);
      if (level == 0) cells.topologyUnion(surface_cells);
      // Candidates: children of cut cells, or whatever has a corner inside.
      const openvdb::tree::ValueAccessor<const MaskTree> is_cut(cut[level]);
      const auto consider = [&](const Coord& cell) {
        const bool is_kept = level == 0 ? num_inside(cell) > 0 : !is_cut.isValueOn(cell) && num_inside(cell) == 8;
        if (is_kept) accessor.setValueOn(cell);
      };
      if (is_coarsest) {
        VisitPoints(*distances_[level], is_inside, [&](const Coord& point, float) {
          if (level == 0) {
            VisitCellsAt(point, [&](const Coord& cell) { accessor.setValueOn(cell); });
          } else {
            consider(point);  // a cell all inside has its first corner inside
          }
        });
      } else {
        for (auto it = cut[level + 1].cbeginValueOn(); it; ++it) {
          for (int c = 0; c < 8; ++c) consider(CornerOf(Scaled(it.getCoord(), 1), c));
        }
      }
      for (auto it = cells.cbeginValueOn(); it; ++it) AddCell(it.getCoord(), level, numbers);
    }
    if (grid_.cells.empty()) throw std::invalid_argument("MakeGrid: no cell of the size meets the surface");
  }

  void AddNodes(const NodeNumbers& numbers) {
    std::vector<openvdb::tree::ValueAccessor<const FloatTree>> distances;
    for (const auto& tree : distances_) distances.emplace_back(*tree);
    grid_.points.reserve(numbers.points().size());
    grid_.distances.reserve(numbers.points().size());
    for (const Coord& point : numbers.points()) {
      grid_.points.push_back(origin_ + options_.size * Vector3d(point.x(), point.y(), point.z()));
      // Of the lattices that have the point, the finest that has the surface within its band.
      const int coarsest = numbers.LevelOf(point);
      float distance = 0;
      for (int level = 0; level <= coarsest; ++level) {
        const float in_cells =
            distances[level].getValue(Coord(point.x() >> level, point.y() >> level, point.z() >> level));
        distance = in_cells * static_cast<float>(std::ldexp(options_.size, level));
        if (std::abs(in_cells) < kBandWidth) break;
      }
      grid_.distances.push_back(std::copysign(distance, distances[0].getValue(point)));
    }
  }

  void AddEdges(NodeNumbers* numbers) {
    // Of each node the edge of cells in the direction of each coordinate: its weight, 0 for none, and its level.
    struct Edge {
      float weight = 0;
      std::uint8_t level = 0;
    };
    std::vector<std::array<Edge, 3>> edges(numbers->points().size());
    std::vector<WeightedEdge> springs;
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      const int level = grid_.levels[i];
      const float weight = std::ldexp(0.25f, level);
      if (level > 0 && AddSprings(i, 4 * weight, numbers, &springs)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 8; ++c) {
          if (kCorners[c][axis] != 0) continue;
          Edge& edge = edges[grid_.cells[i][c]][axis];
          edge.weight += weight;
          edge.level = static_cast<std::uint8_t>(level);
        }
      }
    }
    std::sort(grid_.hanging_nodes.begin(), grid_.hanging_nodes.end(),
              [](const HangingNode& m, const HangingNode& n) { return m.node < n.node; });
    grid_.hanging_nodes.erase(std::unique(grid_.hanging_nodes.begin(), grid_.hanging_nodes.end(),
                                          [](const HangingNode& m, const HangingNode& n) { return m.node == n.node; }),
                              grid_.hanging_nodes.end());
    std::vector<WeightedEdge>& result = grid_.graph.edges;
    result.reserve(3 * edges.size() + springs.size());
    for (std::size_t node = 0; node < edges.size(); ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto& [weight, level] = edges[node][axis];
        if (weight == 0) continue;
        Coord end = numbers->points()[node];
        end[axis] += 1 << level;
        result.push_back({static_cast<int>(node), numbers->Find(end), weight});
      }
    }
    if (!springs.empty()) {
      result.insert(result.end(), springs.begin(), springs.end());
      MergeEdges(&result);
    }
    result.shrink_to_fit();
  }

  // Adds the edges of a cell that smaller ones touch, and their hanging nodes; gives whether they do.
  bool AddSprings(std::size_t cell, double width, NodeNumbers* numbers, std::vector<WeightedEdge>* edges) {
    const int half = 1 << (grid_.levels[cell] - 1);
    const Coord first = numbers->points()[grid_.cells[cell][0]];
    std::array<int, 27> nodes;
    std::uint32_t present = 0;
    const auto find = [&](int x, int y, int z) {
      const int place = internal::LatticeNumber(x, y, z);
      nodes[place] = numbers->Find(first + Coord(x * half, y * half, z * half));
      if (nodes[place] >= 0) present |= 1u << place;
      return nodes[place] >= 0;
    };
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 4; ++k) {
        std::array<int, 3> at;
        at[axis] = 1;
        at[(axis + 1) % 3] = k % 2 * 2;
        at[(axis + 2) % 3] = k / 2 * 2;
        find(at[0], at[1], at[2]);
      }
    }
    if (present == 0) return false;
    for (const auto& [x, y, z] : kCorners) find(2 * x, 2 * y, 2 * z);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 2}) {
        std::array<int, 3> at = {1, 1, 1};
        at[axis] = side;
        find(at[0], at[1], at[2]);
      }
    }
    for (int place = 0; place < 27; ++place) {
      if ((present >> place & 1) == 0) continue;
      // The ends of the edge or the diagonal that it is the middle of.
      const std::array<int, 3> at = {place % 3, place / 3 % 3, place / 9};
      std::array<int, 3> low = at, high = at;
      for (int axis = 0; axis < 3; ++axis) {
        if (at[axis] != 1) continue;
        low[axis] = 0;
        high[axis] = 2;
      }
      if (low == high) continue;
      grid_.hanging_nodes.push_back({nodes[place],
                                     {nodes[internal::LatticeNumber(low[0], low[1], low[2])],
                                      nodes[internal::LatticeNumber(high[0], high[1], high[2])]}});
    }
    for (const auto& [a, b, weight] : springs_.Of(present)) edges->push_back({nodes[a], nodes[b], width * weight});
    return true;
  }

  // Makes one edge of those between the same nodes.
  static void MergeEdges(std::vector<WeightedEdge>* edges) {
    for (WeightedEdge& edge : *edges) {
      if (edge.a > edge.b) std::swap(edge.a, edge.b);
    }
    std::sort(edges->begin(), edges->end(),
              [](const WeightedEdge& e, const WeightedEdge& f) { return std::pair(e.a, e.b) < std::pair(f.a, f.b); });
    std::size_t num_merged = 0;
    for (const WeightedEdge& edge : *edges) {
      WeightedEdge* last = num_merged > 0 ? &(*edges)[num_merged - 1] : nullptr;
      if (last != nullptr && last->a == edge.a && last->b == edge.b) {
        last->weight += edge.weight;
      } else {
        (*edges)[num_merged++] = edge;
      }
    }
    edges->resize(num_merged);
  }

  const TriangleMesh& surface_;
  const internal::SolidBySurface& solid_;
  const GridOptions& options_;
  Vector3d origin_;
  /// Those of the solid in the lattice of the finest cells.
  std::vector<Vector3d> points_;
  /// Of each level.
  std::vector<FloatTree::Ptr> distances_;
  internal::CellSprings springs_;
  SurfaceGrid grid_;
};

void CheckOptions(const GridOptions& options) {
  std::ostringstream message;
  if (!(options.size > 0 && std::isfinite(options.size))) {
    message << "the size of the cells must be positive, not " << options.size;
  } else if (options.levels < 1 || options.levels > kMaxLevels) {
    message << "the levels must be from 1 to " << kMaxLevels << ", not " << options.levels;
  } else if (!(options.feature_angle_deg > 0 && options.feature_angle_deg < 180)) {
    message << "the feature angle must lie between 0 and 180 degrees, not " << options.feature_angle_deg;
  } else if (!std::all_of(options.fine_points.begin(), options.fine_points.end(),
                          [](const Vector3d& p) { return p.allFinite(); })) {
    message << "the fine points must be finite";
  } else if (options.num_threads < 1) {
    message << "the number of threads must be at least 1, not " << options.num_threads;
  } else {
    return;
  }
  throw std::invalid_argument("MakeGrid: " + message.str());
}

}  // namespace

GridForecast ForecastGrid(const TriangleMesh& surface, const GridOptions& options) {
  CheckTriangleMesh(surface);
  CheckOptions(options);
  const Vector3d origin = surface.points[surface.triangles[0][0]];
  double area = 0, volume = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3d p = surface.points[a] - origin, q = surface.points[b] - origin, r = surface.points[c] - origin;
    area += 0.5 * (q - p).cross(r - p).norm();
    volume += p.dot(q.cross(r)) / 6;
  }
  volume = std::abs(volume);
  // Half a cell or so beyond the surface, then a layer of each level inside, the rest for the coarsest.
  GridForecast forecast = {kNodesBeyond * area / (options.size * options.size), 0};
  for (int level = 0; level < options.levels; ++level) {
    const double width = std::ldexp(options.size, level);
    const double layer = level + 1 < options.levels ? std::min(volume, kLayerWidth * width * area) : volume;
    forecast.nodes += layer / std::pow(width, 3);
    volume -= layer;
  }
  forecast.bytes = kBytesPerNode * forecast.nodes;
  return forecast;
}

void internal::CheckGridSize(const TriangleMesh& surface, const GridOptions& options) {
  const GridForecast forecast = ForecastGrid(surface, options);
  const double available = options.max_bytes ? *options.max_bytes : internal::AvailableMemory();
  if ((available > 0 && forecast.bytes > available) || forecast.nodes > std::numeric_limits<int>::max()) {
    std::ostringstream message;
    message << "MakeGrid: cells of size " << options.size << " make some " << forecast.nodes << " nodes, which need "
            << forecast.bytes / 1e9 << " GB of memory; there are " << available / 1e9;
    throw std::length_error(message.str());
  }
}

HoleRepair HoleRepairOf(const std::string& name) {
  if (name == "none") return HoleRepair::kNone;
  if (name == "close") return HoleRepair::kClose;
  throw std::invalid_argument("repair: '" + name + "' is none of close, none");
}

SurfaceGrid internal::MakeGridOfSolid(const TriangleMesh& surface, const SolidBySurface& solid,
                                      const GridOptions& options) {
  tbb::task_arena arena(options.num_threads);
  SurfaceGrid grid;
  arena.execute([&] { grid = GridMaker(surface, solid, options).Make(); });
  return grid;
}

SurfaceGrid MakeGrid(const TriangleMesh& surface, const GridOptions& options, std::vector<std::string>* warnings) {
  internal::CheckGridSize(surface, options);
  return internal::MakeGridOfSolid(surface, internal::FindSolid(surface, options.repair, warnings), options);
}

double SizeForResolution(const TriangleMesh& surface, int resolution) {
  CheckTriangleMesh(surface);
  if (resolution < 1) {
    throw std::invalid_argument("SizeForResolution: the resolution must be at least 1, not " +
                                std::to_string(resolution));
  }
  return BoundingBox(surface).sizes().maxCoeff() / resolution;
}

}  // namespace octupole
