#include "octupole/energies/internal/field_function.h"

#include <algorithm>

#include "octupole/alignment/alignment.h"
#include "octupole/energies/internal/edge_sweep.h"
#include "octupole/minimization/internal/simd.h"

namespace octupole::internal {
namespace {

// Ranges of vertices for the workers; a multiple of the vertices that share a register.
constexpr std::size_t kFieldGrain = 2048;

}  // namespace

template <int kDegree, typename Scalar>
FieldFunction<kDegree, Scalar>::FieldFunction(const SweepGraph& graph, const EnergyWeights& weights, Workers* workers)
    : graph_(graph),
      scale_(static_cast<Scalar>(weights.scale)),
      deviation_(static_cast<Scalar>(weights.deviation)),
      workers_(workers) {
  const std::size_t num_vertices = graph.num_vertices();
  const std::size_t num_rows = graph.weight_sums.size();
  rows_.resize(num_rows);
  first_parameter_.assign(1, 0);
  first_parameter_.reserve(num_rows + 1);
  first_axis_row_.assign(num_vertices, -1);
  for (std::size_t v = 0; v < graph.num_owned; ++v) {
    const Alignment& alignment = graph.alignments[v];
    int num_parameters = 0;
    if (alignment.kind() == AlignmentKind::kFree) {
      num_parameters = kDimension<kDegree>;
    } else {
      const AlignedSubspace<kDegree> subspace(alignment);
      if (alignment.kind() == AlignmentKind::kFrame) {
        rows_[v].Set(subspace.basis.col(0));
      } else {
        num_parameters = 2;
        first_axis_row_[v] = static_cast<int>(axis_rows_.size());
        for (int k = 0; k < 2; ++k) axis_rows_.emplace_back().Set(subspace.basis.col(k));
        axis_rows_.emplace_back().Set(subspace.offset);
      }
    }
    first_parameter_.push_back(first_parameter_.back() + num_parameters);
  }
  first_parameter_.resize(num_rows + 1, first_parameter_.back());
}

template <int kDegree, typename Scalar>
void FieldFunction<kDegree, Scalar>::ExpandRange(const Scalar* parameters, std::size_t begin, std::size_t end) const {
  for (std::size_t v = begin; v < end; ++v) {
    const Scalar* x = parameters + first_parameter_[v];
    Scalar* row = rows_[v].values;
    if (first_axis_row_[v] >= 0) {
      const Row* axis = &axis_rows_[first_axis_row_[v]];
      for (int i = 0; i < kDimension<kDegree>; ++i) {
        row[i] = x[0] * axis[0].values[i] + x[1] * axis[1].values[i] + axis[2].values[i];
      }
      if (kDegree == 3) row[7] = x[0] * x[0] + x[1] * x[1];
    } else if (NumParameters(v) > 0) {
      Scalar squared_norm = 0;
      for (int i = 0; i < kDimension<kDegree>; ++i) {
        row[i] = x[i];
        squared_norm += x[i] * x[i];
      }
      if (kDegree == 3) row[7] = squared_norm;
    }
  }
}

// Adds half the gradients of the penalties at the vertices from v on, one per lane; returns half their energies. The
// quadrics' gradients are 2 N_k h.
template <int kDegree, typename Scalar>
OCTUPOLE_INLINE double FieldFunction<kDegree, Scalar>::AddPenalties(std::size_t v, const Lanes<Scalar>* h,
                                                                    Lanes<Scalar>* gradient) const {
  constexpr int kSize = kDimension<kDegree>;
  const auto& matrices = SparseMatrices<kDegree, Scalar>::Instance();
  Lanes<Scalar> scale, deviation;
  for (int k = 0; k < kLanes<Scalar>; ++k) {
    scale[k] = NumParameters(v + k) > 0 ? scale_ : Scalar(0);
    deviation[k] = NumParameters(v + k) == kSize ? deviation_ : Scalar(0);
  }
  Lanes<Scalar> excess = -1 - Lanes<Scalar>{};
#pragma GCC unroll 9
  for (int i = 0; i < kSize; ++i) excess += h[i] * h[i];
#pragma GCC unroll 9
  for (int i = 0; i < kSize; ++i) gradient[i] += 2 * scale * excess * h[i];
  Lanes<Scalar> squared_quadrics = {};
  const auto add_quadric = [&](const auto& quadric) OCTUPOLE_INLINE_LAMBDA {
    Lanes<Scalar> product[kSize], value = {};
    quadric.Apply(h, product);
#pragma GCC unroll 9
    for (int i = 0; i < kSize; ++i) value += h[i] * product[i];
    squared_quadrics += value * value;
    const Lanes<Scalar> factor = 2 * deviation * value;
#pragma GCC unroll 9
    for (int i = 0; i < kSize; ++i) gradient[i] += factor * product[i];
  };
  add_quadric(matrices.quadric_1);
  add_quadric(matrices.quadric_2);
  add_quadric(matrices.quadric_3);
  add_quadric(matrices.quadric_4);
  add_quadric(matrices.quadric_5);
  return SumOf(scale * excess * excess + deviation * squared_quadrics) / 2;
}

// Half the energy of a range of vertices, and their gradients.
template <int kDegree, typename Scalar>
template <bool kWeighted>
OCTUPOLE_INLINE double FieldFunction<kDegree, Scalar>::SweepRange(std::size_t begin, std::size_t end,
                                                                  Scalar* gradient) const {
  constexpr int kNumLanes = Row::kNumLanes;
  constexpr int kStep = kLanes<Scalar>;
  double energy = 0;
  for (std::size_t first = begin; first < end; first += kStep) {
    alignas(32) Scalar gradients[kStep][kStep * kNumLanes];
    for (int k = 0; k < kStep; ++k) energy += AddEdges<kWeighted>(graph_, rows_.data(), first + k, gradients[k]);
    Lanes<Scalar> h[kStep * kNumLanes], sums[kStep * kNumLanes];
    LanesOfRows<kNumLanes, Scalar>([&](int k) OCTUPOLE_INLINE_LAMBDA { return rows_[first + k].values; }, h);
    LanesOfRows<kNumLanes, Scalar>([&](int k) OCTUPOLE_INLINE_LAMBDA { return gradients[k]; }, sums);
    energy += AddPenalties(first, h, sums);
    if (gradient == nullptr) continue;
    for (int j = 0; j < kNumLanes; ++j) {
      TransposeLanes(sums + kStep * j);
      for (int k = 0; k < kStep; ++k) LanesAt(gradients[k] + kStep * j) = sums[kStep * j + k];
    }
    for (int k = 0; k < kStep; ++k) {
      const std::size_t v = first + k;
      const int num_parameters = NumParameters(v);
      const Scalar* ambient = gradients[k];
      Scalar* reduced = gradient + first_parameter_[v];
      if (num_parameters == kDimension<kDegree>) {
        for (int i = 0; i < kDimension<kDegree>; ++i) reduced[i] = ambient[i];
      } else if (num_parameters == 2) {
        const Row* axis = &axis_rows_[first_axis_row_[v]];
        for (int l = 0; l < 2; ++l) {
          reduced[l] = 0;
          for (int i = 0; i < kDimension<kDegree>; ++i) reduced[l] += axis[l].values[i] * ambient[i];
        }
      }
    }
  }
  return energy;
}

template <int kDegree, typename Scalar>
void FieldFunction<kDegree, Scalar>::Evaluate(const Scalar* parameters, double* cost, Scalar* gradient) const {
  Expand(parameters);
  *cost = Sweep(0, graph_.num_owned, gradient);
}

template <int kDegree, typename Scalar>
void FieldFunction<kDegree, Scalar>::Expand(const Scalar* parameters) const {
  workers_->ForEachRange(graph_.num_owned, kFieldGrain,
                         [&](std::size_t begin, std::size_t end) { ExpandRange(parameters, begin, end); });
}

template <int kDegree, typename Scalar>
double FieldFunction<kDegree, Scalar>::Sweep(std::size_t first, std::size_t last, Scalar* gradient) const {
  const bool is_weighted = !graph_.weights.empty();
  return workers_->Sum(last - first, kFieldGrain, [&](std::size_t begin, std::size_t end) {
    return CallVectorised([&]() OCTUPOLE_INLINE_LAMBDA {
      return is_weighted ? SweepRange<true>(first + begin, first + end, gradient)
                         : SweepRange<false>(first + begin, first + end, gradient);
    });
  });
}

template <int kDegree, typename Scalar>
std::vector<Scalar> FieldFunction<kDegree, Scalar>::ParametersOf(const std::vector<Harmonic<kDegree>>& field) const {
  std::vector<Scalar> parameters(num_parameters());
  workers_->ForEachRange(field.size(), kFieldGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      Scalar* x = parameters.data() + first_parameter_[v];
      if (first_axis_row_[v] >= 0) {
        const Row* axis = &axis_rows_[first_axis_row_[v]];
        for (int k = 0; k < 2; ++k) {
          x[k] = 0;
          for (int i = 0; i < kDimension<kDegree>; ++i) x[k] += axis[k].values[i] * static_cast<Scalar>(field[v][i]);
        }
      } else if (NumParameters(v) > 0) {
        for (int i = 0; i < kDimension<kDegree>; ++i) x[i] = static_cast<Scalar>(field[v][i]);
      }
    }
  });
  return parameters;
}

template <int kDegree, typename Scalar>
std::vector<Harmonic<kDegree>> FieldFunction<kDegree, Scalar>::FieldOf(const std::vector<Scalar>& parameters) const {
  std::vector<Harmonic<kDegree>> field(graph_.num_vertices());
  workers_->ForEachRange(field.size(), kFieldGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Scalar* x = parameters.data() + first_parameter_[v];
      if (NumParameters(v) == kDimension<kDegree> || v >= graph_.num_owned) {
        if (v >= graph_.num_owned) x = rows_[v].values;
        for (int i = 0; i < kDimension<kDegree>; ++i) field[v][i] = static_cast<double>(x[i]);
        continue;
      }
      const AlignedSubspace<kDegree> subspace(graph_.alignments[v]);
      field[v] = subspace.basis.col(0);
      if (NumParameters(v) == 0) continue;
      field[v] = subspace.offset + static_cast<double>(x[0]) * subspace.basis.col(0) +
                 static_cast<double>(x[1]) * subspace.basis.col(1);
    }
  });
  return field;
}

template class FieldFunction<3, float>;
template class FieldFunction<3, double>;
template class FieldFunction<4, float>;
template class FieldFunction<4, double>;

}  // namespace octupole::internal
