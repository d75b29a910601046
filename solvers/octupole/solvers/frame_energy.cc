#include "octupole/solvers/frame_energy.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/field/alignment.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/solvers/internal/edge_sweep.h"
#include "octupole/solvers/internal/harmonic_rows.h"
#include "octupole/solvers/internal/neighbour_lists.h"
#include "octupole/solvers/internal/simd.h"

namespace octupole {
namespace {

using internal::HarmonicRow;
using internal::Lanes;
using internal::NeighbourLists;
using internal::SparseGenerators;

constexpr std::size_t kGrain = 2048;

// The unit harmonic of a frame: the projection of x^4 + y^4 + z^4 onto degree 4 is a multiple of the sum of the axes'
// basis functions.
Hexadecapole HarmonicOfAxes(const Eigen::Matrix3d& frame) {
  const auto sum = [](const Eigen::Matrix3d& axes) -> Hexadecapole {
    return EvaluateBasis<4>(axes.col(0)) + EvaluateBasis<4>(axes.col(1)) + EvaluateBasis<4>(axes.col(2));
  };
  static const double factor = 1 / sum(Eigen::Matrix3d::Identity()).norm();
  return factor * sum(frame);
}

// The derivatives of the cost by turns of vertex v about the coordinate axes, and its share of the cost.
template <bool kWeighted>
OCTUPOLE_INLINE double SweepVertex(const NeighbourLists& lists, const HarmonicRow<4>* rows,
                                   const SparseGenerators<4>& generators, std::size_t v, double* torque) {
  HarmonicRow<4> gradient;
  const double energy = internal::AddEdges<kWeighted>(lists, rows, v, gradient.values);
  generators.Torque(rows[v].values, gradient.values, torque);
  return energy;
}

template <bool kWeighted>
double SweepNarrow(const NeighbourLists& lists, const HarmonicRow<4>* rows, const SparseGenerators<4>& generators,
                   std::size_t v, double* torque) {
  return SweepVertex<kWeighted>(lists, rows, generators, v, torque);
}

template <bool kWeighted>
OCTUPOLE_WIDE double SweepWide(const NeighbourLists& lists, const HarmonicRow<4>* rows,
                               const SparseGenerators<4>& generators, std::size_t v, double* torque) {
  return SweepVertex<kWeighted>(lists, rows, generators, v, torque);
}

}  // namespace

FrameEnergy::FrameEnergy(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames, Workers* workers,
                         std::optional<double> soft_weight, const std::vector<bool>& is_hard)
    : neighbours_(std::make_unique<NeighbourLists>((CheckFieldGraph(graph), graph))),
      frames_(frames),
      workers_(workers) {
  const std::size_t num_vertices = graph.num_vertices();
  if (frames.size() != num_vertices) {
    throw std::invalid_argument("FrameEnergy: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(num_vertices) + " vertices");
  }
  if (!is_hard.empty() && is_hard.size() != num_vertices) {
    throw std::invalid_argument("FrameEnergy: is_hard has " + std::to_string(is_hard.size()) + " values for " +
                                std::to_string(num_vertices) + " vertices");
  }
  const auto is_soft = [&](std::size_t v) { return soft_weight && (is_hard.empty() || !is_hard[v]); };
  rows_.resize(num_vertices + 1);
  first_parameter_.assign(1, 0);
  first_parameter_.reserve(num_vertices + 1);
  for (std::size_t v = 0; v < num_vertices; ++v) {
    const AlignmentKind kind = graph.alignments[v].kind();
    const bool has_three = kind == AlignmentKind::kFree || is_soft(v);
    const std::size_t num_parameters = has_three ? 3 : kind == AlignmentKind::kAxis ? 1 : 0;
    first_parameter_.push_back(first_parameter_.back() + num_parameters);
    if (num_parameters == 0) rows_[v].Set(HarmonicOfAxes(frames[v]));
  }
  if (!soft_weight) return;
  RootOfWeight("FrameEnergy (soft)", *soft_weight);
  soft_weight_ = *soft_weight;
  soft_alignment_of_.assign(num_vertices, -1);
  for (std::size_t v = 0; v < num_vertices; ++v) {
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

FrameEnergy::~FrameEnergy() = default;

// Half the energy of the soft alignment of vertex v, if any, and its derivatives by turns.
double FrameEnergy::AddSoftAlignment(std::size_t v, Eigen::Vector3d* torque) const {
  if (soft_alignment_of_.empty() || soft_alignment_of_[v] < 0) return 0;
  const SoftAlignment& soft = soft_alignments_[soft_alignment_of_[v]];
  const Eigen::Map<const Hexadecapole> h(rows_[v].values);
  Hexadecapole difference = h - soft.offset;
  difference -= soft.basis * (soft.basis.transpose() * difference);
  const Hexadecapole gradient = soft_weight_ * difference;
  Eigen::Vector3d soft_torque;
  SparseGenerators<4>::Instance().Torque(h.data(), gradient.data(), soft_torque.data());
  *torque += soft_torque;
  return gradient.dot(difference) / 2;
}

Eigen::Matrix3d FrameEnergy::FrameOf(const double* parameters, std::size_t v) const {
  const double* x = parameters + first_parameter_[v];
  const std::size_t num_parameters = first_parameter_[v + 1] - first_parameter_[v];
  if (num_parameters == 0) return frames_[v];
  if (num_parameters == 1) {
    const double c = std::cos(x[0]), s = std::sin(x[0]);
    Eigen::Matrix3d frame = frames_[v];
    frame.col(0) = c * frames_[v].col(0) + s * frames_[v].col(1);
    frame.col(1) = c * frames_[v].col(1) - s * frames_[v].col(0);
    return frame;
  }
  return frames_[v] * Eigen::Quaterniond(1, x[0] / 2, x[1] / 2, x[2] / 2).normalized().toRotationMatrix();
}

void FrameEnergy::Expand(const double* parameters, std::size_t begin, std::size_t end) const {
  for (std::size_t v = begin; v < end; ++v) {
    if (first_parameter_[v + 1] > first_parameter_[v]) rows_[v].Set(HarmonicOfAxes(FrameOf(parameters, v)));
  }
}

bool FrameEnergy::Evaluate(const double* parameters, double* cost, double* gradient) const {
  workers_->ForEachRange(frames_.size(), kGrain,
                         [&](std::size_t begin, std::size_t end) { Expand(parameters, begin, end); });
  const SparseGenerators<4>& generators = SparseGenerators<4>::Instance();
  const bool is_weighted = !neighbours_->weights.empty();
  const auto sweep_vertex = internal::HasWideLanes() ? (is_weighted ? SweepWide<true> : SweepWide<false>)
                                                     : (is_weighted ? SweepNarrow<true> : SweepNarrow<false>);
  *cost = workers_->Sum(frames_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    double energy = 0;
    for (std::size_t v = begin; v < end; ++v) {
      Eigen::Vector3d torque;
      energy += sweep_vertex(*neighbours_, rows_.data(), generators, v, torque.data());
      energy += AddSoftAlignment(v, &torque);
      const std::size_t num_parameters = first_parameter_[v + 1] - first_parameter_[v];
      if (gradient == nullptr || num_parameters == 0) continue;
      double* derivatives = gradient + first_parameter_[v];
      if (num_parameters == 1) {
        derivatives[0] = torque.dot(frames_[v].col(2));
        continue;
      }
      // The angular velocity of C(r) is 2 (r' + r x r') / (1 + |r|^2).
      const Eigen::Vector3d r = Eigen::Map<const Eigen::Vector3d>(parameters + first_parameter_[v]) / 2;
      const Eigen::Vector3d turned = frames_[v].transpose() * torque;
      Eigen::Map<Eigen::Vector3d> result(derivatives);
      result = (turned + turned.cross(r)) / (1 + r.squaredNorm());
    }
    return energy;
  });
  return true;
}

std::vector<Eigen::Matrix3d> FrameEnergy::FramesOf(const std::vector<double>& parameters) const {
  if (parameters.size() != first_parameter_.back()) {
    throw std::invalid_argument("FrameEnergy::FramesOf: " + std::to_string(parameters.size()) +
                                " parameters instead of " + std::to_string(first_parameter_.back()));
  }
  std::vector<Eigen::Matrix3d> frames;
  frames.reserve(frames_.size());
  for (std::size_t v = 0; v < frames_.size(); ++v) frames.push_back(FrameOf(parameters.data(), v));
  return frames;
}

}  // namespace octupole
