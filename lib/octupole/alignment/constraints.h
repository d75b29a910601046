#pragma once

#include <cstddef>
#include <vector>

#include "octupole/alignment/alignment.h"

namespace octupole {

/// An axis or a whole frame that the caller prescribes at a vertex, inside or on the boundary.
struct Constraint {
  int vertex = 0;
  Alignment alignment;
};

/// What the constraints of a field are, and where they contradict the boundary.
struct ConstraintSummary {
  std::size_t num_axes = 0;
  std::size_t num_frames = 0;
  /// How many are farther than kContradictionDeg from the alignment that the vertex had, and the largest of all such
  /// angles (see ContradictionDeg).
  std::size_t num_contradictions = 0;
  double largest_contradiction_deg = 0;
};

/// Normals of meshes and numbers in files are not exact; an angle below this is no contradiction.
inline constexpr double kContradictionDeg = 0.1;

/// How far two alignments are from being met by one frame, in degrees: between an axis and a frame the angle to the
/// frame's nearest axis; between two axes the angle by which they fail to be parallel or perpendicular; between two
/// frames the least turn that takes one to the other. At most 45 between axes, 54.7 and 62.8 else; 0 if one is free.
double ContradictionDeg(const Alignment& a, const Alignment& b);

/// Whether two alignments ask the same to rounding: the same kind, less than 1e-6 degrees apart, and of axes parallel.
bool AreSame(const Alignment& a, const Alignment& b);

/// Puts constraints into the alignments of a mesh. A constraint holds exactly, whatever was there; what it leaves
/// open, the turn about a prescribed axis, follows the alignment that the vertex had as far as it can: along the
/// boundary a tangent makes a frame with the normal, and an axis nearer than 45 degrees to the normal replaces it.
///
/// \throw std::invalid_argument naming the first constraint whose vertex is out of range, that has no alignment (it is
/// free), or that asks of a vertex something else than an earlier one (see AreSame).
ConstraintSummary ApplyConstraints(const std::vector<Constraint>& constraints, std::vector<Alignment>* alignments);

}  // namespace octupole
