#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Whether faces inside a mesh become interfaces: those between its regions and those tagged as surfaces.
enum class RegionUse {
  /// If they make surfaces, see FindInterfaces.
  kAutomatic,
  kFollow,
  kIgnore,
};

/// Faces inside a mesh that may be interfaces.
struct InnerFaces {
  std::size_t count = 0;
  /// The share of their vertices that are in order, see FindInterfaces.
  double fitting_share = 0;
  bool are_followed = false;
};

/// The surfaces inside a mesh at which materials meet.
struct Interfaces {
  /// Faces of tetrahedra, each once. Neighbours across an edge of exactly two are oriented alike, as far as that goes:
  /// a Moebius strip has a seam.
  std::vector<std::array<int, 3>> triangles;
  /// What they came from; a face may be both. Not looked for when they are to be ignored.
  InnerFaces between_regions;
  InnerFaces tagged;
  /// How many regions the mesh has.
  std::size_t num_regions = 0;
};

/// The faces between tetrahedra of different regions, and the surface triangles that are faces inside the mesh.
///
/// Numbers of tetrahedra are not always materials: they may be those of the parts of a partition, or count the
/// tetrahedra. Materials meet in surfaces, parts in ragged sets of faces to whose normals no frame can keep. So
/// kAutomatic follows the faces between regions, all or none, if half of their vertices or more are in order: the
/// normals there are within `feature_angle_deg` of each other up to sign, or one frame can meet them, which is to say
/// that the lowest eigenvalue of the averaged projectors (theory.md, section 4) is at most 1/4, as of two normals at 60
/// degrees. Right-angled edges have 0, the parts of METIS mostly more than 0.3. Likewise, by themselves, the tagged
/// triangles, since some files list every face of the mesh. Of very many vertices about a thousand are looked at.
/// \param mesh satisfies CheckTetMesh().
/// \param boundary_triangles the BoundaryTriangles of the mesh.
Interfaces FindInterfaces(const TetMesh& mesh, const std::vector<std::array<int, 3>>& boundary_triangles,
                          RegionUse use = RegionUse::kAutomatic, double feature_angle_deg = 40);

/// A line for the user about each kind of faces that kAutomatic does not follow.
std::vector<std::string> InterfaceWarnings(const Interfaces& interfaces);

}  // namespace octupole
