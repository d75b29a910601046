#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "octupole/alignment/alignment.h"
#include "octupole/alignment/interfaces.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

/// How many vertices came under each case of AlignToSurface.
struct AlignmentCounts {
  /// Smooth vertices: one axis along the angle-weighted normal.
  std::size_t num_normals = 0;
  /// Transversal feature edges and corners: the whole frame.
  std::size_t num_frames = 0;
  /// Acute or shallow feature edges, where no frame fits the faces: one axis along the feature's tangent.
  std::size_t num_tangents = 0;
  /// Tips: vertices where nothing fits.
  std::size_t num_free = 0;
};

/// How a surface, such as the boundary of a mesh, aligns the vertices, and how many came under each case.
struct BoundaryAlignment : AlignmentCounts {
  /// One per point; those off the surface are free, but for marked edges.
  std::vector<Alignment> alignments;
  /// Whether features were marked, or found by their angle; and the feature edges.
  bool has_marked_features = false;
  std::vector<std::array<int, 2>> feature_edges;
  // Of a tet mesh:
  /// BoundaryTriangles of the mesh.
  std::vector<std::array<int, 3>> boundary_triangles;
  /// Marked edges that are seams (FindSeams), which prescribe nothing and are no feature edges.
  std::size_t num_seam_edges = 0;
  /// The surfaces inside, and of the above the vertices on them.
  Interfaces interfaces;
  AlignmentCounts interface_vertices;
};

/// Whether the edges at which a surface is open align the field.
enum class OpenBoundary { kAligned, kFree };

/// The alignment that a surface asks of each of its points, by the spectral rule (theory.md, section 4).
///
/// A vertex whose incident triangles all lie within `feature_angle_deg` of each other in normal is smooth. At any
/// other, the projectors I - U_i U_i^T of the triangles' normals are averaged, weighted by the corner angles, and the
/// lowest eigenvectors of that matrix tell how far one frame can meet all the normals:
///  - a frame meets them, split evenly: it is prescribed;
///  - the two lowest eigenvectors belong to one common axis: the normals differ too much for smooth, too little for a
///    frame. With feature edges on one line the tangent is prescribed; without any, this is a coarsely sampled smooth
///    surface, and the mean normal is;
///  - neither: the tangent if there is one, else nothing.
/// Normals are unsigned here, and triangles of zero area have none.
///
/// Feature edges are the marked ones, if any edge is marked; otherwise those with an angle between the normals above
/// `feature_angle_deg`. A marked edge aligns the field even where the surface is smooth, and off the surface:
///  - at a smooth vertex the frame is prescribed by the normal and the marked edges' common direction up to quarter
///    turns; where they have none, as when two curves cross at 45 degrees, the normal alone is;
///  - off the surface the axis along the edges is prescribed, or the frame where they meet as axes of one.
/// Marked points prescribe nothing: a point has no direction.
///
/// The edges at which the surface is open, aligned, align the field as marked edges do. They are no feature edges.
///
/// Triangles may have either orientation; normals that are opposite are far from each other, though.
/// \param surface satisfies CheckTriangleMesh(), but may have no triangles.
/// \throw std::invalid_argument unless 0 < feature_angle_deg < 180.
BoundaryAlignment AlignToSurface(const TriangleMesh& surface, double feature_angle_deg = 40,
                                 OpenBoundary open_boundary = OpenBoundary::kAligned);

struct BoundaryOptions {
  double feature_angle_deg = 40;
  RegionUse regions = RegionUse::kAutomatic;
  /// That features are marked although this mesh has none: it is a part of one where others do.
  bool has_marked_features = false;
};

/// AlignToSurface of one surface that consists of the boundary and the interfaces inside the mesh (FindInterfaces): so
/// an interface aligns its vertices as the boundary does, and where interfaces meet each other or the boundary, the
/// rule for sharp edges and corners holds. Seams among the marked edges (FindSeams) do not count as marked. Where
/// others are marked, so are the sharp edges at which an interface meets another or the boundary, whether the file
/// marks them or not.
/// \param mesh satisfies CheckTetMesh().
/// \throw std::invalid_argument unless 0 < feature_angle_deg < 180.
BoundaryAlignment AlignToBoundary(const TetMesh& mesh, const BoundaryOptions& options = {});

}  // namespace octupole
