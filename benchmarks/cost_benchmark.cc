// Autodiff against analytic residual blocks, on the whole evaluation that a solver asks for: cost and gradient of a
// ceres::Problem, and the same with its Jacobian. Run benchmarks/cost_benchmark of a build with
// -DOCTUPOLE_BUILD_BENCHMARKS=ON; compare the columns of one run.
#include <benchmark/benchmark.h>
#include <ceres/crs_matrix.h>
#include <ceres/problem.h>

#include <array>
#include <string>
#include <vector>

#include "octupole/cost_functions/analytic_deviation_cost.h"
#include "octupole/cost_functions/analytic_injectivity_cost.h"
#include "octupole/cost_functions/analytic_map_gradient_cost.h"
#include "octupole/cost_functions/analytic_smoothness_cost.h"
#include "octupole/cost_functions/deviation_cost.h"
#include "octupole/cost_functions/injectivity_cost.h"
#include "octupole/cost_functions/map_gradient_cost.h"
#include "octupole/cost_functions/smoothness_cost.h"
#include "octupole/energies/field_problem.h"
#include "octupole/mesh/box_mesh.h"

namespace octupole {
namespace {

FieldGraph BoxGraph() {
  const TetMesh mesh = MakeBoxMesh({12, 12, 12}, {1, 1, 1});
  return MakeFieldGraph(mesh, std::vector<Alignment>(mesh.points.size()));
}

void Evaluate(ceres::Problem* problem, benchmark::State* state) {
  double cost;
  std::vector<double> gradient;
  ceres::CRSMatrix jacobian;
  ceres::Problem::EvaluateOptions options;
  for (auto _ : *state) {
    problem->Evaluate(options, &cost, nullptr, &gradient, state->range(0) == 0 ? nullptr : &jacobian);
    benchmark::DoNotOptimize(cost);
  }
}

template <int kDegree>
void EdgeTerms(benchmark::State& state, ceres::CostFunction* (*create)(double)) {
  const FieldGraph graph = BoxGraph();
  std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(graph, 0);
  ceres::Problem problem;
  ceres::CostFunction* cost = create(1);
  for (const WeightedEdge& e : graph.edges) {
    problem.AddResidualBlock(cost, nullptr, field[e.a].data(), field[e.b].data());
  }
  Evaluate(&problem, &state);
}

template <int kDegree>
void VertexTerms(benchmark::State& state, ceres::CostFunction* (*create)(double)) {
  std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(BoxGraph(), 0);
  ceres::Problem problem;
  ceres::CostFunction* cost = create(1);
  for (Harmonic<kDegree>& h : field) problem.AddResidualBlock(cost, nullptr, h.data());
  Evaluate(&problem, &state);
}

// Of a map: one block for each tetrahedron, over parameters of the points.
void TetTerms(benchmark::State& state, ceres::CostFunction* (*create)(const std::array<Eigen::Vector3d, 4>& corners)) {
  const TetMesh mesh = MakeBoxMesh({12, 12, 12}, {1, 1, 1});
  std::vector<Eigen::Vector3d> parameters = mesh.points;
  ceres::Problem problem;
  for (const auto& [a, b, c, d] : mesh.tets) {
    problem.AddResidualBlock(create({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]}), nullptr,
                             parameters[a].data(), parameters[b].data(), parameters[c].data(), parameters[d].data());
  }
  Evaluate(&problem, &state);
}

template <typename Cost>
ceres::CostFunction* CreateGradientTerm(const std::array<Eigen::Vector3d, 4>& corners) {
  return Cost::Create(corners, Eigen::Matrix3d::Identity(), 1, 1);
}

template <typename Cost>
ceres::CostFunction* CreateInjectivityTerm(const std::array<Eigen::Vector3d, 4>& corners) {
  return Cost::Create(corners, 1, 0.1, 1);
}

template <int kDegree>
void FieldEnergy(benchmark::State& state) {
  const FieldGraph graph = BoxGraph();
  std::vector<Harmonic<kDegree>> field = RandomField<kDegree>(graph, 0);
  ceres::Problem problem;
  BuildFieldProblem<kDegree>(graph, {}, &field, &problem);
  Evaluate(&problem, &state);
}

template <int kDegree>
void Register(const std::string& degree) {
  using benchmark::RegisterBenchmark;
  for (benchmark::internal::Benchmark* registered :
       {RegisterBenchmark(("smoothness autodiff " + degree).c_str(), EdgeTerms<kDegree>,
                          SmoothnessCost<kDegree>::Create),
        RegisterBenchmark(("smoothness analytic " + degree).c_str(), EdgeTerms<kDegree>,
                          AnalyticSmoothnessCost<kDegree>::Create),
        RegisterBenchmark(("deviation autodiff " + degree).c_str(), VertexTerms<kDegree>,
                          DeviationCost<kDegree>::Create),
        RegisterBenchmark(("deviation analytic " + degree).c_str(), VertexTerms<kDegree>,
                          AnalyticDeviationCost<kDegree>::Create),
        RegisterBenchmark(("field energy " + degree).c_str(), FieldEnergy<kDegree>)}) {
    registered->ArgName("jacobian")->Arg(0)->Arg(1);
  }
}

void RegisterMapTerms() {
  using benchmark::RegisterBenchmark;
  for (benchmark::internal::Benchmark* registered :
       {RegisterBenchmark("map gradient autodiff", TetTerms, CreateGradientTerm<MapGradientCost>),
        RegisterBenchmark("map gradient analytic", TetTerms, CreateGradientTerm<AnalyticMapGradientCost>),
        RegisterBenchmark("injectivity autodiff", TetTerms, CreateInjectivityTerm<InjectivityCost>),
        RegisterBenchmark("injectivity analytic", TetTerms, CreateInjectivityTerm<AnalyticInjectivityCost>)}) {
    registered->ArgName("jacobian")->Arg(0)->Arg(1);
  }
}

}  // namespace
}  // namespace octupole

int main(int argc, char** argv) {
  octupole::Register<3>("degree 3");
  octupole::Register<4>("degree 4");
  octupole::RegisterMapTerms();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
