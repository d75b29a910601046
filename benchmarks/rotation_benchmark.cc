// How fast is D(R)? From a rotation matrix, from a quaternion, and, for comparison, as the matrix exponential of the
// generators.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "octupole/frames/random_rotation.h"
#include "octupole/harmonics/rotation.h"

namespace octupole {
namespace {

std::vector<Eigen::Quaterniond> Rotations() {
  std::mt19937 generator(1);
  std::vector<Eigen::Quaterniond> rotations(1024);
  for (Eigen::Quaterniond& rotation : rotations) rotation = RandomRotation(&generator);
  return rotations;
}

template <typename Input, typename Rotate>
void Run(benchmark::State& state, const std::vector<Input>& inputs, Rotate rotate) {
  for (auto _ : state) {
    for (const Input& input : inputs) benchmark::DoNotOptimize(rotate(input));
  }
  state.SetItemsProcessed(state.iterations() * inputs.size());
}

template <int kDegree>
void FromMatrix(benchmark::State& state) {
  std::vector<Eigen::Matrix3d> matrices;
  for (const Eigen::Quaterniond& q : Rotations()) matrices.push_back(q.toRotationMatrix());
  Run(state, matrices, [](const Eigen::Matrix3d& matrix) { return HarmonicRotation<kDegree>(matrix); });
}
BENCHMARK(FromMatrix<3>);
BENCHMARK(FromMatrix<4>);

template <int kDegree>
void FromQuaternion(benchmark::State& state) {
  Run(state, Rotations(), [](const Eigen::Quaterniond& q) { return HarmonicRotation<kDegree>(q); });
}
BENCHMARK(FromQuaternion<3>);
BENCHMARK(FromQuaternion<4>);

template <int kDegree>
void ExponentialOfGenerators(benchmark::State& state) {
  std::vector<Eigen::Vector3d> vectors;
  for (const Eigen::Quaterniond& q : Rotations()) {
    const Eigen::AngleAxisd turn(q);
    vectors.push_back(turn.angle() * turn.axis());
  }
  const auto& generators = RotationGenerators<kDegree>();
  Run(state, vectors, [&](const Eigen::Vector3d& vector) {
    const HarmonicMatrix<kDegree> generator =
        vector[0] * generators[0] + vector[1] * generators[1] + vector[2] * generators[2];
    return HarmonicMatrix<kDegree>(generator.exp());
  });
}
BENCHMARK(ExponentialOfGenerators<3>);
BENCHMARK(ExponentialOfGenerators<4>);

}  // namespace
}  // namespace octupole

BENCHMARK_MAIN();
