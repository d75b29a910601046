#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// One frame per tetrahedron and how they match across faces.
///
/// Parameters u of a map have gradients along the frames, grad u_k = (column k of F) / H. With the match g across a
/// face from s to t, F_s g ~ F_t, a seamless map has u_t = g^T u_s + shift on the face.
struct MatchedFrames {
  std::vector<std::array<int, 4>> neighbours;
  std::vector<Eigen::Matrix3d> frames;
  /// Across the face opposite each corner, as an index into OctahedralGroup(); 0, the identity, on the boundary. The
  /// matches of the two sides of a face are inverse to each other.
  std::vector<std::array<std::uint8_t, 4>> matches;

  const OctahedralRotation& match(int tet, int corner) const { return OctahedralGroup()[matches[tet][corner]]; }
  /// Sets the match across a face, and that of its other side.
  void SetMatch(const TetMesh& mesh, int tet, int corner, const OctahedralRotation& match);
};

/// Matches the frames of neighbours by MatchFrames.
/// \param mesh satisfies CheckTetMesh().
/// \param tet_frames one rotation per tetrahedron (see TetFrames).
/// \throw std::invalid_argument unless there is one frame per tetrahedron and all are rotations, and as TetNeighbours.
MatchedFrames MatchTets(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& tet_frames);

/// Matched frames, the axes named so that neighbours agree wherever that can be.
struct CombedFrames : MatchedFrames {
  /// Whether the face opposite each corner joins the tetrahedra of the spanning trees, one for each component, along
  /// which the frames were combed. All their matches are the identity.
  std::vector<std::array<bool, 4>> is_in_tree;
  /// The component of each tetrahedron, joined across faces, counted from 0.
  std::vector<int> component;
  int num_components = 0;
};

/// Combs frames along spanning trees, breadth first: F becomes F g with a g in S4, and matches change with them.
CombedFrames CombFrames(const TetMesh& mesh, const MatchedFrames& matched);

}  // namespace octupole
