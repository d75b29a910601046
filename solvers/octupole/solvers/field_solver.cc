#include "octupole/solvers/field_solver.h"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/cost_functions/alignment_cost.h"
#include "octupole/field/mid_edge_frames.h"
#include "octupole/frames/frame.h"
#include "octupole/minimization/internal/seconds_since.h"
#include "octupole/solvers/fast_solver.h"
#include "octupole/solvers/huang.h"
#include "octupole/solvers/internal/minimizer.h"
#include "octupole/solvers/mbo.h"
#include "octupole/solvers/ray_sokolov.h"

namespace octupole {
namespace {

using internal::SecondsSince;

template <int kDegree>
void SolveWithCeres(const FieldGraph& graph, const FieldOptions<kDegree>& options, Field<kDegree>* field) {
  const auto start = std::chrono::steady_clock::now();
  field->coefficients = !options.start.empty()          ? options.start
                        : !options.start_frames.empty() ? internal::HarmonicsOf<kDegree>(options.start_frames)
                                                        : RandomField<kDegree>(graph, options.seed);
  ceres::Problem problem;
  BuildFieldProblem<kDegree>(graph, options.weights, &field->coefficients, &problem);
  if (options.constraint_weight) {
    for (const auto& [vertex, alignment] : options.constraints) {
      problem.AddResidualBlock(AlignmentCost<kDegree>::Create(alignment, *options.constraint_weight), nullptr,
                               field->coefficients[vertex].data());
    }
  }
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
  for (std::size_t v = 0; v < field->coefficients.size(); ++v) {
    field->frames.push_back(NearestAlignedFrame<kDegree>(graph.alignments[v], field->coefficients[v]));
  }
  field->project_seconds = SecondsSince(solved);
}

template <int kDegree>
FieldSolution<kDegree> SolveClassic(const FieldGraph& graph, const FieldOptions<kDegree>& options,
                                    const MinimizerOptions& minimizer) {
  FieldSolution<kDegree> result;
  FrameSolution& solution = result;
  std::vector<int> constrained_vertices;
  for (const Constraint& constraint : options.constraints) constrained_vertices.push_back(constraint.vertex);
  switch (options.method) {
    case FieldMethod::kRaySokolov:
      solution = SolveRaySokolov(graph, minimizer);
      break;
    case FieldMethod::kHuang:
      solution = SolveHuang(graph, minimizer, constrained_vertices);
      break;
    default:
      solution = SolveMbo(graph, minimizer);
  }
  result.coefficients = internal::HarmonicsOf<kDegree>(result.frames);
  return result;
}

template <int kDegree>
FieldSolution<kDegree> SolveWithoutCeres(const FieldGraph& graph, const FieldOptions<kDegree>& options) {
  MinimizerOptions minimizer = options.minimizer;
  minimizer.seed = options.seed;
  if (options.method != FieldMethod::kPenalty) return SolveClassic<kDegree>(graph, options, minimizer);
  if (!options.start_frames.empty()) {
    return PolishField<kDegree>(graph, options.weights, options.start_frames, minimizer);
  }
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
    const Alignment& alignment = field->alignment.alignments[node];
    if (alignment.kind() != AlignmentKind::kFree) {  // by a constraint
      field->frames[node] = NearestAlignedFrame<4>(alignment, HarmonicFromFrame<4>(field->frames[node]));
    }
    field->coefficients[node] = HarmonicFromFrame<kDegree>(field->frames[node]);
  }
}

// Puts the constraints into the alignments; soft ones only after their summary.
template <int kDegree>
void Constrain(const FieldOptions<kDegree>& options, Field<kDegree>* field) {
  if (options.constraint_weight) {
    std::vector<Alignment> alignments = field->alignment.alignments;
    field->constraints = ApplyConstraints(options.constraints, &alignments);
  } else {
    field->constraints = ApplyConstraints(options.constraints, &field->alignment.alignments);
  }
}

template <int kDegree>
void SolveGraph(const FieldGraph& graph, const FieldOptions<kDegree>& options, Field<kDegree>* field) {
  if (options.solver) {
    SolveWithCeres(graph, options, field);
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  static_cast<FieldSolution<kDegree>&>(*field) = SolveWithoutCeres(graph, options);
  field->solve_seconds = SecondsSince(start);
}

template <int kDegree>
void CheckOptions(const FieldOptions<kDegree>& options) {
  const bool has_start = !options.start.empty() || !options.start_frames.empty();
  if (options.method != FieldMethod::kPenalty && (options.solver || has_start)) {
    throw std::invalid_argument("SolveField: only the penalty method takes a start or a solver");
  }
  if (!options.start.empty() && !options.start_frames.empty()) {
    throw std::invalid_argument("SolveField: both start and start_frames are given");
  }
  if (options.constraint_weight && !options.solver) {
    throw std::invalid_argument("SolveField: only Ceres takes soft constraints, a constraint_weight");
  }
}

template <int kDegree, typename Mesh>
Field<kDegree> SolveOnMesh(const Mesh& mesh, FieldOptions<kDegree> options) {
  CheckOptions(options);
  const auto start = std::chrono::steady_clock::now();
  Field<kDegree> field;
  field.alignment = Align(mesh, options);
  Constrain(options, &field);
  const FieldGraph graph = MakeFieldGraph(mesh, field.alignment.alignments, options.edge_weights);
  const double mean_weight = MeanEdgeWeight(graph);
  options.weights.scale *= mean_weight;
  options.weights.deviation *= mean_weight;
  field.setup_seconds = SecondsSince(start);
  SolveGraph(graph, options, &field);
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

template <int kDegree>
Field<kDegree> SolveField(const FieldGraph& graph, const FieldOptions<kDegree>& options) {
  CheckOptions(options);
  CheckFieldGraph(graph);
  Field<kDegree> field;
  field.alignment.alignments = graph.alignments;
  if (options.constraints.empty()) {
    SolveGraph(graph, options, &field);
  } else {
    Constrain(options, &field);
    SolveGraph({graph.edges, field.alignment.alignments}, options, &field);
  }
  return field;
}

template Field<3> SolveField<3>(const TetMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TetMesh&, const FieldOptions<4>&);
template Field<3> SolveField<3>(const TriangleMesh&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const TriangleMesh&, const FieldOptions<4>&);
template Field<3> SolveField<3>(const FieldGraph&, const FieldOptions<3>&);
template Field<4> SolveField<4>(const FieldGraph&, const FieldOptions<4>&);

}  // namespace octupole
