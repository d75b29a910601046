#include "octupole/energies/field_energy.h"

#include <stdexcept>
#include <string>

#include "octupole/cost_functions/cost_weight.h"
#include "octupole/energies/internal/field_function.h"
#include "octupole/energies/internal/sweep_graph.h"

namespace octupole {

template <int kDegree>
struct FieldEnergy<kDegree>::Implementation {
  Implementation(const FieldGraph& field_graph, const EnergyWeights& weights, Workers* workers, std::size_t num_owned)
      : graph(field_graph, num_owned), function(graph, weights, workers) {}

  internal::SweepGraph graph;
  internal::FieldFunction<kDegree, double> function;
};

template <int kDegree>
FieldEnergy<kDegree>::FieldEnergy(const FieldGraph& graph, const EnergyWeights& weights, Workers* workers,
                                  std::optional<std::size_t> num_owned) {
  const std::size_t owned = internal::CheckNumOwned("FieldEnergy", graph, num_owned);
  RootOfWeight("FieldEnergy (scale)", weights.scale);
  RootOfWeight("FieldEnergy (deviation)", weights.deviation);
  implementation_ = std::make_unique<Implementation>(graph, weights, workers, owned);
}

template <int kDegree>
FieldEnergy<kDegree>::~FieldEnergy() = default;

template <int kDegree>
int FieldEnergy<kDegree>::NumParameters() const {
  return implementation_->function.num_parameters();
}

template <int kDegree>
bool FieldEnergy<kDegree>::Evaluate(const double* parameters, double* cost, double* gradient) const {
  implementation_->function.Evaluate(parameters, cost, gradient);
  return true;
}

template <int kDegree>
void FieldEnergy<kDegree>::Expand(const double* parameters) const {
  implementation_->function.Expand(parameters);
}

template <int kDegree>
double FieldEnergy<kDegree>::Sweep(std::size_t begin, std::size_t end, const double* /*parameters*/,
                                   double* gradient) const {
  return implementation_->function.Sweep(begin, end, gradient);
}

template <int kDegree>
double* FieldEnergy<kDegree>::Row(std::size_t v) const {
  static_assert(sizeof(internal::HarmonicRow<kDegree, double>) == kRowSize * sizeof(double));
  return implementation_->function.RowOf(v);
}

template <int kDegree>
std::vector<double> FieldEnergy<kDegree>::ParametersOf(const std::vector<Harmonic<kDegree>>& field) const {
  const std::size_t num_vertices = implementation_->graph.num_vertices();
  if (field.size() != num_vertices) {
    throw std::invalid_argument("FieldEnergy::ParametersOf: " + std::to_string(field.size()) + " values for " +
                                std::to_string(num_vertices) + " vertices");
  }
  return implementation_->function.ParametersOf(field);
}

template <int kDegree>
std::vector<Harmonic<kDegree>> FieldEnergy<kDegree>::FieldOf(const std::vector<double>& parameters) const {
  if (static_cast<int>(parameters.size()) != NumParameters()) {
    throw std::invalid_argument("FieldEnergy::FieldOf: " + std::to_string(parameters.size()) +
                                " parameters instead of " + std::to_string(NumParameters()));
  }
  return implementation_->function.FieldOf(parameters);
}

template class FieldEnergy<3>;
template class FieldEnergy<4>;

}  // namespace octupole
