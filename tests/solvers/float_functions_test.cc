#include <gtest/gtest.h>

#include <cmath>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_energy.h"
#include "octupole/solvers/frame_energy.h"
#include "octupole/solvers/internal/field_function.h"
#include "octupole/solvers/internal/frame_function.h"
#include "random_inputs.h"

namespace octupole {
namespace {

// Sizes that leave from no to seven lanes of the last group empty.
FieldGraph AnyGraph(int cells, bool is_weighted) {
  const TetMesh mesh = MakeBoxMesh({cells, 2, 1}, {4, 2, 1});
  std::mt19937 generator(1);
  std::vector<Alignment> alignments;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    alignments.push_back(v % 3 == 1   ? Alignment::Axis(RandomDirection(&generator))
                         : v % 5 == 4 ? Alignment::Frame(RandomFrame(&generator))
                                      : Alignment());
  }
  FieldGraph graph = MakeFieldGraph(mesh, alignments);
  for (int i = 0; i < cells; ++i) graph.alignments.emplace_back();
  if (!is_weighted) return graph;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) graph.edges[e].weight = 0.3 * static_cast<double>(e % 7);
  return graph;
}

// In floats as in doubles, whose tests hold the energies against their definitions.
template <typename Double, typename Float>
void ExpectSame(const Double& in_doubles, const Float& in_floats) {
  ASSERT_EQ(in_floats.num_parameters(), in_doubles.NumParameters());
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  std::vector<double> x(in_doubles.NumParameters()), gradient(x.size());
  for (double& value : x) value = normal(generator);
  const std::vector<float> float_x(x.begin(), x.end());
  std::vector<float> float_gradient(x.size(), std::nanf(""));
  double cost = 0, float_cost = 0, largest = 0;
  in_doubles.Evaluate(x.data(), &cost, gradient.data());
  in_floats.Evaluate(float_x.data(), &float_cost, float_gradient.data());
  EXPECT_NEAR(float_cost, cost, 1e-5 * cost);
  for (const double value : gradient) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(float_gradient[i], gradient[i], 1e-5 * largest) << i;
}

template <int kDegree>
void ExpectSameField(const FieldGraph& graph) {
  Workers workers(2);
  const EnergyWeights weights = {3, 0.7};
  const internal::SweepGraph sweep_graph(graph);
  const internal::FieldFunction<kDegree, float> in_floats(sweep_graph, weights, &workers);
  ExpectSame(FieldEnergy<kDegree>(graph, weights, &workers), in_floats);
  // Alignments are kept in doubles.
  const auto field = in_floats.FieldOf(in_floats.ParametersOf(RandomField<kDegree>(graph, 1)));
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (graph.alignments[v].kind() == AlignmentKind::kFree) continue;
    EXPECT_LT((AlignedSubspace<kDegree>(graph.alignments[v]).Project(field[v]) - field[v]).norm(), 1e-14) << v;
  }
}

TEST(FloatFunctions, AreThoseInDoubles) {
  for (int cells = 1; cells <= 8; ++cells) {
    for (const bool is_weighted : {false, true}) {
      const FieldGraph graph = AnyGraph(cells, is_weighted);
      ExpectSameField<3>(graph);
      ExpectSameField<4>(graph);
      std::vector<Eigen::Matrix3d> frames;
      for (const Octupole& h : RandomField<3>(graph, 1)) {
        frames.push_back(NearestAlignedFrame<3>(graph.alignments[frames.size()], h));
      }
      Workers workers(2);
      const internal::SweepGraph sweep_graph(graph);
      ExpectSame(FrameEnergy(graph, frames, &workers), internal::FrameFunction<float>(sweep_graph, frames, &workers));
    }
  }
}

}  // namespace
}  // namespace octupole
