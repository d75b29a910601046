#include "octupole/field_solver.h"

#include <chrono>
#include <utility>

#include "octupole/frame.h"

namespace octupole {
namespace {

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int kDegree>
void SolveWithCeres(const FieldGraph& graph, const FieldOptions<kDegree>& options, Field<kDegree>* field) {
  const auto start = std::chrono::steady_clock::now();
  field->coefficients = options.start.empty() ? RandomField<kDegree>(graph, options.seed) : options.start;
  ceres::Problem problem;
  BuildFieldProblem<kDegree>(graph, options.weights, &field->coefficients, &problem);
  field->setup_seconds += SecondsSince(start);

  ceres::Solve(*options.solver, &problem, &field->summary);
  field->energy = 2 * field->summary.final_cost;

  const auto solved = std::chrono::steady_clock::now();
  field->frames.reserve(field->coefficients.size());
  for (const Harmonic<kDegree>& h : field->coefficients) field->frames.push_back(NearestFrame<kDegree>(h));
  field->project_seconds = SecondsSince(solved);
}

const char* MessageOf(ceres::TerminationType termination) {
  switch (termination) {
    case ceres::CONVERGENCE:
      return "the energy hardly falls any more";
    case ceres::NO_CONVERGENCE:
      return "the maximum number of iterations is reached";
    case ceres::FAILURE:
      return "the energy is not finite";
    default:
      return "stopped by the callback";
  }
}

template <int kDegree>
void SolveWithoutCeres(const FieldGraph& graph, const FieldOptions<kDegree>& options, Field<kDegree>* field) {
  const auto start = std::chrono::steady_clock::now();
  FastSolverOptions fast = options.fast;
  fast.seed = options.seed;
  FastField<kDegree> result = options.start.empty()
                                  ? SolveFast<kDegree>(graph, options.weights, fast)
                                  : SolveFastFrom<kDegree>(graph, options.weights, options.start, fast);
  field->coefficients = std::move(result.coefficients);
  field->frames = std::move(result.frames);
  field->energy = result.energy;
  field->summary.termination_type = result.termination;
  field->summary.message = MessageOf(result.termination);
  field->summary.iterations = std::move(result.iterations);
  field->summary.final_cost = result.energy / 2;
  field->summary.num_effective_parameters_reduced = result.num_unknowns;
  field->summary.total_time_in_seconds = SecondsSince(start);
}

}  // namespace

template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options) {
  const auto start = std::chrono::steady_clock::now();
  CheckTetMesh(mesh);
  Field<kDegree> field;
  field.alignment = AlignToBoundary(mesh, options.feature_angle_deg);
  const FieldGraph graph = MakeFieldGraph(mesh, field.alignment.alignments);
  field.setup_seconds = SecondsSince(start);
  options.solver ? SolveWithCeres(graph, options, &field) : SolveWithoutCeres(graph, options, &field);
  return field;
}

template Field<3> SolveField<3>(const TetMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TetMesh&, const FieldOptions<4>&);

}  // namespace octupole
