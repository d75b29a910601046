#pragma once

#include <cstddef>
#include <vector>

#include "octupole/alignment.h"
#include "octupole/tet_mesh.h"

namespace octupole {

/// How the boundary of a mesh aligns its vertices, and how many vertices came under each case.
struct BoundaryAlignment {
  /// One per point of the mesh; interior and isolated vertices are free.
  std::vector<Alignment> alignments;
  /// Smooth boundary vertices: one axis along the angle-weighted normal.
  std::size_t num_normals = 0;
  /// Transversal feature edges and corners: the whole frame.
  std::size_t num_frames = 0;
  /// Acute or shallow feature edges, where no frame fits the faces: one axis along the feature's tangent.
  std::size_t num_tangents = 0;
  /// Tips: boundary vertices where nothing fits.
  std::size_t num_free = 0;
};

/// The alignment that the boundary asks of each vertex, by the spectral rule (theory.md, section 4).
///
/// A vertex whose incident boundary faces all lie within `feature_angle_deg` of each other in normal is smooth. At any
/// other, the projectors I - U_i U_i^T of the faces' normals are averaged, weighted by the corner angles, and the
/// lowest eigenvectors of that matrix tell how far one frame can meet all the normals:
///  - a frame meets them, split evenly: it is prescribed;
///  - the two lowest eigenvectors belong to one common axis: the normals differ too much for smooth, too little for a
///    frame. With feature edges (dihedral angle between the normals above `feature_angle_deg`) on one line the tangent
///    is prescribed; without any, this is a coarsely sampled smooth surface, and the mean normal is;
///  - neither: the tangent if there is one, else nothing.
/// Normals are unsigned here, and faces of zero area have none.
///
/// \throw std::invalid_argument unless 0 < feature_angle_deg < 180.
BoundaryAlignment AlignToBoundary(const TetMesh& mesh, double feature_angle_deg = 40);

}  // namespace octupole
