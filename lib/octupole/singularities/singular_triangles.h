#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// A triangle that a singular curve crosses.
struct SingularTriangle {
  /// In ascending order.
  std::array<int, 3> vertices;
  /// The type of its holonomy, never kNone.
  TurnType type;
  /// The tetrahedra that have it as a face: one on the boundary, two inside, more where the mesh is not a manifold.
  std::vector<int> tets;
};

/// The triangles of a field whose holonomy is not the identity, in lexicographic order.
///
/// A tetrahedron with all frames less than 22.5 degrees from that of its first vertex has no singular face: renamed as
/// that frame's, its frames match as they are. What certifies that is cheap (see HolonomyType), and all that most of a
/// mesh needs.
///
/// \param frames one rotation per point, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per point.
std::vector<SingularTriangle> FindSingularTriangles(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
