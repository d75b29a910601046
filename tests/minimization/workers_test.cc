#include "octupole/minimization/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace octupole {
namespace {

TEST(Workers, CoverEveryIndexOnce) {
  for (const int num_threads : {1, 2, 5}) {
    Workers workers(num_threads);
    for (const std::size_t size : {0, 1, 7, 8, 1000}) {
      std::vector<std::atomic<int>> visits(size);
      workers.ForEachRange(size, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& count : visits) ASSERT_EQ(count, 1) << num_threads << " threads, size " << size;
    }
  }
}

TEST(Workers, AddUpInTheSameOrderOnAnyNumberOfThreads) {
  const auto sum = [](int num_threads) {
    Workers workers(num_threads);
    return workers.Sum(1000, 7, [](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += 1. / static_cast<double>(1 + i * i);
      return part;
    });
  };
  EXPECT_NEAR(sum(1), 2.07567, 1e-5);
  for (const int num_threads : {2, 3, 4}) EXPECT_EQ(sum(num_threads), sum(1)) << num_threads;
}

TEST(Workers, SurviveManyShortLoops) {
  Workers workers(4);
  double total = 0;
  for (int loop = 0; loop < 2000; ++loop) {
    total += workers.Sum(10, 1, [](std::size_t begin, std::size_t) { return static_cast<double>(begin); });
  }
  EXPECT_EQ(total, 2000 * 45);
}

TEST(Workers, RefuseToBeNone) { EXPECT_THROW(Workers(0), std::invalid_argument); }

}  // namespace
}  // namespace octupole
