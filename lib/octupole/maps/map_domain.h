#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/maps/boundary_sheets.h"
#include "octupole/maps/combed_frames.h"
#include "octupole/maps/edge_turns.h"
#include "octupole/maps/map_cut.h"
#include "octupole/maps/map_unknowns.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// All that is combinatorial about the seamless map of a frame field.
struct MapDomain {
  /// The mesh that is mapped: all tetrahedra of positive volume, and those split that would be flat in every map (see
  /// SplitForMap). Its first points are those of the mesh it was made of; its feature edges are those that hold
  /// parameters constant.
  TetMesh mesh;
  /// The tetrahedron of the caller's mesh that each of them is a part of.
  std::vector<int> parents;
  CombedFrames combed;
  EdgeRings rings;
  std::vector<SingularEdge> singular_edges;
  BoundarySheets sheets;
  MapCut cut;
  MapUnknowns unknowns;
  /// Vertices of the boundary whose faces hold no parameter constant, as no map that does so keeps all tetrahedra from
  /// being flat.
  std::set<int> released_vertices;
  /// Tetrahedra that are flat in every map all the same.
  std::vector<int> collapsed;
};

/// \param mesh any mesh that satisfies CheckTetMesh(), with tetrahedra of one orientation; several components are
///     mapped each for itself.
/// \param frames one rotation per point, its columns the axes.
/// \param boundary which feature edges and interfaces hold parameters constant: those that AlignToBoundary finds.
/// \throw std::invalid_argument unless there is one frame per point and all are rotations; naming the first tetrahedron
///     that is flat or inverted against the others, or a triangle that belongs to more than two tetrahedra.
MapDomain MakeMapDomain(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                        const BoundaryOptions& boundary = {});

/// The domain with more vertices, where a map needs them to turn over no tetrahedron: of each of `tets` an inner edge
/// is split (SplitTets). `parents` are tetrahedra of `domain`.
MapDomain RefineMapDomain(const MapDomain& domain, const std::vector<int>& tets);

}  // namespace octupole
