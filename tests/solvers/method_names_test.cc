#include "octupole/solvers/method_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace octupole {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(MethodNames, LeadThereAndBack) {
  for (const FieldMethod method :
       {FieldMethod::kPenalty, FieldMethod::kRaySokolov, FieldMethod::kHuang, FieldMethod::kMbo}) {
    EXPECT_EQ(FieldMethodOf(NameOf(method)), method);
  }
  EXPECT_EQ(FieldMethodOf("mbo"), FieldMethod::kMbo);
  EXPECT_EQ(SolverPresetOf("cgnr"), SolverPreset::kConjugateGradients);
  EXPECT_EQ(SolverPresetOf("fast"), std::nullopt);
  EXPECT_EQ(OpenBoundaryOf("free"), OpenBoundary::kFree);
  EXPECT_EQ(EdgeWeightsOf("fem"), EdgeWeights::kFiniteElement);
}

TEST(MethodNames, UnknownOnesSayWhichThereAre) {
  EXPECT_THAT([] { FieldMethodOf("magic"); },
              ThrowsMessage<std::invalid_argument>("method: 'magic' is none of huang, mbo, penalty, ray-sokolov"));
  EXPECT_THAT([] { SolverPresetOf(""); },
              ThrowsMessage<std::invalid_argument>("solver: '' is none of cgnr, cholesky, fast, lbfgs"));
  EXPECT_THAT([] { OpenBoundaryOf("Free"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("aligned, free")));
}

}  // namespace
}  // namespace octupole
