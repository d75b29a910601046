#include "octupole/energies/internal/frame_function.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "octupole/alignment/alignment.h"
#include "octupole/energies/internal/edge_sweep.h"
#include "octupole/minimization/internal/simd.h"

namespace octupole::internal {
namespace {

constexpr std::size_t kFrameGrain = 2048;

// The unit harmonics of frames, one per lane: the sum of the basis functions of degree 4 (harmonics.cc) at the three
// axes, of unit length, scaled.
template <typename Scalar>
OCTUPOLE_INLINE void HarmonicsOfAxes(const Lanes<Scalar> (*axes)[3], Lanes<Scalar>* h) {
  // Squares of the factors for |m| = 0 .. 4, times 336.
  const Scalar k0 = static_cast<Scalar>(std::sqrt(1. / 336)), k1 = static_cast<Scalar>(std::sqrt(40. / 336)),
               k2 = static_cast<Scalar>(std::sqrt(20. / 336)), k3 = static_cast<Scalar>(std::sqrt(280. / 336)),
               k4 = static_cast<Scalar>(std::sqrt(35. / 336));
  for (int i = 0; i < 9; ++i) h[i] = Lanes<Scalar>{};
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis) {
    const Lanes<Scalar>&x = axes[axis][0], &y = axes[axis][1], &z = axes[axis][2];
    const Lanes<Scalar> xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, xz = x * z;
    const Lanes<Scalar> seven = 7 * zz - 1, three = 7 * zz - 3, difference = xx - yy;
    h[0] += xy * difference;
    h[1] += yz * (3 * xx - yy);
    h[2] += xy * seven;
    h[3] += yz * three;
    h[4] += (35 * zz - 30) * zz + 3;
    h[5] += xz * three;
    h[6] += difference * seven;
    h[7] += xz * (xx - 3 * yy);
    h[8] += difference * difference - 4 * xy * xy;
  }
  h[0] *= 4 * k4;
  h[1] *= k3;
  h[2] *= 2 * k2;
  h[3] *= k1;
  h[4] *= k0;
  h[5] *= k1;
  h[6] *= k2;
  h[7] *= k3;
  h[8] *= k4;
}

}  // namespace

template <typename Scalar>
FrameFunction<Scalar>::FrameFunction(const SweepGraph& graph, const std::vector<Eigen::Matrix3d>& frames,
                                     Workers* workers, std::optional<double> soft_weight,
                                     const std::vector<bool>& is_hard)
    : graph_(graph), frames_(frames), workers_(workers) {
  const std::size_t num_vertices = graph.num_vertices();
  const std::size_t num_rows = graph.weight_sums.size();
  const auto is_soft = [&](std::size_t v) { return soft_weight && (is_hard.empty() || !is_hard[v]); };
  first_parameter_.assign(1, 0);
  first_parameter_.reserve(num_rows + 1);
  for (std::size_t v = 0; v < graph.num_owned; ++v) {
    const AlignmentKind kind = graph.alignments[v].kind();
    const bool has_three = kind == AlignmentKind::kFree || is_soft(v);
    const int num_parameters = has_three ? 3 : kind == AlignmentKind::kAxis ? 1 : 0;
    first_parameter_.push_back(first_parameter_.back() + num_parameters);
  }
  first_parameter_.resize(num_rows + 1, first_parameter_.back());
  rows_.resize(num_rows);
  frame_lanes_.resize(num_rows / kLanes<Scalar>);
  workers_->ForEachRange(num_vertices, kFrameGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      for (int i = 0; i < 9; ++i) {
        frame_lanes_[v / kLanes<Scalar>].entries[i][v % kLanes<Scalar>] = static_cast<Scalar>(frames[v](i % 3, i / 3));
      }
    }
  });
  if (!soft_weight) return;
  soft_weight_ = *soft_weight;
  soft_alignment_of_.assign(num_vertices, -1);
  for (std::size_t v = 0; v < graph.num_owned; ++v) {
    const AlignmentKind kind = graph.alignments[v].kind();
    if (kind == AlignmentKind::kFree || !is_soft(v)) continue;
    const AlignedSubspace<4> subspace(graph.alignments[v]);
    soft_alignment_of_[v] = static_cast<int>(soft_alignments_.size());
    SoftAlignment& soft = soft_alignments_.emplace_back();
    soft.basis.setZero();
    if (kind == AlignmentKind::kAxis) {
      soft.offset = subspace.offset;
      soft.basis = subspace.basis;
    } else {
      soft.offset = subspace.basis.col(0);
    }
  }
}

// Half the energy of the soft alignment of vertex v, if any; adds its derivatives by the harmonic.
template <typename Scalar>
double FrameFunction<Scalar>::AddSoftAlignment(std::size_t v, Scalar* gradient) const {
  if (v >= soft_alignment_of_.size() || soft_alignment_of_[v] < 0) return 0;
  const SoftAlignment& soft = soft_alignments_[soft_alignment_of_[v]];
  const Eigen::Map<const Eigen::Matrix<Scalar, kDimension<4>, 1>> h(rows_[v].values);
  Hexadecapole difference = h.template cast<double>() - soft.offset;
  difference -= soft.basis * (soft.basis.transpose() * difference);
  for (int i = 0; i < kDimension<4>; ++i) gradient[i] += static_cast<Scalar>(soft_weight_ * difference[i]);
  return soft_weight_ * difference.squaredNorm() / 2;
}

// Half the parameters: the vectors r of the turns C(r).
template <typename Scalar>
OCTUPOLE_INLINE void FrameFunction<Scalar>::GatherTurns(const Scalar* parameters, std::size_t first,
                                                        Lanes<Scalar>* turns) const {
  for (int i = 0; i < 3; ++i) turns[i] = Lanes<Scalar>{};
  for (int k = 0; k < kLanes<Scalar>; ++k) {
    const Scalar* x = parameters + first_parameter_[first + k];
    switch (NumParameters(first + k)) {
      case 3:
        for (int i = 0; i < 3; ++i) turns[i][k] = x[i] / 2;
        break;
      case 1:
        turns[2][k] = x[0] / 2;
        break;
      default:
        break;
    }
  }
}

template <typename Scalar>
OCTUPOLE_INLINE void FrameFunction<Scalar>::ExpandRange(const Scalar* parameters, std::size_t begin,
                                                        std::size_t end) const {
  constexpr int kStep = kLanes<Scalar>;
  for (std::size_t first = begin; first < end; first += kStep) {
    // C(r) = I + 2 ([r] + [r]^2) / (1 + |r|^2).
    Lanes<Scalar> r[3], turn[3][3], axes[3][3];
    GatherTurns(parameters, first, r);
    const Lanes<Scalar> xx = r[0] * r[0], yy = r[1] * r[1], zz = r[2] * r[2];
    const Lanes<Scalar> s = 2 / (1 + xx + yy + zz);
    const Lanes<Scalar> xy = r[0] * r[1], xz = r[0] * r[2], yz = r[1] * r[2];
    // By columns.
    turn[0][0] = 1 - s * (yy + zz);
    turn[0][1] = s * (xy + r[2]);
    turn[0][2] = s * (xz - r[1]);
    turn[1][0] = s * (xy - r[2]);
    turn[1][1] = 1 - s * (xx + zz);
    turn[1][2] = s * (yz + r[0]);
    turn[2][0] = s * (xz + r[1]);
    turn[2][1] = s * (yz - r[0]);
    turn[2][2] = 1 - s * (xx + yy);
    const auto& entries = frame_lanes_[first / kStep].entries;
    Lanes<Scalar> frame[9];
    for (int i = 0; i < 9; ++i) frame[i] = LanesAt(entries[i]);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        axes[i][j] = frame[j] * turn[i][0] + frame[3 + j] * turn[i][1] + frame[6 + j] * turn[i][2];
      }
    }
    Lanes<Scalar> h[kStep * Row::kNumLanes] = {};
    HarmonicsOfAxes<Scalar>(axes, h);
    for (int j = 0; j < Row::kNumLanes; ++j) {
      TransposeLanes(h + kStep * j);
      for (int k = 0; k < kStep; ++k) LanesAt(rows_[first + k].values + kStep * j) = h[kStep * j + k];
    }
  }
}

template <typename Scalar>
template <bool kWeighted>
OCTUPOLE_INLINE double FrameFunction<Scalar>::SweepRange(const Scalar* parameters, std::size_t begin, std::size_t end,
                                                         Scalar* gradient) const {
  constexpr int kNumLanes = Row::kNumLanes;
  constexpr int kStep = kLanes<Scalar>;
  const auto& matrices = SparseMatrices<4, Scalar>::Instance();
  double energy = 0;
  for (std::size_t first = begin; first < end; first += kStep) {
    alignas(32) Scalar gradients[kStep][kStep * kNumLanes];
    for (int k = 0; k < kStep; ++k) {
      energy += AddEdges<kWeighted>(graph_, rows_.data(), first + k, gradients[k]);
      if (!soft_alignments_.empty()) energy += AddSoftAlignment(first + k, gradients[k]);
    }
    if (gradient == nullptr) continue;
    Lanes<Scalar> h[kStep * kNumLanes], sums[kStep * kNumLanes];
    LanesOfRows<kNumLanes, Scalar>([&](int k) OCTUPOLE_INLINE_LAMBDA { return rows_[first + k].values; }, h);
    LanesOfRows<kNumLanes, Scalar>([&](int k) OCTUPOLE_INLINE_LAMBDA { return gradients[k]; }, sums);
    // The derivatives by turns about the coordinate axes, then about the frame's own.
    Lanes<Scalar> torque[3], turned[3], r[3];
    const auto add_torque = [&](int axis, const auto& generator) OCTUPOLE_INLINE_LAMBDA {
      Lanes<Scalar> moved[kDimension<4>];
      generator.Apply(h, moved);
      torque[axis] = Lanes<Scalar>{};
#pragma GCC unroll 9
      for (int i = 0; i < kDimension<4>; ++i) torque[axis] += sums[i] * moved[i];
    };
    add_torque(0, matrices.generator_x);
    add_torque(1, matrices.generator_y);
    add_torque(2, matrices.generator_z);
    const auto& entries = frame_lanes_[first / kStep].entries;
    Lanes<Scalar> frame[9];
    for (int i = 0; i < 9; ++i) frame[i] = LanesAt(entries[i]);
    for (int i = 0; i < 3; ++i) {
      turned[i] = frame[3 * i] * torque[0] + frame[3 * i + 1] * torque[1] + frame[3 * i + 2] * torque[2];
    }
    // The angular velocity of C(r) is 2 (r' + r x r') / (1 + |r|^2).
    GatherTurns(parameters, first, r);
    const Lanes<Scalar> s = 1 / (1 + r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    const Lanes<Scalar> derivatives[3] = {s * (turned[0] + turned[1] * r[2] - turned[2] * r[1]),
                                          s * (turned[1] + turned[2] * r[0] - turned[0] * r[2]),
                                          s * (turned[2] + turned[0] * r[1] - turned[1] * r[0])};
    for (int k = 0; k < kStep; ++k) {
      Scalar* result = gradient + first_parameter_[first + k];
      switch (NumParameters(first + k)) {
        case 3:
          for (int i = 0; i < 3; ++i) result[i] = derivatives[i][k];
          break;
        case 1:
          result[0] = derivatives[2][k];
          break;
        default:
          break;
      }
    }
  }
  return energy;
}

template <typename Scalar>
void FrameFunction<Scalar>::Evaluate(const Scalar* parameters, double* cost, Scalar* gradient) const {
  Expand(parameters);
  *cost = Sweep(0, graph_.num_owned, parameters, gradient);
}

template <typename Scalar>
void FrameFunction<Scalar>::Expand(const Scalar* parameters) const {
  workers_->ForEachRange(graph_.num_owned, kFrameGrain, [&](std::size_t begin, std::size_t end) {
    CallVectorised([&]() OCTUPOLE_INLINE_LAMBDA { ExpandRange(parameters, begin, end); });
  });
  // The rows past the end are to stay zero.
  for (std::size_t v = graph_.num_vertices(); v < rows_.size(); ++v) rows_[v] = Row();
}

template <typename Scalar>
double FrameFunction<Scalar>::Sweep(std::size_t first, std::size_t last, const Scalar* parameters,
                                    Scalar* gradient) const {
  const bool is_weighted = !graph_.weights.empty();
  return workers_->Sum(last - first, kFrameGrain, [&](std::size_t begin, std::size_t end) {
    return CallVectorised([&]() OCTUPOLE_INLINE_LAMBDA {
      return is_weighted ? SweepRange<true>(parameters, first + begin, first + end, gradient)
                         : SweepRange<false>(parameters, first + begin, first + end, gradient);
    });
  });
}

template <typename Scalar>
std::vector<Eigen::Matrix3d> FrameFunction<Scalar>::FramesOf(const std::vector<Scalar>& parameters) const {
  std::vector<Eigen::Matrix3d> frames(frames_.size());
  workers_->ForEachRange(frames.size(), kFrameGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Scalar* x = parameters.data() + first_parameter_[v];
      Eigen::Vector3d r = Eigen::Vector3d::Zero();
      if (NumParameters(v) == 3) r = {x[0] / 2., x[1] / 2., x[2] / 2.};
      if (NumParameters(v) == 1) r.z() = x[0] / 2.;
      frames[v] = frames_[v] * Eigen::Quaterniond(1, r.x(), r.y(), r.z()).normalized().toRotationMatrix();
      // Not even by rounding.
      if (NumParameters(v) == 1) frames[v].col(2) = frames_[v].col(2);
      if (NumParameters(v) == 0) frames[v] = frames_[v];
    }
  });
  return frames;
}

template class FrameFunction<float>;
template class FrameFunction<double>;

}  // namespace octupole::internal
