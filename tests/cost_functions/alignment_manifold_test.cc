#include "octupole/cost_functions/alignment_manifold.h"

#include <ceres/manifold_test_utils.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "octupole/frames/frame.h"
#include "random_inputs.h"

namespace octupole {
namespace {

// The macro of Ceres 2.1 names its matchers without a namespace.
using namespace ceres;  // NOLINT(google-build-using-namespace)

template <typename Degree>
class AlignmentManifoldTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(AlignmentManifoldTest, Degrees);

TYPED_TEST(AlignmentManifoldTest, HoldsCeresInvariants) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(1);
  const std::vector<std::pair<Alignment, int>> cases = {{Alignment(), kDimension<l>},
                                                        {Alignment::Axis(RandomDirection(&generator)), 2},
                                                        {Alignment::Frame(RandomFrame(&generator)), 1}};
  for (const auto& [alignment, tangent_size] : cases) {
    const AlignmentManifold<l> manifold(alignment);
    const AlignedSubspace<l> subspace(alignment);
    EXPECT_EQ(manifold.AmbientSize(), kDimension<l>);
    EXPECT_EQ(manifold.TangentSize(), tangent_size);
    for (int i = 0; i < 20; ++i) {
      const ceres::Vector x = subspace.Project(RandomHarmonic<l>(&generator));
      const ceres::Vector y = subspace.Project(RandomHarmonic<l>(&generator));
      const ceres::Vector delta = ceres::Vector::Random(tangent_size);
      EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
    }
  }
}

TYPED_TEST(AlignmentManifoldTest, KeepsToTheAxis) {
  constexpr int l = TypeParam::value;
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d axis = RandomDirection(&generator);
    const Alignment alignment = Alignment::Axis(axis);
    const AlignmentManifold<l> manifold(alignment);
    const Harmonic<l> x = HarmonicFromFrame<l>(alignment.frame());
    const Eigen::Vector2d delta = Eigen::Vector2d::Random();
    Harmonic<l> y;
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), y.data()));
    const Eigen::Matrix3d frame = NearestFrame<l>(y);
    EXPECT_NEAR((frame.transpose() * axis).cwiseAbs().maxCoeff(), 1, 1e-12);
  }
}

}  // namespace
}  // namespace octupole
