#include <gtest/gtest.h>

#include <cmath>

#include "any_graph.h"
#include "octupole/alignment/aligned_frame.h"
#include "octupole/energies/field_energy.h"
#include "octupole/energies/frame_energy.h"
#include "octupole/energies/internal/field_function.h"
#include "octupole/energies/internal/frame_function.h"

namespace octupole {
namespace {

// In floats as in doubles, whose tests hold the energies against their definitions.
template <typename Double, typename Float>
void ExpectSame(const Double& in_doubles, const Float& in_floats) {
  ASSERT_EQ(in_floats.num_parameters(), in_doubles.NumParameters());
  const std::vector<double> x = AnyParameters(in_doubles.NumParameters());
  std::vector<double> gradient(x.size());
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
      // Isolated vertices that leave from no to seven lanes of the last group empty.
      const FieldGraph graph = AnyGraph({cells, 2, 1}, cells, is_weighted);
      ExpectSameField<3>(graph);
      ExpectSameField<4>(graph);
      const std::vector<Eigen::Matrix3d> frames = AnyFrames(graph);
      Workers workers(2);
      const internal::SweepGraph sweep_graph(graph);
      ExpectSame(FrameEnergy(graph, frames, &workers), internal::FrameFunction<float>(sweep_graph, frames, &workers));
    }
  }
}

}  // namespace
}  // namespace octupole
