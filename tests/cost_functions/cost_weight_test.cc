#include "octupole/cost_functions/cost_weight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace octupole {
namespace {

TEST(RootOfWeight, TakesTheRoot) {
  EXPECT_EQ(RootOfWeight("Caller", 6.25), 2.5);
  EXPECT_EQ(RootOfWeight("Caller", 0), 0);
}

TEST(RootOfWeight, NamesCallerAndValue) {
  try {
    RootOfWeight("ScaleCost", -2);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "ScaleCost: the weight must be finite and not negative, not -2");
  }
}

}  // namespace
}  // namespace octupole
