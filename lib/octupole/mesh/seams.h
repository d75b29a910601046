#pragma once

#include <array>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The feature edges that are seams: CAD models cut closed surfaces open, a torus along two circles, and meshers mark
/// these curves as they mark creases, though the shape has nothing there. A seam is an edge of exactly two of
/// `triangles`, which have normals within `feature_angle_deg` and are surface triangles of the same tag. An edge beside
/// a triangle without a tag is none.
/// \param mesh satisfies CheckTetMesh().
/// \param triangles faces of the mesh, neighbours oriented alike: its BoundaryTriangles, and what interfaces it has.
/// \return edges with the smaller vertex first, in ascending order.
std::vector<std::array<int, 2>> FindSeams(const TetMesh& mesh, const std::vector<std::array<int, 3>>& triangles,
                                          double feature_angle_deg = 40);

}  // namespace octupole
