#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace octupole::internal {

// A cell and the nodes on it as points of a lattice of 3 x 3 x 3, numbered x + 3 y + 9 z.

inline constexpr int LatticeNumber(int x, int y, int z) { return x + 3 * y + 9 * z; }

/// The eight corners, as bits.
inline constexpr std::uint32_t kCornerBits =
    1u << 0 | 1u << 2 | 1u << 6 | 1u << 8 | 1u << 18 | 1u << 20 | 1u << 24 | 1u << 26;

/// An edge between two points of a cell's lattice.
struct Spring {
  int a;
  int b;
  double weight;
};

/// Edges that stand for the energy of a cell that touches smaller ones, and so has nodes in the middle of its edges and
/// faces.
///
/// Let the cell have unit width, phi_i be continuous functions on its surface, 1 at node i and 0 at the others,
/// that sum to 1 and reproduce linear functions, and m_i the integral of phi_i times the outward normal. Then for
/// linear u the edges' weights w are such that, at each node i,
///
///     sum over j of w_ij (u_j - u_i) = -m_i . grad u.
///
/// The two cells at a face have the same phi there, so that what they ask of its nodes cancels: a linear function is in
/// balance at every inner node, whatever the sizes of the cells around. And its energy is the volume times |grad u|^2.
/// On a face that is cut into four phi_i is bilinear on each part. On another it is bilinear but for a hat along each
/// edge that has a node in the middle, of integral 1/8.
///
/// The weights are the non-negative solution of these equations by C. Lawson and R. Hanson, *Solving Least Squares
/// Problems*, 1974, chapter 23, over pairs of nodes no further apart than a corner and the middle of a face that does
/// not have it. (With the corners alone, the cell's edges with weight 1/4 are a solution.)
class CellSprings {
 public:
  /// \param nodes the lattice points that are nodes, as bits: the corners, middles of edges, and middles of faces whose
  /// edges have theirs.
  const std::vector<Spring>& Of(std::uint32_t nodes);

 private:
  std::map<std::uint32_t, std::vector<Spring>> springs_of_;
};

}  // namespace octupole::internal
