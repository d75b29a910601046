#include "octupole/minimization/workers.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace octupole {

Workers::Workers(int num_threads) {
  if (num_threads < 1) {
    throw std::invalid_argument("Workers: the number of threads must be at least 1, not " +
                                std::to_string(num_threads));
  }
  // The calling thread is one of them.
  for (int i = 1; i < num_threads; ++i) threads_.emplace_back([this] { Run(); });
}

Workers::~Workers() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::Run() {
  std::size_t last_loop = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      start_.wait(lock, [&] { return is_ending_ || loop_ != last_loop; });
      if (is_ending_) return;
      last_loop = loop_;
      if (next_ >= size_) continue;  // too late for this loop
      ++num_busy_;
    }
    TakeRanges();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      --num_busy_;
    }
    finish_.notify_one();
  }
}

void Workers::TakeRanges() {
  for (;;) {
    std::size_t begin, end;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (next_ >= size_) return;
      begin = next_;
      end = next_ = std::min(size_, begin + grain_);
    }
    (*work_)(begin, end);
  }
}

void Workers::ForEachRange(std::size_t size, std::size_t grain, const Range& work) {
  if (threads_.empty() || size <= grain) {
    for (std::size_t begin = 0; begin < size; begin += grain) work(begin, std::min(size, begin + grain));
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_ = &work;
    size_ = size;
    grain_ = grain;
    next_ = 0;
    ++loop_;
  }
  start_.notify_all();
  TakeRanges();
  std::unique_lock<std::mutex> lock(mutex_);
  finish_.wait(lock, [&] { return num_busy_ == 0; });
}

double Workers::Sum(std::size_t size, std::size_t grain, const RangeSum& work) {
  partial_sums_.assign((size + grain - 1) / grain, 0);
  ForEachRange(size, grain,
               [&](std::size_t begin, std::size_t end) { partial_sums_[begin / grain] = work(begin, end); });
  return std::accumulate(partial_sums_.begin(), partial_sums_.end(), 0.);
}

}  // namespace octupole
