#include "octupole/map_solvers/internal/map_transfer.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>

#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole::internal {
namespace {

// The parameters of a map at the nodes of a finer domain of it (RefineMapDomain), whose axes and cut are others: they
// go on from tetrahedron to tetrahedron across faces that are not cut.
std::vector<double> NodeParameters(const MapDomain& domain, const CornerParameters& parameters,
                                   const MapDomain& finer) {
  std::vector<double> result(3 * static_cast<std::size_t>(finer.cut.num_nodes), 0);
  const auto at = [&](int node) { return Eigen::Map<Eigen::Vector3d>(&result[3 * static_cast<std::size_t>(node)]); };
  std::vector<bool> is_reached(finer.mesh.tets.size(), false);
  std::vector<int> queue;
  // With a corner whose parameters are known, if there is one.
  const auto reach = [&](int t, int known) {
    is_reached[t] = true;
    queue.push_back(t);
    const int parent = finer.parents[t];
    const std::array<int, 4>& whole = domain.mesh.tets[parent];
    const Eigen::Vector3d& origin = domain.mesh.points[whole[0]];
    Eigen::Matrix3d edges, images;
    for (int i = 0; i < 3; ++i) {
      edges.col(i) = domain.mesh.points[whole[i + 1]] - origin;
      images.col(i) = parameters[parent][i + 1] - parameters[parent][0];
    }
    const Eigen::Matrix3d renamed =
        MatchFrames(domain.combed.frames[parent], finer.combed.frames[t]).matrix().transpose() * images *
        edges.inverse();
    const auto image = [&](int i) -> Eigen::Vector3d {
      return renamed * (finer.mesh.points[finer.mesh.tets[t][i]] - origin);
    };
    const Eigen::Vector3d shift =
        known < 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(at(finer.cut.nodes[t][known]) - image(known));
    for (int i = 0; i < 4; ++i) at(finer.cut.nodes[t][i]) = image(i) + shift;
  };
  for (int root = 0; root < static_cast<int>(is_reached.size()); ++root) {
    if (is_reached[root]) continue;
    std::size_t next = queue.size();
    for (reach(root, -1); next < queue.size(); ++next) {
      const int t = queue[next];
      for (int i = 0; i < 4; ++i) {
        const int s = finer.combed.neighbours[t][i];
        if (s < 0 || is_reached[s] || !finer.combed.is_in_tree[t][i]) continue;
        reach(s, CornerOf(finer.mesh.tets[s], finer.mesh.tets[t][(i + 1) % 4]));
      }
    }
  }
  return result;
}

// The unknowns of parameters at nodes, one by one from rows in which it is the only one left; what no row tells is 0.
Vector FindUnknowns(const MapUnknowns& unknowns, const std::vector<double>& parameters) {
  Vector y(unknowns.num_unknowns, 0);
  std::vector<bool> is_known(y.size(), false);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t row = 0; row < parameters.size(); ++row) {
      double rest = parameters[row];
      const MapUnknowns::Term* open = nullptr;
      int num_open = 0;
      for (std::size_t i = unknowns.begin[row]; i < unknowns.begin[row + 1]; ++i) {
        const MapUnknowns::Term& term = unknowns.terms[i];
        if (is_known[term.unknown]) {
          rest -= term.factor * y[term.unknown];
        } else {
          open = &term;
          ++num_open;
        }
      }
      if (num_open != 1) continue;
      y[open->unknown] = rest / open->factor;
      is_known[open->unknown] = has_changed = true;
    }
  }
  return y;
}

}  // namespace

Vector TransferMap(const MapDomain& domain, const CornerParameters& parameters, const MapDomain& finer) {
  return FindUnknowns(finer.unknowns, NodeParameters(domain, parameters, finer));
}

}  // namespace octupole::internal
