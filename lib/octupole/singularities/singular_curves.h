#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/singularities/singular_triangles.h"

namespace octupole {

/// How a singular curve ends.
enum class CurveEnd : std::uint8_t {
  kNone = 0,      ///< it is a closed loop
  kBoundary = 1,  ///< in a triangle on the boundary
  kNode = 2,      ///< where curves meet: a SingularNode
  kOpen = 3,      ///< in a tetrahedron that has no other singular face, which the product relation rules out
};

/// A curve through singular triangles, from each to the next through a tetrahedron with no third one.
struct SingularCurve {
  /// That of all its triangles.
  TurnType type = TurnType::kNone;
  /// 3 or 5 for a curve of quarter turns about the axis along which it runs, else 0, see CurveValence.
  int valence = 0;
  /// One in each triangle, and the nodes at its ends. A loop ends with the point that it begins with.
  std::vector<Eigen::Vector3d> points;
  /// Of the polyline.
  double length = 0;
  /// The mean cosine of the axis of the turn with the direction of the curve, weighted by length: 1 where the frame
  /// turns by the right hand around the curve and about it, -1 by the left hand, 0 where the axis is across.
  double mean_cosine = 0;
  std::array<CurveEnd, 2> ends = {};
  bool is_loop() const { return ends[0] == CurveEnd::kNone; }
};

/// A tetrahedron with three or four singular faces, or a singular triangle of more than two tetrahedra.
struct SingularNode {
  Eigen::Vector3d point;
  /// How many curve ends meet here.
  int num_ends = 0;
};

struct SingularCurves {
  std::vector<SingularCurve> curves;
  std::vector<SingularNode> nodes;
};

/// Joins the singular triangles of a field to curves (docs/singularities.md). Every incidence of a singular triangle
/// and a tetrahedron belongs to exactly one curve. The point of a triangle is where the turn, spread linearly over it,
/// has its centre.
///
/// \param frames one rotation per point, its columns the axes.
/// \param triangles of FindSingularTriangles.
/// \throw std::invalid_argument unless there is one frame per point.
SingularCurves TraceSingularCurves(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                                   const std::vector<SingularTriangle>& triangles);

}  // namespace octupole
