#include "octupole/solvers/field_energy.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/field/alignment.h"
#include "octupole/solvers/internal/edge_sweep.h"
#include "octupole/solvers/internal/harmonic_rows.h"
#include "octupole/solvers/internal/neighbour_lists.h"
#include "octupole/solvers/internal/simd.h"

namespace octupole {
namespace {

using internal::HarmonicRow;
using internal::Lanes;
using internal::LanesAt;
using internal::NeighbourLists;
using internal::SparseGenerators;

// Ranges of vertices for the workers; a multiple of the four vertices that share a register.
constexpr std::size_t kGrain = 2048;

// What a sweep reads.
template <int kDegree>
struct Sweep {
  const NeighbourLists& neighbours;
  const HarmonicRow<kDegree>* rows;
  const double* penalties;
  const SparseGenerators<kDegree>& generators;
};

// Adds half the gradients of the penalties at four vertices, one per lane; returns half their energies. With the Gram
// matrix M of the vectors G_x h, G_y h, G_z h, S = M - trace(M)/3 and the definition of the quadrics by the generators,
// d = 2/3 |S|^2, whose gradient is 8/3 sum over ij of S_ij G_i^T G_j h.
template <int kDegree>
OCTUPOLE_INLINE double AddPenalties(const Sweep<kDegree>& sweep, std::size_t v, const Lanes* h, Lanes* gradient) {
  constexpr int kSize = kDimension<kDegree>;
  Lanes scale, deviation;
  for (int k = 0; k < 4; ++k) {
    scale[k] = sweep.penalties[2 * (v + k)];
    deviation[k] = sweep.penalties[2 * (v + k) + 1];
  }
  Lanes excess = {-1, -1, -1, -1};
  for (int i = 0; i < kSize; ++i) excess += h[i] * h[i];
  Lanes turned[3][kSize];
  for (int k = 0; k < 3; ++k) sweep.generators.Apply(k, h, turned[k]);
  Lanes gram[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int l = 0; l <= k; ++l) {
      Lanes dot = {};
      for (int i = 0; i < kSize; ++i) dot += turned[k][i] * turned[l][i];
      gram[k][l] = gram[l][k] = dot;
    }
  }
  const Lanes mean = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
  for (int k = 0; k < 3; ++k) gram[k][k] -= mean;
  Lanes squared_norm = {};
  for (int i = 0; i < kSize; ++i) gradient[i] += 2 * scale * excess * h[i];
  for (int k = 0; k < 3; ++k) {
    Lanes combination[kSize], moved[kSize];
    for (int i = 0; i < kSize; ++i) {
      combination[i] = gram[k][0] * turned[0][i] + gram[k][1] * turned[1][i] + gram[k][2] * turned[2][i];
    }
    // G^T = -G.
    sweep.generators.Apply(k, combination, moved);
    for (int i = 0; i < kSize; ++i) gradient[i] -= 4. / 3 * deviation * moved[i];
    for (int l = 0; l < 3; ++l) squared_norm += gram[k][l] * gram[k][l];
  }
  const Lanes energy = scale * excess * excess / 2 + deviation * squared_norm / 3;
  return energy[0] + energy[1] + energy[2] + energy[3];
}

// The ambient gradients of four vertices from v on, and their share of half the energy.
template <int kDegree, bool kWeighted>
OCTUPOLE_INLINE double SweepFour(const Sweep<kDegree>& sweep, std::size_t v, HarmonicRow<kDegree>* gradients) {
  constexpr int kNumLanes = HarmonicRow<kDegree>::kNumLanes;
  double energy = 0;
  for (int k = 0; k < 4; ++k)
    energy += internal::AddEdges<kWeighted>(sweep.neighbours, sweep.rows, v + k, gradients[k].values);
  Lanes h[4 * kNumLanes], gradient[4 * kNumLanes];
  for (int i = 0; i < kNumLanes; ++i) {
    for (int k = 0; k < 4; ++k) {
      h[4 * i + k] = LanesAt(sweep.rows[v + k].values + 4 * i);
      gradient[4 * i + k] = LanesAt(gradients[k].values + 4 * i);
    }
    internal::TransposeLanes(h + 4 * i);
    internal::TransposeLanes(gradient + 4 * i);
  }
  energy += AddPenalties<kDegree>(sweep, v, h, gradient);
  for (int i = 0; i < kNumLanes; ++i) {
    internal::TransposeLanes(gradient + 4 * i);
    for (int k = 0; k < 4; ++k) LanesAt(gradients[k].values + 4 * i) = gradient[4 * i + k];
  }
  return energy;
}

template <int kDegree, bool kWeighted>
double SweepNarrow(const Sweep<kDegree>& sweep, std::size_t v, HarmonicRow<kDegree>* gradients) {
  return SweepFour<kDegree, kWeighted>(sweep, v, gradients);
}

template <int kDegree, bool kWeighted>
OCTUPOLE_WIDE double SweepWide(const Sweep<kDegree>& sweep, std::size_t v, HarmonicRow<kDegree>* gradients) {
  return SweepFour<kDegree, kWeighted>(sweep, v, gradients);
}

template <int kDegree>
auto ChooseSweep(bool is_weighted) {
  if (internal::HasWideLanes()) return is_weighted ? SweepWide<kDegree, true> : SweepWide<kDegree, false>;
  return is_weighted ? SweepNarrow<kDegree, true> : SweepNarrow<kDegree, false>;
}

}  // namespace

template <int kDegree>
FieldEnergy<kDegree>::FieldEnergy(const FieldGraph& graph, const EnergyWeights& weights, Workers* workers)
    : neighbours_(std::make_unique<NeighbourLists>((CheckFieldGraph(graph), graph))), workers_(workers) {
  RootOfWeight("FieldEnergy (scale)", weights.scale);
  RootOfWeight("FieldEnergy (deviation)", weights.deviation);
  const std::size_t num_vertices = graph.num_vertices();
  // The sweep takes four vertices at a time; those past the end are zero, without neighbours and penalties.
  const std::size_t num_rows = (num_vertices + 1 + 3) / 4 * 4;
  rows_.resize(num_rows);
  penalties_.assign(2 * num_rows, 0);
  neighbours_->first_group.resize(num_rows + 1, neighbours_->first_group.back());
  neighbours_->weight_sums.resize(num_rows, 0);
  first_parameter_.assign(1, 0);
  first_parameter_.reserve(num_vertices + 1);
  first_axis_row_.assign(num_vertices, -1);
  for (std::size_t v = 0; v < num_vertices; ++v) {
    const Alignment& alignment = graph.alignments[v];
    std::size_t num_parameters = 0;
    if (alignment.kind() == AlignmentKind::kFree) {
      num_parameters = kDimension<kDegree>;
      penalties_[2 * v + 1] = weights.deviation;
    } else {
      const AlignedSubspace<kDegree> subspace(alignment);
      if (alignment.kind() == AlignmentKind::kFrame) {
        rows_[v].Set(subspace.basis.col(0));
      } else {
        num_parameters = 2;
        first_axis_row_[v] = static_cast<int>(axis_rows_.size());
        axis_rows_.resize(axis_rows_.size() + 3);
        for (int k = 0; k < 2; ++k) axis_rows_[axis_rows_.size() - 3 + k].Set(subspace.basis.col(k));
        axis_rows_.back().Set(subspace.offset);
      }
    }
    if (num_parameters > 0) penalties_[2 * v] = weights.scale;
    first_parameter_.push_back(first_parameter_.back() + num_parameters);
  }
}

template <int kDegree>
FieldEnergy<kDegree>::~FieldEnergy() = default;

template <int kDegree>
void FieldEnergy<kDegree>::Expand(const double* parameters, std::size_t begin, std::size_t end) const {
  for (std::size_t v = begin; v < end; ++v) {
    const double* x = parameters + first_parameter_[v];
    double* row = rows_[v].values;
    if (first_axis_row_[v] >= 0) {
      const HarmonicRow<kDegree>* axis = &axis_rows_[first_axis_row_[v]];
      for (int i = 0; i < kDimension<kDegree>; ++i) {
        row[i] = x[0] * axis[0].values[i] + x[1] * axis[1].values[i] + axis[2].values[i];
      }
      if (kDegree == 3) row[7] = x[0] * x[0] + x[1] * x[1];
    } else if (first_parameter_[v + 1] > first_parameter_[v]) {
      double squared_norm = 0;
      for (int i = 0; i < kDimension<kDegree>; ++i) {
        row[i] = x[i];
        squared_norm += x[i] * x[i];
      }
      if (kDegree == 3) row[7] = squared_norm;
    }
  }
}

template <int kDegree>
bool FieldEnergy<kDegree>::Evaluate(const double* parameters, double* cost, double* gradient) const {
  const std::size_t num_vertices = first_axis_row_.size();
  workers_->ForEachRange(num_vertices, kGrain,
                         [&](std::size_t begin, std::size_t end) { Expand(parameters, begin, end); });
  const Sweep<kDegree> sweep = {*neighbours_, rows_.data(), penalties_.data(), SparseGenerators<kDegree>::Instance()};
  const auto sweep_four = ChooseSweep<kDegree>(!neighbours_->weights.empty());
  *cost = workers_->Sum(num_vertices, kGrain, [&](std::size_t begin, std::size_t end) {
    double energy = 0;
    HarmonicRow<kDegree> gradients[4];
    for (std::size_t first = begin; first < end; first += 4) {
      energy += sweep_four(sweep, first, gradients);
      if (gradient == nullptr) continue;
      for (std::size_t v = first; v < std::min(first + 4, end); ++v) {
        const double* ambient = gradients[v - first].values;
        double* reduced = gradient + first_parameter_[v];
        if (first_axis_row_[v] >= 0) {
          const HarmonicRow<kDegree>* axis = &axis_rows_[first_axis_row_[v]];
          for (int k = 0; k < 2; ++k) {
            reduced[k] = 0;
            for (int i = 0; i < kDimension<kDegree>; ++i) reduced[k] += axis[k].values[i] * ambient[i];
          }
        } else if (first_parameter_[v + 1] > first_parameter_[v]) {
          std::copy_n(ambient, kDimension<kDegree>, reduced);
        }
      }
    }
    return energy;
  });
  return true;
}

template <int kDegree>
std::vector<double> FieldEnergy<kDegree>::ParametersOf(const std::vector<Harmonic<kDegree>>& field) const {
  if (field.size() != first_axis_row_.size()) {
    throw std::invalid_argument("FieldEnergy::ParametersOf: " + std::to_string(field.size()) + " values for " +
                                std::to_string(first_axis_row_.size()) + " vertices");
  }
  std::vector<double> parameters(first_parameter_.back());
  for (std::size_t v = 0; v < field.size(); ++v) {
    double* x = parameters.data() + first_parameter_[v];
    if (first_axis_row_[v] >= 0) {
      for (int k = 0; k < 2; ++k) {
        x[k] = field[v].dot(Eigen::Map<const Harmonic<kDegree>>(axis_rows_[first_axis_row_[v] + k].values));
      }
    } else if (first_parameter_[v + 1] > first_parameter_[v]) {
      std::copy_n(field[v].data(), kDimension<kDegree>, x);
    }
  }
  return parameters;
}

template <int kDegree>
std::vector<Harmonic<kDegree>> FieldEnergy<kDegree>::FieldOf(const std::vector<double>& parameters) const {
  if (parameters.size() != first_parameter_.back()) {
    throw std::invalid_argument("FieldEnergy::FieldOf: " + std::to_string(parameters.size()) +
                                " parameters instead of " + std::to_string(first_parameter_.back()));
  }
  Expand(parameters.data(), 0, first_axis_row_.size());
  std::vector<Harmonic<kDegree>> field(first_axis_row_.size());
  for (std::size_t v = 0; v < field.size(); ++v) field[v] = Eigen::Map<const Harmonic<kDegree>>(rows_[v].values);
  return field;
}

template class FieldEnergy<3>;
template class FieldEnergy<4>;

}  // namespace octupole
