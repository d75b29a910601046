#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace octupole {

/// A team of threads for loops over ranges of indices. Threads sleep between loops and take ranges one by one, so that
/// a busy core delays a loop by one range only. What a loop computes does not depend on the number of threads: the
/// ranges do not, and sums are added up in their order.
class Workers {
 public:
  /// \throw std::invalid_argument unless num_threads is at least 1.
  explicit Workers(int num_threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  using Range = std::function<void(std::size_t begin, std::size_t end)>;
  using RangeSum = std::function<double(std::size_t begin, std::size_t end)>;

  /// Calls `work` for consecutive ranges of at most `grain` indices that make up [0, size), and waits for all of them.
  /// `work` must not throw.
  void ForEachRange(std::size_t size, std::size_t grain, const Range& work);

  /// The same, adding up what `work` returns.
  double Sum(std::size_t size, std::size_t grain, const RangeSum& work);

 private:
  void Run();
  void TakeRanges();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable start_;
  std::condition_variable finish_;
  // All below are guarded by the mutex.
  const Range* work_ = nullptr;
  std::size_t size_ = 0;
  std::size_t grain_ = 1;
  std::size_t next_ = 0;
  std::size_t num_busy_ = 0;
  std::size_t loop_ = 0;
  bool is_ending_ = false;
  std::vector<double> partial_sums_;
};

}  // namespace octupole
