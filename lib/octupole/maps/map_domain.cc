#include "octupole/maps/map_domain.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/field/tet_frames.h"
#include "octupole/maps/boundary_curves.h"
#include "octupole/maps/map_splits.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

// The mesh with all tetrahedra of positive volume.
TetMesh Oriented(TetMesh mesh) {
  CheckTetMesh(mesh);
  const std::vector<double> volumes = SixfoldVolumes(mesh);
  const auto num_negative = std::count_if(volumes.begin(), volumes.end(), [](double v) { return v < 0; });
  const bool is_mirrored = 2 * static_cast<std::size_t>(num_negative) > volumes.size();
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    if (is_mirrored ? volumes[t] < 0 : volumes[t] > 0) {
      if (is_mirrored) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
      continue;
    }
    std::ostringstream message;
    message << "MakeMapDomain: tetrahedron " << t << " at " << mesh.points[mesh.tets[t][0]].transpose() << " is "
            << (volumes[t] == 0 ? "flat" : "inverted") << ": its volume is " << volumes[t] / 6;
    throw std::invalid_argument(message.str());
  }
  return mesh;
}

// Marks the faces of the tetrahedra that are among the triangles.
std::vector<std::array<bool, 4>> FindFaces(const TetMesh& mesh, std::vector<std::array<int, 3>> triangles) {
  for (std::array<int, 3>& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  std::sort(triangles.begin(), triangles.end());
  std::vector<std::array<bool, 4>> found(mesh.tets.size(), {false, false, false, false});
  if (triangles.empty()) return found;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      std::array<int, 3> face;
      for (int k = 0; k < 3; ++k) face[k] = mesh.tets[t][(i + k + 1) % 4];
      std::sort(face.begin(), face.end());
      found[t][i] = std::binary_search(triangles.begin(), triangles.end(), face);
    }
  }
  return found;
}

// Where the map would have an angle of 0, and along the bend from there.
bool ReleaseFlatCorners(const BoundarySheets& sheets, FramedMesh* framed) {
  for (const BoundarySheets::FlatCorner& corner : sheets.flat_corners) {
    framed->released_vertices.insert(corner.bend.begin(), corner.bend.end());
  }
  return !sheets.flat_corners.empty();
}

void FindStructure(bool are_nodes_final, FramedMesh* framed, MapDomain* domain) {
  framed->matched.neighbours = TetNeighbours(framed->mesh);
  domain->rings = FindEdgeRings(framed->mesh, framed->matched.neighbours);
  domain->singular_edges = FindSingularEdges(framed->mesh, framed->matched, domain->rings);
  if (StraightenSingularEdges(domain->rings, domain->singular_edges, framed)) {
    domain->singular_edges = FindSingularEdges(framed->mesh, framed->matched, domain->rings);
  }
  const auto find_sheets = [&] {
    domain->sheets = FindBoundarySheets(framed->mesh, framed->matched, domain->rings, framed->is_interface,
                                        framed->released_vertices);
  };
  find_sheets();
  if (TakeCurvesToBoundary(domain->rings, domain->singular_edges, domain->sheets, are_nodes_final, framed)) {
    domain->singular_edges = FindSingularEdges(framed->mesh, framed->matched, domain->rings);
    find_sheets();
  }
  if (ReleaseFlatCorners(domain->sheets, framed)) find_sheets();
  // No feature holds parameters at a released vertex, either.
  const auto is_released = [&](int v) { return framed->released_vertices.count(v) > 0; };
  auto& features = framed->mesh.feature_edges;
  features.erase(std::remove_if(features.begin(), features.end(),
                                [&](const auto& edge) { return is_released(edge[0]) || is_released(edge[1]); }),
                 features.end());
}

// The cut and the unknowns, and what is flat in spite of them.
void CutAndEliminate(const FramedMesh& framed, MapDomain* domain) {
  const TetMesh& mesh = framed.mesh;
  domain->combed = CombFrames(mesh, framed.matched);
  // The outward axes in the combed frames' names.
  domain->sheets =
      FindBoundarySheets(mesh, domain->combed, domain->rings, framed.is_interface, framed.released_vertices);
  domain->cut = CutForMap(mesh, domain->combed, domain->rings);
  domain->unknowns =
      EliminateConstraints(mesh, domain->combed, domain->cut, domain->sheets, domain->rings, domain->singular_edges);
  domain->collapsed = FindCollapsedTets(mesh, domain->cut, domain->unknowns);
}

// Releases vertices of the boundary, those at most of the flat tetrahedra first, until each of these that is at the
// boundary has one.
bool ReleaseVertices(const std::vector<int>& collapsed, const BoundarySheets& sheets, FramedMesh* framed) {
  std::set<int> held;
  for (const BoundarySheets::Face& face : sheets.faces) {
    for (int k = 0; k < 4; ++k) {
      if (k != face.corner && !face.is_released) held.insert(framed->mesh.tets[face.tet][k]);
    }
  }
  std::map<int, std::set<int>> tets_of;
  for (const int t : collapsed) {
    for (const int v : framed->mesh.tets[t]) {
      if (held.count(v) > 0) tets_of[v].insert(t);
    }
  }
  const bool has_changed = !tets_of.empty();
  while (!tets_of.empty()) {
    const auto most = std::max_element(tets_of.begin(), tets_of.end(),
                                       [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    framed->released_vertices.insert(most->first);
    const std::set<int> done = most->second;
    for (auto i = tets_of.begin(); i != tets_of.end();) {
      for (const int t : done) i->second.erase(t);
      i = i->second.empty() ? tets_of.erase(i) : std::next(i);
    }
  }
  return has_changed;
}

// All that is left to do once there are matches.
MapDomain Finish(FramedMesh framed) {
  MapDomain domain;
  // What splitting at vertices leaves may need splitting again, and less each time.
  constexpr int kMaxRounds = 24;
  FindStructure(false, &framed, &domain);
  int num_splits = 0;
  for (int round = 0;; ++round) {
    if (round < kMaxRounds && SplitForMap(domain.rings, domain.singular_edges, domain.sheets, &framed)) {
      FindStructure(round > kMaxRounds / 2, &framed, &domain);
      continue;
    }
    CutAndEliminate(framed, &domain);
    if (domain.collapsed.empty() || round >= kMaxRounds) break;
    constexpr int kMaxSplits = 3;
    if (num_splits++ < kMaxSplits) {
      SplitTets(domain.collapsed, domain.rings, domain.singular_edges, domain.sheets, &framed);
    } else if (!ReleaseVertices(domain.collapsed, domain.sheets, &framed)) {
      break;
    }
    FindStructure(round > kMaxRounds / 2, &framed, &domain);
  }
  domain.mesh = std::move(framed.mesh);
  domain.parents = std::move(framed.parents);
  domain.released_vertices = std::move(framed.released_vertices);
  return domain;
}

}  // namespace

MapDomain MakeMapDomain(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                        const BoundaryOptions& boundary) {
  FramedMesh framed;
  framed.mesh = Oriented(mesh);
  BoundaryAlignment aligned = AlignToBoundary(framed.mesh, boundary);
  framed.mesh.feature_edges = std::move(aligned.feature_edges);
  framed.is_interface = FindFaces(framed.mesh, std::move(aligned.interfaces.triangles));
  framed.point_frames = frames;
  framed.matched = MatchTets(framed.mesh, TetFrames(framed.mesh, frames));
  framed.parents.resize(mesh.tets.size());
  std::iota(framed.parents.begin(), framed.parents.end(), 0);
  return Finish(std::move(framed));
}

MapDomain RefineMapDomain(const MapDomain& domain, const std::vector<int>& tets) {
  FramedMesh framed;
  framed.mesh = domain.mesh;
  framed.matched = domain.combed;
  framed.released_vertices = domain.released_vertices;
  framed.parents.resize(domain.mesh.tets.size());
  std::iota(framed.parents.begin(), framed.parents.end(), 0);
  framed.point_frames.assign(domain.mesh.points.size(), Eigen::Matrix3d::Identity());
  for (std::size_t t = 0; t < domain.mesh.tets.size(); ++t) {
    for (const int v : domain.mesh.tets[t]) framed.point_frames[v] = domain.combed.frames[t];
  }
  framed.is_interface.assign(domain.mesh.tets.size(), {});
  for (const BoundarySheets::Face& face : domain.sheets.faces) {
    const int s = domain.combed.neighbours[face.tet][face.corner];
    if (s < 0) continue;
    framed.is_interface[face.tet][face.corner] = true;
    framed.is_interface[s][CornerAcross(domain.mesh, domain.combed.neighbours, face.tet, face.corner)] = true;
  }
  SplitTets(tets, domain.rings, domain.singular_edges, domain.sheets, &framed);
  return Finish(std::move(framed));
}

}  // namespace octupole
