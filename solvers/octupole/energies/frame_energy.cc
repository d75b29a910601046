#include "octupole/energies/frame_energy.h"

#include <stdexcept>
#include <string>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/energies/internal/frame_function.h"
#include "octupole/energies/internal/sweep_graph.h"

namespace octupole {

struct FrameEnergy::Implementation {
  Implementation(const FieldGraph& field_graph, const std::vector<Eigen::Matrix3d>& start, Workers* workers,
                 std::optional<double> soft_weight, const std::vector<bool>& is_hard, std::size_t num_owned)
      : graph(field_graph, num_owned), frames(start), function(graph, frames, workers, soft_weight, is_hard) {}

  internal::SweepGraph graph;
  std::vector<Eigen::Matrix3d> frames;
  internal::FrameFunction<double> function;
};

FrameEnergy::FrameEnergy(const FieldGraph& graph, const std::vector<Eigen::Matrix3d>& frames, Workers* workers,
                         std::optional<double> soft_weight, const std::vector<bool>& is_hard,
                         std::optional<std::size_t> num_owned) {
  const std::size_t owned = internal::CheckNumOwned("FrameEnergy", graph, num_owned);
  const std::size_t num_vertices = graph.num_vertices();
  if (frames.size() != num_vertices) {
    throw std::invalid_argument("FrameEnergy: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(num_vertices) + " vertices");
  }
  if (!is_hard.empty() && is_hard.size() != num_vertices) {
    throw std::invalid_argument("FrameEnergy: is_hard has " + std::to_string(is_hard.size()) + " values for " +
                                std::to_string(num_vertices) + " vertices");
  }
  if (soft_weight) RootOfWeight("FrameEnergy (soft)", *soft_weight);
  implementation_ = std::make_unique<Implementation>(graph, frames, workers, soft_weight, is_hard, owned);
}

FrameEnergy::~FrameEnergy() = default;

int FrameEnergy::NumParameters() const { return implementation_->function.num_parameters(); }

bool FrameEnergy::Evaluate(const double* parameters, double* cost, double* gradient) const {
  implementation_->function.Evaluate(parameters, cost, gradient);
  return true;
}

void FrameEnergy::Expand(const double* parameters) const { implementation_->function.Expand(parameters); }

double FrameEnergy::Sweep(std::size_t begin, std::size_t end, const double* parameters, double* gradient) const {
  return implementation_->function.Sweep(begin, end, parameters, gradient);
}

double* FrameEnergy::Row(std::size_t v) const {
  static_assert(sizeof(internal::HarmonicRow<4, double>) == kRowSize * sizeof(double));
  return implementation_->function.RowOf(v);
}

std::vector<Eigen::Matrix3d> FrameEnergy::FramesOf(const std::vector<double>& parameters) const {
  if (static_cast<int>(parameters.size()) != NumParameters()) {
    throw std::invalid_argument("FrameEnergy::FramesOf: " + std::to_string(parameters.size()) +
                                " parameters instead of " + std::to_string(NumParameters()));
  }
  return implementation_->function.FramesOf(parameters);
}

}  // namespace octupole
