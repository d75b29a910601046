#include "octupole/maps/map_domain.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "octupole/field/tet_frames.h"
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

void FindStructure(FramedMesh* framed, MapDomain* domain) {
  framed->matched.neighbours = TetNeighbours(framed->mesh);
  domain->rings = FindEdgeRings(framed->mesh, framed->matched.neighbours);
  domain->singular_edges = FindSingularEdges(framed->mesh, framed->matched, domain->rings);
  if (StraightenSingularEdges(domain->rings, domain->singular_edges, framed)) {
    domain->singular_edges = FindSingularEdges(framed->mesh, framed->matched, domain->rings);
  }
  domain->sheets = FindBoundarySheets(framed->mesh, framed->matched, domain->rings);
}

}  // namespace

MapDomain MakeMapDomain(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  MapDomain domain;
  FramedMesh framed;
  framed.mesh = Oriented(mesh);
  framed.point_frames = frames;
  framed.matched = MatchTets(framed.mesh, TetFrames(framed.mesh, frames));
  framed.parents.resize(mesh.tets.size());
  std::iota(framed.parents.begin(), framed.parents.end(), 0);
  // What splitting at vertices leaves may need splitting again, and less each time.
  constexpr int kMaxRounds = 12;
  FindStructure(&framed, &domain);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (!SplitForMap(domain.rings, domain.singular_edges, domain.sheets, &framed)) break;
    FindStructure(&framed, &domain);
  }
  domain.combed = CombFrames(framed.mesh, framed.matched);
  // The outward axes in the combed frames' names.
  domain.sheets = FindBoundarySheets(framed.mesh, domain.combed, domain.rings);
  domain.mesh = std::move(framed.mesh);
  domain.parents = std::move(framed.parents);
  domain.cut = CutForMap(domain.mesh, domain.combed, domain.rings);
  domain.unknowns =
      EliminateConstraints(domain.mesh, domain.combed, domain.cut, domain.sheets, domain.rings, domain.singular_edges);
  domain.collapsed = FindCollapsedTets(domain.mesh, domain.cut, domain.unknowns);
  return domain;
}

}  // namespace octupole
