#include "octupole/maps/foldover_energy.h"

#include <gtest/gtest.h>

#include <cmath>

namespace octupole {
namespace {

TEST(FoldoverEnergy, HasTheDerivativesItSays) {
  constexpr double kStep = 1e-5;
  for (const double epsilon : {0.1, 1.}) {
    for (const double det : {-2., -0.3, 0., 0.2, 1.5}) {
      for (const double s : {0.5, 3., 9.}) {
        const FoldoverEnergy e = EvaluateFoldoverEnergy(s, det, epsilon);
        const auto energy = [&](double ds, double dd) {
          return EvaluateFoldoverEnergy(s + ds, det + dd, epsilon).energy;
        };
        const double scale = 1e-6 * (1 + e.energy) / epsilon / epsilon;
        EXPECT_NEAR(e.by_norm, (energy(kStep, 0) - energy(-kStep, 0)) / (2 * kStep), scale);
        EXPECT_NEAR(e.by_det, (energy(0, kStep) - energy(0, -kStep)) / (2 * kStep), scale);
        const double mixed = (EvaluateFoldoverEnergy(s, det + kStep, epsilon).by_norm -
                              EvaluateFoldoverEnergy(s, det - kStep, epsilon).by_norm) /
                             (2 * kStep);
        EXPECT_NEAR(e.by_norm_det, mixed, scale);
        const double second = (EvaluateFoldoverEnergy(s, det + kStep, epsilon).by_det -
                               EvaluateFoldoverEnergy(s, det - kStep, epsilon).by_det) /
                              (2 * kStep);
        EXPECT_GE(e.by_det_det, second - scale) << "raised, never lowered";
        EXPECT_GE(e.by_det_det * 2 * e.by_norm, 4 * s * e.by_norm_det * e.by_norm_det * (1 - 1e-12)) << "convex";
      }
    }
  }
}

TEST(FoldoverEnergy, IsFiniteWhenFarTurnedOverAndLeastAtRotations) {
  EXPECT_TRUE(std::isfinite(EvaluateFoldoverEnergy(3, -1e6, 1e-6).energy));
  EXPECT_NEAR(EvaluateFoldoverEnergy(3, 1, 1e-9).energy, 5, 1e-9);
  EXPECT_NEAR(EvaluateFoldoverEnergy(3, 1, 1e-9).by_norm * 2 / 3 * 3 + EvaluateFoldoverEnergy(3, 1, 1e-9).by_det, 2 - 2,
              1e-6)
      << "no force to grow or shrink: dE of J -> (1 + t) J is 2 s by_norm + 3 det by_det";
}

TEST(FoldoverEnergy, EpsilonFallsOnceNothingIsTurnedOver) {
  EXPECT_LT(NextEpsilon(0.1, 0.5, 10, 9), 1e-6);
  const double next = NextEpsilon(0.1, -0.2, 10, 9);
  EXPECT_GT(next, 0);
  EXPECT_LT(next, 0.1);
}

}  // namespace
}  // namespace octupole
