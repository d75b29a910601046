#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "octupole/alignment/interfaces.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/singularities/surface_singularities.h"

namespace octupole {

/// What a tet mesh holds, and what a field on it will follow. What `octupole info` says.
struct MeshSummary {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;
  std::size_t boundary_triangles = 0;
  Eigen::AlignedBox3d bounding_box;
  /// How many tetrahedra have each region tag.
  std::map<int, std::size_t> tets_of_region;
  /// The components of the boundary; of these, all that does not depend on a field.
  std::vector<SurfaceComponent> shells;
  /// What is odd, and the number of tetrahedra and of their components.
  MeshInspection inspection;
  /// Without options: those that AlignToBoundary follows by default.
  Interfaces interfaces;
  /// Marked edges that are seams (FindSeams), and feature edges of the boundary by their angle (AlignToSurface).
  std::size_t seams = 0;
  std::size_t sharp_edges = 0;
  /// Of the MeanRatios.
  double least_mean_ratio = 0;
  double average_mean_ratio = 0;
  double largest_mean_ratio = 0;
};

/// \param mesh satisfies CheckTetMesh().
MeshSummary SummarizeMesh(const TetMesh& mesh);

}  // namespace octupole
