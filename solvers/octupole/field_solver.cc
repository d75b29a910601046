#include "octupole/field_solver.h"

#include <chrono>
#include <string>

#include "octupole/frame.h"
#include "octupole/solver_presets.h"

namespace octupole {
namespace {

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options) {
  const auto start = std::chrono::steady_clock::now();
  CheckTetMesh(mesh);
  Field<kDegree> field;
  field.alignment = AlignToBoundary(mesh, options.feature_angle_deg);
  const FieldGraph graph = MakeFieldGraph(mesh, field.alignment.alignments);
  field.coefficients = options.start.empty() ? RandomField<kDegree>(graph, options.seed) : options.start;
  ceres::Problem problem;
  BuildFieldProblem<kDegree>(graph, options.weights, &field.coefficients, &problem);
  const ceres::Solver::Options solver_options =
      options.solver ? *options.solver : MakeSolverOptions(ChooseSolverPreset(mesh.points.size()));
  field.setup_seconds = SecondsSince(start);

  ceres::Solve(solver_options, &problem, &field.summary);
  field.energy = 2 * field.summary.final_cost;

  const auto solved = std::chrono::steady_clock::now();
  field.frames.reserve(field.coefficients.size());
  for (const Harmonic<kDegree>& h : field.coefficients) field.frames.push_back(NearestFrame<kDegree>(h));
  field.project_seconds = SecondsSince(solved);
  return field;
}

template Field<3> SolveField<3>(const TetMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TetMesh&, const FieldOptions<4>&);

}  // namespace octupole
