#pragma once

#include <cstddef>

#include "octupole/energies/internal/harmonic_rows.h"
#include "octupole/energies/internal/sweep_graph.h"
#include "octupole/minimization/internal/simd.h"

namespace octupole::internal {

/// Coefficient by coefficient the rows row_of(0), row_of(1) ... of as many vertices as there are lanes, each
/// kNumLanes vectors long: one vertex per lane.
template <int kNumLanes, typename Scalar, typename RowOf>
OCTUPOLE_INLINE void LanesOfRows(const RowOf& row_of, Lanes<Scalar>* lanes) {
  constexpr int kStep = kLanes<Scalar>;
  for (int j = 0; j < kNumLanes; ++j) {
    for (int k = 0; k < kStep; ++k) lanes[kStep * j + k] = LanesAt(row_of(k) + kStep * j);
    TransposeLanes(lanes + kStep * j);
  }
}

// The edges' part of an energy, gathered at one vertex: the inner loop of all sweeps.
//
// AddEdges writes half the gradient of the edges' energy at vertex v, one row, and returns v's share of half that
// energy.

/// Degree 3: with n = |a|^2, weight ((n_a^2 + n_a n_b) / 2 - (a . b)^2) is one direction's share of half of
/// weight |a - b|^2 |a + b|^2.
template <bool kWeighted, typename Scalar>
OCTUPOLE_INLINE double AddEdges(const SweepGraph& graph, const HarmonicRow<3, Scalar>* rows, std::size_t v,
                                Scalar* gradient) {
  constexpr int kNumLanes = HarmonicRow<3, Scalar>::kNumLanes;
  constexpr int kLast = kLanes<Scalar> - 1;
  Lanes<Scalar> a[kNumLanes], sum[kNumLanes] = {}, last = {};
  for (int j = 0; j < kNumLanes; ++j) a[j] = LanesAt(rows[v].values + j * kLanes<Scalar>);
  // Not the norm.
  a[kNumLanes - 1][kLast] = 0;
  for (int group = graph.first_group[v]; group < graph.first_group[v + 1]; ++group) {
    const std::size_t first = 4 * static_cast<std::size_t>(group);
    Lanes<Scalar> b[4][kNumLanes], products[4];
    for (int k = 0; k < 4; ++k) {
      products[k] = Lanes<Scalar>{};
      for (int j = 0; j < kNumLanes; ++j) {
        b[k][j] = LanesAt(rows[graph.neighbours[first + k]].values + j * kLanes<Scalar>);
        products[k] += a[j] * b[k][j];
      }
    }
    typename LanesOf<Scalar>::Four dots;
    SumLanes(products, &dots);
    for (int k = 0; k < 4; ++k) {
      const Scalar weight = kWeighted ? static_cast<Scalar>(graph.weights[first + k]) : Scalar(1);
      last += weight * b[k][kNumLanes - 1];
      const Scalar dot = weight * dots[k];
      for (int j = 0; j < kNumLanes; ++j) sum[j] += dot * b[k][j];
    }
  }
  const Scalar norm = rows[v].values[kDimension<3>];
  const Scalar norm_sum = last[kLast];
  const Scalar weight_sum = static_cast<Scalar>(graph.weight_sums[v]);
  Lanes<Scalar> products = {};
  for (int j = 0; j < kNumLanes; ++j) {
    products += a[j] * sum[j];
    LanesAt(gradient + j * kLanes<Scalar>) = 2 * (weight_sum * norm + norm_sum) * a[j] - 4 * sum[j];
  }
  return (weight_sum * norm * norm + norm * norm_sum) / 2 - SumOf(products);
}

/// Degree 4: weight (|a|^2 - a . b) / 2 is one direction's share of half of weight |a - b|^2.
template <bool kWeighted, typename Scalar>
OCTUPOLE_INLINE double AddEdges(const SweepGraph& graph, const HarmonicRow<4, Scalar>* rows, std::size_t v,
                                Scalar* gradient) {
  constexpr int kNumLanes = HarmonicRow<4, Scalar>::kNumLanes;
  Lanes<Scalar> sum[kNumLanes] = {};
  for (int group = graph.first_group[v]; group < graph.first_group[v + 1]; ++group) {
    const std::size_t first = 4 * static_cast<std::size_t>(group);
    for (int k = 0; k < 4; ++k) {
      const Scalar weight = kWeighted ? static_cast<Scalar>(graph.weights[first + k]) : Scalar(1);
      const Scalar* b = rows[graph.neighbours[first + k]].values;
      for (int j = 0; j < kNumLanes; ++j) sum[j] += weight * LanesAt(b + j * kLanes<Scalar>);
    }
  }
  const Scalar weight_sum = static_cast<Scalar>(graph.weight_sums[v]);
  Lanes<Scalar> products = {};
  for (int j = 0; j < kNumLanes; ++j) {
    const Lanes<Scalar> a = LanesAt(rows[v].values + j * kLanes<Scalar>);
    const Lanes<Scalar> difference = weight_sum * a - sum[j];
    LanesAt(gradient + j * kLanes<Scalar>) = difference;
    products += difference * a;
  }
  return SumOf(products) / 2;
}

}  // namespace octupole::internal
