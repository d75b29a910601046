#include "octupole/maps/map_obstacles.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "octupole/maps/internal/union_find.h"

namespace octupole {
namespace {

using Edge = std::array<int, 2>;

double LengthOf(const TetMesh& mesh, const Edge& edge) { return (mesh.points[edge[0]] - mesh.points[edge[1]]).norm(); }

void SortBySize(std::vector<MapObstacle>* obstacles) {
  std::stable_sort(obstacles->begin(), obstacles->end(),
                   [](const MapObstacle& a, const MapObstacle& b) { return a.size > b.size; });
}

// The cells that share vertices, as one obstacle each.
template <std::size_t N, typename Add>
std::vector<MapObstacle> Group(const TetMesh& mesh, ObstacleKind kind, const std::vector<std::array<int, N>>& cells,
                               const Add& add) {
  internal::UnionFind parts(static_cast<int>(mesh.points.size()));
  for (const auto& cell : cells) {
    for (const int v : cell) parts.Unite(cell[0], v);
  }
  std::map<int, std::size_t> number;
  std::vector<MapObstacle> obstacles;
  std::vector<Eigen::Vector3d> low, high;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector3d& first = mesh.points[cells[i][0]];
    const auto [place, is_new] = number.emplace(parts.Root(cells[i][0]), obstacles.size());
    if (is_new) {
      obstacles.push_back({kind, {}, {}, first});
      low.push_back(first);
      high.push_back(first);
    }
    const std::size_t k = place->second;
    for (const int v : cells[i]) {
      low[k] = low[k].cwiseMin(mesh.points[v]);
      high[k] = high[k].cwiseMax(mesh.points[v]);
    }
    add(i, &obstacles[k]);
  }
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    obstacles[k].place = (low[k] + high[k]) / 2;
    if (obstacles[k].size == 0) obstacles[k].size = (high[k] - low[k]).norm();
  }
  SortBySize(&obstacles);
  return obstacles;
}

std::vector<MapObstacle> GroupEdges(const TetMesh& mesh, ObstacleKind kind, const std::vector<Edge>& edges) {
  return Group(mesh, kind, edges, [&](std::size_t i, MapObstacle* obstacle) {
    obstacle->edges.push_back(edges[i]);
    obstacle->size += LengthOf(mesh, edges[i]);
  });
}

std::vector<MapObstacle> GroupTets(const TetMesh& mesh, ObstacleKind kind, const std::vector<int>& tets) {
  std::vector<std::array<int, 4>> cells;
  cells.reserve(tets.size());
  for (const int t : tets) cells.push_back(mesh.tets[t]);
  return Group(mesh, kind, cells, [&](std::size_t i, MapObstacle* obstacle) { obstacle->tets.push_back(tets[i]); });
}

// Of every vertex on singular curves the singular edges there, as indices.
std::map<int, std::vector<int>> SingularEdgesOfVertices(const MapDomain& domain) {
  std::map<int, std::vector<int>> edges_of;
  for (std::size_t e = 0; e < domain.singular_edges.size(); ++e) {
    for (const int v : domain.singular_edges[e].vertices) edges_of[v].push_back(static_cast<int>(e));
  }
  return edges_of;
}

std::vector<MapObstacle> FindValenceChanges(const MapDomain& domain) {
  std::vector<MapObstacle> obstacles;
  for (const auto& [v, edges] : SingularEdgesOfVertices(domain)) {
    if (edges.size() != 2) continue;
    const SingularEdge &one = domain.singular_edges[edges[0]], &other = domain.singular_edges[edges[1]];
    if (one.valence + other.valence != 8 || one.valence == other.valence) continue;
    MapObstacle obstacle = {ObstacleKind::kValenceChange, {}, {}, domain.mesh.points[v]};
    for (const SingularEdge* edge : {&one, &other}) {
      obstacle.edges.push_back(edge->vertices);
      obstacle.size += LengthOf(domain.mesh, edge->vertices);
    }
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

// The length of a singular edge in the map.
double CellsAlong(const MapDomain& domain, const CornerParameters& parameters, const SingularEdge& edge) {
  const int t = domain.rings.steps[domain.rings.begin[edge.ring]].tet;
  const std::array<int, 4>& tet = domain.mesh.tets[t];
  const auto parameters_of = [&](int v) { return parameters[t][std::find(tet.begin(), tet.end(), v) - tet.begin()]; };
  return (parameters_of(edge.vertices[0]) - parameters_of(edge.vertices[1])).norm();
}

// Curves go on at vertices of two singular edges, and end elsewhere.
std::vector<MapObstacle> FindShortCurves(const MapDomain& domain, const CornerParameters& parameters) {
  constexpr double kShort = 0.1;
  internal::UnionFind curves(static_cast<int>(domain.singular_edges.size()));
  for (const auto& [v, edges] : SingularEdgesOfVertices(domain)) {
    if (edges.size() == 2) curves.Unite(edges[0], edges[1]);
  }
  std::map<int, MapObstacle> found;
  for (std::size_t e = 0; e < domain.singular_edges.size(); ++e) {
    const SingularEdge& edge = domain.singular_edges[e];
    MapObstacle& curve = found.try_emplace(curves.Root(static_cast<int>(e)), MapObstacle{}).first->second;
    curve.kind = ObstacleKind::kShortCurve;
    curve.edges.push_back(edge.vertices);
    curve.size += LengthOf(domain.mesh, edge.vertices);
    curve.cells += CellsAlong(domain, parameters, edge);
  }
  std::vector<MapObstacle> obstacles;
  for (auto& [root, curve] : found) {
    if (curve.cells >= kShort) continue;
    curve.place = domain.mesh.points[curve.edges[curve.edges.size() / 2][0]];
    obstacles.push_back(std::move(curve));
  }
  SortBySize(&obstacles);
  return obstacles;
}

std::vector<MapObstacle> FindThinParts(const MapDomain& domain) {
  std::vector<Eigen::Vector3d> outward(domain.mesh.points.size(), Eigen::Vector3d::Zero());
  for (const BoundarySheets::Face& face : domain.sheets.faces) {
    if (domain.combed.neighbours[face.tet][face.corner] >= 0) continue;  // an interface
    for (int k = 0; k < 4; ++k) {
      if (k == face.corner) continue;
      outward[domain.mesh.tets[face.tet][k]] += face.sign * domain.combed.frames[face.tet].col(face.axis);
    }
  }
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < domain.rings.size(); ++r) {
    const auto [a, b] = domain.rings.vertices[r];
    // Normals of opposite sides, and an edge that leads from one to the other.
    constexpr double kOpposite = -0.5;
    if (!domain.rings.is_closed[r] || outward[a].isZero() || outward[b].isZero()) continue;
    const Eigen::Vector3d n = outward[a].normalized(), m = outward[b].normalized();
    const Eigen::Vector3d along = (domain.mesh.points[b] - domain.mesh.points[a]).normalized();
    if (n.dot(m) < kOpposite && along.dot(m) > -kOpposite) edges.push_back({a, b});
  }
  auto obstacles = GroupEdges(domain.mesh, ObstacleKind::kThinPart, edges);
  for (MapObstacle& obstacle : obstacles) {
    obstacle.size = LengthOf(domain.mesh, obstacle.edges[0]);
    for (const Edge& edge : obstacle.edges) obstacle.size = std::min(obstacle.size, LengthOf(domain.mesh, edge));
  }
  return obstacles;
}

}  // namespace

std::string MapObstacle::Describe() const {
  std::ostringstream line;
  const auto edges_of_length = [&](const char* what) {
    line << edges.size() << what << (edges.size() == 1 ? " edge" : " edges") << ", together " << size << " long";
  };
  switch (kind) {
    case ObstacleKind::kTurn:
      edges_of_length(" singular");
      line << ", whose turn is not a quarter turn: no map goes around them";
      break;
    case ObstacleKind::kValenceChange:
      line << "a singular curve that changes from valence 3 to 5, its edges there " << size
           << " long: it has to turn back on itself, or be straightened";
      break;
    case ObstacleKind::kWedge:
      edges_of_length("");
      line << " of a wedge of " << angle_deg
           << " degrees, whose two sides share one parameter: that of the smaller side was let go";
      break;
    case ObstacleKind::kThinPart:
      line << "a part one tetrahedron thick, at its thinnest " << size << ", through " << edges.size()
           << (edges.size() == 1 ? " edge" : " edges") << ": refine the mesh there";
      break;
    case ObstacleKind::kCollapsed:
      line << tets.size() << (tets.size() == 1 ? " tetrahedron" : " tetrahedra") << " within " << size
           << ", flat in every map: singular edges or the boundary hold all their corners; refine the mesh there";
      break;
    case ObstacleKind::kFlipped:
      line << tets.size() << (tets.size() == 1 ? " tetrahedron" : " tetrahedra") << " within " << size
           << ", turned over or flattened";
      break;
    case ObstacleKind::kReleased:
      line << "the boundary faces of " << tets.size() << (tets.size() == 1 ? " tetrahedron" : " tetrahedra")
           << " within " << size << " hold no parameter constant: no map does that and does not flatten what is below";
      break;
    case ObstacleKind::kShortCurve:
      edges_of_length(" singular");
      line << ", a curve of only " << cells << " cells in the map: the size is too large for it";
      break;
  }
  line << "; at " << place.x() << " " << place.y() << " " << place.z();
  return line.str();
}

std::vector<MapObstacle> FindObstacles(const MapDomain& domain, const std::vector<int>& flipped,
                                       const CornerParameters& parameters) {
  std::vector<Edge> turns, wedges;
  for (const SingularEdge& edge : domain.singular_edges) {
    if (edge.valence == 0) turns.push_back(edge.vertices);
  }
  for (const BoundarySheets::Wedge& wedge : domain.sheets.wedges) wedges.push_back(wedge.vertices);
  auto obstacles = GroupEdges(domain.mesh, ObstacleKind::kTurn, turns);
  const auto append = [&](std::vector<MapObstacle> more) {
    std::move(more.begin(), more.end(), std::back_inserter(obstacles));
  };
  append(FindValenceChanges(domain));
  auto wedge_groups = GroupEdges(domain.mesh, ObstacleKind::kWedge, wedges);
  for (MapObstacle& group : wedge_groups) {
    group.angle_deg = 180;
    for (const BoundarySheets::Wedge& wedge : domain.sheets.wedges) {
      if (std::find(group.edges.begin(), group.edges.end(), wedge.vertices) != group.edges.end()) {
        group.angle_deg = std::min(group.angle_deg, wedge.angle_deg);
      }
    }
  }
  append(std::move(wedge_groups));
  append(FindThinParts(domain));
  append(GroupTets(domain.mesh, ObstacleKind::kCollapsed, domain.collapsed));
  std::vector<int> others;
  for (const int t : flipped) {
    if (!std::binary_search(domain.collapsed.begin(), domain.collapsed.end(), t)) others.push_back(t);
  }
  append(GroupTets(domain.mesh, ObstacleKind::kFlipped, others));
  std::set<int> released;
  for (const BoundarySheets::Face& face : domain.sheets.faces) {
    if (face.is_released && !domain.sheets.sheets[face.sheet].is_released) released.insert(face.tet);
  }
  append(GroupTets(domain.mesh, ObstacleKind::kReleased, {released.begin(), released.end()}));
  if (!parameters.empty()) append(FindShortCurves(domain, parameters));
  return obstacles;
}

}  // namespace octupole
