#include "octupole/energies/field_problem.h"

#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "octupole/cost_functions/alignment_manifold.h"
#include "octupole/cost_functions/analytic_deviation_cost.h"
#include "octupole/cost_functions/analytic_smoothness_cost.h"
#include "octupole/cost_functions/scale_cost.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/random_rotation.h"

namespace octupole {
namespace {

// The nearest allowed value; for a prescribed frame its unit harmonic, with the sign nearer to h in degree 3.
template <int kDegree>
Harmonic<kDegree> Align(const Alignment& alignment, const Harmonic<kDegree>& h) {
  const AlignedSubspace<kDegree> subspace(alignment);
  if (alignment.kind() != AlignmentKind::kFrame) return subspace.Project(h);
  const bool flip = kDegree == 3 && h.dot(subspace.basis.col(0)) < 0;
  return flip ? Harmonic<kDegree>(-subspace.basis) : Harmonic<kDegree>(subspace.basis);
}

}  // namespace

template <int kDegree>
void CheckField(const char* caller, const FieldGraph& graph, const std::vector<Harmonic<kDegree>>& field) {
  const auto fail = [&](const std::string& what) { throw std::invalid_argument(caller + (": " + what)); };
  if (field.size() != graph.num_vertices()) {
    fail(std::to_string(field.size()) + " starting values for " + std::to_string(graph.num_vertices()) + " vertices");
  }
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (field[v].allFinite()) continue;
    std::ostringstream message;
    message << "the starting value of vertex " << v << " is not finite: [" << field[v].transpose() << "]";
    fail(message.str());
  }
}

template <int kDegree>
std::vector<Harmonic<kDegree>> RandomField(const FieldGraph& graph, std::uint32_t seed) {
  return RandomField<kDegree>(graph.alignments, seed);
}

template <int kDegree>
std::vector<Harmonic<kDegree>> RandomField(const std::vector<Alignment>& alignments, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::vector<Harmonic<kDegree>> field;
  field.reserve(alignments.size());
  for (const Alignment& alignment : alignments) {
    Eigen::Matrix3d frame = RandomRotation(&generator).toRotationMatrix();
    if (alignment.kind() == AlignmentKind::kAxis) {
      // The heading of a random frame is a uniform angle.
      const double angle = std::atan2(frame(1, 0), frame(0, 0));
      frame = alignment.frame() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    } else if (alignment.kind() == AlignmentKind::kFrame) {
      frame = alignment.frame();
    }
    field.push_back(HarmonicFromFrame<kDegree>(frame));
  }
  return field;
}

template <int kDegree>
void BuildFieldProblem(const FieldGraph& graph, const EnergyWeights& weights, std::vector<Harmonic<kDegree>>* field,
                       ceres::Problem* problem) {
  CheckFieldGraph(graph);
  CheckField<kDegree>("BuildFieldProblem", graph, *field);
  RootOfWeight("BuildFieldProblem (scale)", weights.scale);
  RootOfWeight("BuildFieldProblem (deviation)", weights.deviation);

  // One object serves all vertices; without any vertex to use it, nobody would own it.
  ceres::CostFunction* scale = nullptr;
  ceres::CostFunction* deviation = nullptr;
  for (std::size_t v = 0; v < graph.num_vertices(); ++v) {
    const Alignment& alignment = graph.alignments[v];
    double* block = (*field)[v].data();
    (*field)[v] = Align<kDegree>(alignment, (*field)[v]);
    problem->AddParameterBlock(block, kDimension<kDegree>);
    if (alignment.kind() == AlignmentKind::kFrame) {
      problem->SetParameterBlockConstant(block);
      continue;
    }
    if (scale == nullptr) scale = ScaleCost<kDegree>::Create(weights.scale);
    problem->AddResidualBlock(scale, nullptr, block);
    if (alignment.kind() == AlignmentKind::kAxis) {
      problem->SetManifold(block, new AlignmentManifold<kDegree>(alignment));
      continue;
    }
    if (deviation == nullptr) deviation = AnalyticDeviationCost<kDegree>::Create(weights.deviation);
    problem->AddResidualBlock(deviation, nullptr, block);
  }

  std::map<double, ceres::CostFunction*> smoothness_of_weight;
  for (const WeightedEdge& edge : graph.edges) {
    if (edge.weight == 0) continue;
    ceres::CostFunction*& smoothness = smoothness_of_weight[edge.weight];
    if (smoothness == nullptr) smoothness = AnalyticSmoothnessCost<kDegree>::Create(edge.weight);
    problem->AddResidualBlock(smoothness, nullptr, (*field)[edge.a].data(), (*field)[edge.b].data());
  }
}

template std::vector<Octupole> RandomField<3>(const FieldGraph&, std::uint32_t);
template std::vector<Hexadecapole> RandomField<4>(const FieldGraph&, std::uint32_t);
template std::vector<Octupole> RandomField<3>(const std::vector<Alignment>&, std::uint32_t);
template std::vector<Hexadecapole> RandomField<4>(const std::vector<Alignment>&, std::uint32_t);
template void CheckField<3>(const char*, const FieldGraph&, const std::vector<Octupole>&);
template void CheckField<4>(const char*, const FieldGraph&, const std::vector<Hexadecapole>&);
template void BuildFieldProblem<3>(const FieldGraph&, const EnergyWeights&, std::vector<Octupole>*, ceres::Problem*);
template void BuildFieldProblem<4>(const FieldGraph&, const EnergyWeights&, std::vector<Hexadecapole>*,
                                   ceres::Problem*);

}  // namespace octupole
