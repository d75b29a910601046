#pragma once

#include <cstddef>
#include <vector>

#include "octupole/maps/boundary_sheets.h"
#include "octupole/maps/combed_frames.h"
#include "octupole/maps/edge_turns.h"
#include "octupole/maps/map_cut.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The parameters of a seamless map as linear combinations of unknowns without constraints: u = A y. Whatever y is,
/// seams and boundary hold to rounding.
struct MapUnknowns {
  struct Term {
    int unknown;
    double factor;
  };

  int num_unknowns = 0;
  /// Parameter k of node n is row 3 n + k: the terms from begin[3 n + k] up to begin[3 n + k + 1].
  std::vector<std::size_t> begin;
  std::vector<Term> terms;
  /// Of every unknown whether an integer-grid map needs it whole: those on which sheets, singular edges or the shifts
  /// of the cut depend.
  std::vector<bool> is_integer;
  /// Combinations that need be whole, but have a fraction among their factors, so that whole unknowns do not suffice.
  int num_fractional = 0;

  /// A y, three parameters per node.
  std::vector<double> Parameters(const std::vector<double>& y) const;
};

/// Eliminates the constraints: across a cut face u_t = g^T u_s + shift, one shift for each patch; on a sheet one value
/// of the outward axis' parameter; and along a feature edge of the mesh that is within 30 degrees of an axis the
/// parameters of the other two are constant. Parameters that a constraint of two joins become one up to sign and
/// shifts; what is left are a few equations between those and the shifts, which are solved exactly, with pivots of
/// factor 1 wherever there is one, so that the unknowns being whole all are.
MapUnknowns EliminateConstraints(const TetMesh& mesh, const CombedFrames& combed, const MapCut& cut,
                                 const BoundarySheets& sheets, const EdgeRings& rings,
                                 const std::vector<SingularEdge>& singular_edges);

/// The tetrahedra that are flat in every map: with those constraints their volume vanishes whatever the unknowns.
std::vector<int> FindCollapsedTets(const TetMesh& mesh, const MapCut& cut, const MapUnknowns& unknowns);

}  // namespace octupole
