#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "octupole/maps/map_domain.h"
#include "octupole/maps/map_quality.h"

namespace octupole::internal {

using Vector = std::vector<double>;

/// A part of a map to solve for: some of its unknowns, the tetrahedra that depend on them, and what the others, which
/// are held, add to their parameters: u = A x + offset.
struct MapSystem {
  /// Of the domain's unknowns.
  std::vector<int> free;
  /// Of the domain's mesh, and their corners as nodes of this part.
  std::vector<int> tets;
  std::vector<std::array<int, 4>> nodes;
  std::size_t num_nodes = 0;
  /// Parameter k of node n is row 3 n + k: the terms from begin[3 n + k] up to begin[3 n + k + 1], their unknowns
  /// numbered as in `free`.
  std::vector<std::size_t> begin;
  std::vector<MapUnknowns::Term> terms;
  Vector offset;

  std::size_t num_unknowns() const { return free.size(); }
  /// The values of the free ones, and back.
  Vector Part(const Vector& y) const;
  void PutPart(const Vector& x, Vector* y) const;
};

/// \param y the domain's unknowns: what those that are held are.
/// Tetrahedra that are flat in every map are left out.
MapSystem MakeMapSystem(const MapDomain& domain, const Vector& y, const std::vector<bool>& is_free);

/// Which unknowns drive parameters of no other vertices than those `num_rings` edges from the tetrahedra.
std::vector<bool> FindUnknownsAround(const MapDomain& domain, const std::vector<int>& tets, int num_rings);

/// The map of a domain's unknowns at the corners of its tetrahedra.
CornerParameters ParametersAtCorners(const MapDomain& domain, const Vector& y);

}  // namespace octupole::internal
