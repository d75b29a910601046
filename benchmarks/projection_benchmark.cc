// How fast is the projection to the nearest frame, for harmonics at a distance of 0.1 from the nearest octahedral one
// and for arbitrary ones?

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "octupole/frames/frame.h"
#include "octupole/frames/random_rotation.h"

namespace octupole {
namespace {

template <int kDegree>
Harmonic<kDegree> RandomUnit(std::mt19937* generator) {
  std::normal_distribution<double> normal;
  const Harmonic<kDegree> h = Harmonic<kDegree>::NullaryExpr([&] { return normal(*generator); });
  return h.normalized();
}

template <int kDegree>
void Project(benchmark::State& state, const std::vector<Harmonic<kDegree>>& inputs) {
  for (auto _ : state) {
    for (const Harmonic<kDegree>& h : inputs) benchmark::DoNotOptimize(NearestFrame<kDegree>(h));
  }
  state.SetItemsProcessed(state.iterations() * inputs.size());
}

constexpr int kNumInputs = 4096;

template <int kDegree>
void ProjectNear(benchmark::State& state) {
  std::mt19937 generator(1);
  std::vector<Harmonic<kDegree>> inputs;
  for (int i = 0; i < kNumInputs; ++i) {
    const Eigen::Matrix3d frame = RandomRotation(&generator).toRotationMatrix();
    inputs.push_back(HarmonicFromFrame<kDegree>(frame) + 0.1 * RandomUnit<kDegree>(&generator));
  }
  Project<kDegree>(state, inputs);
}
BENCHMARK(ProjectNear<3>);
BENCHMARK(ProjectNear<4>);

template <int kDegree>
void ProjectArbitrary(benchmark::State& state) {
  std::mt19937 generator(2);
  std::vector<Harmonic<kDegree>> inputs;
  for (int i = 0; i < kNumInputs; ++i) inputs.push_back(RandomUnit<kDegree>(&generator));
  Project<kDegree>(state, inputs);
}
BENCHMARK(ProjectArbitrary<3>);
BENCHMARK(ProjectArbitrary<4>);

}  // namespace
}  // namespace octupole

BENCHMARK_MAIN();
