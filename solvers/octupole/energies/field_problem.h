#pragma once

#include <ceres/problem.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// The weights w1 and w2 of the penalty w1 (|a|^2 - 1)^2 + w2 d(a) at each vertex (paper, eq. 4.1). Smoothness terms
/// carry the weights of the graph's edges.
struct EnergyWeights {
  double scale = 5;
  /// In degree 3 scale / 20 makes the penalty equally stiff in all directions off the manifold (theory.md, section 2).
  double deviation = 0.25;
};

/// The unknowns of a field energy at a vertex by its AlignmentKind, for SizeOfProblem.
template <int kDegree>
inline constexpr std::array<std::size_t, 3> kUnknownsOfKind = {kDimension<kDegree>, 2, 0};

/// A starting field: at each vertex the harmonic of a uniformly random frame that keeps to the vertex's alignment.
template <int kDegree>
std::vector<Harmonic<kDegree>> RandomField(const FieldGraph& graph, std::uint32_t seed);
/// The same from the vertices' alignments.
template <int kDegree>
std::vector<Harmonic<kDegree>> RandomField(const std::vector<Alignment>& alignments, std::uint32_t seed);

/// Throws std::invalid_argument, its message beginning with `caller`, unless `field` has one finite value per vertex.
template <int kDegree>
void CheckField(const char* caller, const FieldGraph& graph, const std::vector<Harmonic<kDegree>>& field);

/// Fills `problem` with the field energy of a graph (cost_weight.h states it), with hard alignments:
///  - an AnalyticSmoothnessCost for every edge of positive weight, one cost object for each distinct weight,
///  - a ScaleCost at every vertex whose frame is not prescribed, and an AnalyticDeviationCost at every free
///    one (on the subspace of an axis the scale term alone leaves just the octahedral harmonics),
///  - an AlignmentManifold where an axis is prescribed; a constant block where a frame is.
///
/// `field` holds the starting values, and the solution after solving: its elements are the parameter blocks, so it must
/// outlive the problem and not be resized. Values are first moved onto the subspaces that the alignments allow.
/// The caller owns the problem, can add terms of their own and solve as they like. Smoothness, scale and deviation
/// costs and the manifolds belong to the problem, as is the default of ceres::Problem::Options.
///
/// \throw std::invalid_argument when the graph is malformed (see CheckFieldGraph), the field has another size or a
/// value that is not finite, or a weight is negative or not finite. The problem is unchanged then.
template <int kDegree>
void BuildFieldProblem(const FieldGraph& graph, const EnergyWeights& weights, std::vector<Harmonic<kDegree>>* field,
                       ceres::Problem* problem);

}  // namespace octupole
