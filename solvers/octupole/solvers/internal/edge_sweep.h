#pragma once

#include <cstddef>

#include "octupole/solvers/internal/harmonic_rows.h"
#include "octupole/solvers/internal/neighbour_lists.h"
#include "octupole/solvers/internal/simd.h"

namespace octupole::internal {

// The edges' part of an energy, gathered at one vertex: the inner loop of all sweeps.
//
// AddEdges writes half the gradient of the edges' energy at vertex v, one row, and returns v's share of half that
// energy.

/// Degree 3: with n = |a|^2, weight ((n_a^2 + n_a n_b) / 2 - (a . b)^2) is one direction's share of half of
/// weight |a - b|^2 |a + b|^2.
template <bool kWeighted>
OCTUPOLE_INLINE double AddEdges(const NeighbourLists& lists, const HarmonicRow<3>* rows, std::size_t v,
                                double* gradient) {
  const double* a = rows[v].values;
  const Lanes without_norm = {1, 1, 1, 0};
  const Lanes a0 = LanesAt(a), a1 = LanesAt(a + 4) * without_norm;
  const double norm = a[7];
  Lanes sum0 = {}, sum1 = {}, norms = {};
  for (std::size_t group = lists.first_group[v]; group < lists.first_group[v + 1]; ++group) {
    const int* neighbour = &lists.neighbours[4 * group];
    const double* b[4];
    for (int k = 0; k < 4; ++k) b[k] = rows[neighbour[k]].values;
    const Lanes b00 = LanesAt(b[0]), b01 = LanesAt(b[0] + 4);
    const Lanes b10 = LanesAt(b[1]), b11 = LanesAt(b[1] + 4);
    const Lanes b20 = LanesAt(b[2]), b21 = LanesAt(b[2] + 4);
    const Lanes b30 = LanesAt(b[3]), b31 = LanesAt(b[3] + 4);
    Lanes dots;
    SumLanes(a0 * b00 + a1 * b01, a0 * b10 + a1 * b11, a0 * b20 + a1 * b21, a0 * b30 + a1 * b31, &dots);
    const Lanes norms01 = __builtin_shufflevector(b01, b11, 3, 7, 3, 7);
    const Lanes norms23 = __builtin_shufflevector(b21, b31, 3, 7, 3, 7);
    Lanes norms_b = __builtin_shufflevector(norms01, norms23, 0, 1, 4, 5);
    if (kWeighted) {
      Lanes weights;
      for (int k = 0; k < 4; ++k) weights[k] = lists.weights[4 * group + k];
      dots *= weights;
      norms_b *= weights;
    }
    norms += norms_b;
    sum0 += dots[0] * b00 + dots[1] * b10 + dots[2] * b20 + dots[3] * b30;
    sum1 += dots[0] * b01 + dots[1] * b11 + dots[2] * b21 + dots[3] * b31;
  }
  const double weight_sum = lists.weight_sums[v];
  const double norm_sum = norms[0] + norms[1] + norms[2] + norms[3];
  const Lanes products = a0 * sum0 + a1 * sum1;
  const double squared_dots = products[0] + products[1] + products[2] + products[3];
  LanesAt(gradient) = 2 * (weight_sum * norm + norm_sum) * a0 - 4 * sum0;
  LanesAt(gradient + 4) = 2 * (weight_sum * norm + norm_sum) * a1 - 4 * sum1;
  return (weight_sum * norm * norm + norm * norm_sum) / 2 - squared_dots;
}

/// Degree 4: weight (|a|^2 - a . b) / 2 is one direction's share of half of weight |a - b|^2.
template <bool kWeighted>
OCTUPOLE_INLINE double AddEdges(const NeighbourLists& lists, const HarmonicRow<4>* rows, std::size_t v,
                                double* gradient) {
  const double* a = rows[v].values;
  Lanes sum[3] = {};
  for (std::size_t i = 4 * lists.first_group[v]; i < 4 * lists.first_group[v + 1]; ++i) {
    const double* b = rows[lists.neighbours[i]].values;
    const double weight = kWeighted ? lists.weights[i] : 1;
    for (int k = 0; k < 3; ++k) sum[k] += weight * LanesAt(b + 4 * k);
  }
  Lanes products = {};
  for (int k = 0; k < 3; ++k) {
    const Lanes difference = lists.weight_sums[v] * LanesAt(a + 4 * k) - sum[k];
    LanesAt(gradient + 4 * k) = difference;
    products += difference * LanesAt(a + 4 * k);
  }
  return (products[0] + products[1] + products[2] + products[3]) / 2;
}

}  // namespace octupole::internal
