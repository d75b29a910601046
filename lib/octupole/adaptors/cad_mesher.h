#pragma once

#include <filesystem>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

// The component octupole::gmsh. It links the gmsh library, whose licence is the GPL: a program that links it can only
// be given to others under the GPL's terms.

/// Whether the extension is one of a CAD model that MeshCadModel reads: .step, .stp, .iges, .igs, .brep.
bool IsCadModel(const std::filesystem::path& path);

/// Meshes the volumes of a CAD model with tetrahedra of edges about `size` long, in the model's unit (STEP and IGES:
/// millimetres).
///
/// The regions are the numbers of the model's volumes. Marked as features are the model's creases: the curves
/// between two of its faces whose normals differ there by more than 20 degrees, seen on the model itself, not on its
/// triangles; so neither the seam of a cylinder nor a smooth join is one. Marked points are where three creases meet,
/// or one ends.
///
/// gmsh has one global state: one call at a time, and none while the program uses gmsh itself. Open CASCADE, which
/// reads the files for gmsh, prints complaints about bad ones.
///
/// \throw std::invalid_argument unless size is positive and finite.
/// \throw std::runtime_error naming path and cause when the file cannot be read or meshed, or has no volume.
TetMesh MeshCadModel(const std::filesystem::path& path, double size);

}  // namespace octupole
