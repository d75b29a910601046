#include "octupole/solvers/field_solver.h"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "octupole/field/mid_edge_frames.h"
#include "octupole/frames/frame.h"
#include "octupole/solvers/fast_solver.h"
#include "octupole/solvers/huang.h"
#include "octupole/solvers/internal/minimizer.h"
#include "octupole/solvers/mbo.h"
#include "octupole/solvers/ray_sokolov.h"

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

  ceres::Solver::Summary& summary = field->ceres_summary.emplace();
  ceres::Solve(*options.solver, &problem, &summary);
  field->solve_seconds = summary.total_time_in_seconds;
  field->termination = summary.termination_type;
  field->iterations = summary.iterations;
  field->energy = 2 * summary.final_cost;
  field->size = SizeOfProblem(graph, kUnknownsOfKind<kDegree>);

  const auto solved = std::chrono::steady_clock::now();
  field->frames.reserve(field->coefficients.size());
  for (const Harmonic<kDegree>& h : field->coefficients) field->frames.push_back(NearestFrame<kDegree>(h));
  field->project_seconds = SecondsSince(solved);
}

template <int kDegree>
FieldSolution<kDegree> SolveClassic(const FieldGraph& graph, FieldMethod method, const MinimizerOptions& options) {
  FieldSolution<kDegree> result;
  FrameSolution& solution = result;
  switch (method) {
    case FieldMethod::kRaySokolov:
      solution = SolveRaySokolov(graph, options);
      break;
    case FieldMethod::kHuang:
      solution = SolveHuang(graph, options);
      break;
    default:
      solution = SolveMbo(graph, options);
  }
  result.coefficients = internal::HarmonicsOf<kDegree>(result.frames);
  return result;
}

template <int kDegree>
FieldSolution<kDegree> SolveWithoutCeres(const FieldGraph& graph, const FieldOptions<kDegree>& options) {
  MinimizerOptions minimizer = options.minimizer;
  minimizer.seed = options.seed;
  if (options.method != FieldMethod::kPenalty) return SolveClassic<kDegree>(graph, options.method, minimizer);
  if (!options.start.empty()) return SolveFastFrom<kDegree>(graph, options.weights, options.start, minimizer);
  return SolveFast<kDegree>(graph, options.weights, minimizer);
}

template <int kDegree>
BoundaryAlignment Align(const TetMesh& mesh, const FieldOptions<kDegree>& options) {
  CheckTetMesh(mesh);
  return AlignToBoundary(mesh, {options.feature_angle_deg, options.regions});
}

template <int kDegree>
BoundaryAlignment Align(const TriangleMesh& surface, const FieldOptions<kDegree>& options) {
  CheckTriangleMesh(surface);
  return AlignToSurface(surface, options.feature_angle_deg, options.open_boundary);
}

template <int kDegree>
void FillMidEdgeNodes(const TetMesh& mesh, Field<kDegree>* field) {
  if (!field->IsUsable()) return;
  SetMidEdgeFrames(mesh, &field->frames);
  for (const auto& [node, a, b] : mesh.mid_edge_nodes) {
    field->coefficients[node] = HarmonicFromFrame<kDegree>(field->frames[node]);
  }
}

template <int kDegree, typename Mesh>
Field<kDegree> SolveOnMesh(const Mesh& mesh, const FieldOptions<kDegree>& options) {
  if (options.method != FieldMethod::kPenalty && (options.solver || !options.start.empty())) {
    throw std::invalid_argument("SolveField: only the penalty method takes a start or a solver");
  }
  const auto start = std::chrono::steady_clock::now();
  Field<kDegree> field;
  field.alignment = Align(mesh, options);
  const FieldGraph graph = MakeFieldGraph(mesh, field.alignment.alignments);
  field.setup_seconds = SecondsSince(start);
  if (options.solver) {
    SolveWithCeres(graph, options, &field);
    return field;
  }
  const auto ready = std::chrono::steady_clock::now();
  static_cast<FieldSolution<kDegree>&>(field) = SolveWithoutCeres(graph, options);
  field.solve_seconds = SecondsSince(ready);
  return field;
}

}  // namespace

template <int kDegree>
Field<kDegree> SolveField(const TetMesh& mesh, const FieldOptions<kDegree>& options) {
  Field<kDegree> field = SolveOnMesh(mesh, options);
  FillMidEdgeNodes(mesh, &field);
  return field;
}

template <int kDegree>
Field<kDegree> SolveField(const TriangleMesh& surface, const FieldOptions<kDegree>& options) {
  return SolveOnMesh(surface, options);
}

template Field<3> SolveField<3>(const TetMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TetMesh&, const FieldOptions<4>&);
template Field<3> SolveField<3>(const TriangleMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TriangleMesh&, const FieldOptions<4>&);

}  // namespace octupole
