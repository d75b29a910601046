#include "octupole/minimization/lbfgs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "octupole/minimization/internal/minimize_lbfgs.h"
#include "octupole/minimization/internal/simd.h"

namespace octupole {
namespace internal {
namespace {

constexpr int kMemory = 3;
// The steps s_i are at 2 i, the changes of the gradient y_i at 2 i + 1.
constexpr int kNumVectors = 2 * kMemory;
// Unknowns in a block of the history: small enough for all vectors of a block to stay in the first cache, and for their
// products to be added up as they are.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kBlocksPerRange = 16;
// Iterations over which the decrease of the cost is averaged.
constexpr int kWindow = 5;

template <typename Scalar>
using Unaligned = typename LanesOf<Scalar>::Unaligned;

template <typename Scalar>
OCTUPOLE_INLINE const Unaligned<Scalar>& At(const Scalar* address) {
  return *reinterpret_cast<const Unaligned<Scalar>*>(address);
}
template <typename Scalar>
OCTUPOLE_INLINE Unaligned<Scalar>& At(Scalar* address) {
  return *reinterpret_cast<Unaligned<Scalar>*>(address);
}

struct HistoryBlock {
  float vectors[kNumVectors][kBlock];
};

// Lanes of Scalar from the history and to it.
template <typename Scalar>
OCTUPOLE_INLINE void Load(const float* address, Lanes<Scalar>* lanes) {
  *lanes = __builtin_convertvector(*reinterpret_cast<const typename LanesOf<Scalar>::Floats*>(address), Lanes<Scalar>);
}
template <typename Scalar>
OCTUPOLE_INLINE void Store(const Lanes<Scalar>& lanes, float* address) {
  using Floats = typename LanesOf<Scalar>::Floats;
  *reinterpret_cast<Floats*>(address) = __builtin_convertvector(lanes, Floats);
}

using Coefficients = std::array<double, kNumVectors>;

// Inner products of the vectors of the history with the last pair and with the gradient.
struct Products {
  Coefficients step = {};
  Coefficients change = {};
  Coefficients gradient = {};
  double squared_gradient = 0;
  double max_gradient = 0;

  void Add(const Products& other) {
    for (int i = 0; i < kNumVectors; ++i) {
      step[i] += other.step[i];
      change[i] += other.change[i];
      gradient[i] += other.gradient[i];
    }
    squared_gradient += other.squared_gradient;
    max_gradient = std::max(max_gradient, other.max_gradient);
  }
};

template <typename Scalar>
struct Points {
  const Scalar* x;
  const Scalar* last_x;
  const Scalar* gradient;
  const Scalar* last_gradient;
};

// Stores the pair of one block in its slot, and adds up the block's inner products.
template <typename Scalar>
OCTUPOLE_INLINE void UpdateBlock(HistoryBlock* history, int slot, const Points<Scalar>& points, Products* products) {
  constexpr std::size_t kStep = kLanes<Scalar>;
  float* step = history->vectors[2 * slot];
  float* change = history->vectors[2 * slot + 1];
  Lanes<Scalar> squared = {}, largest = {};
  for (std::size_t i = 0; i < kBlock; i += kStep) {
    const Lanes<Scalar> g = At(points.gradient + i);
    const Lanes<Scalar> s = At(points.x + i) - At(points.last_x + i);
    const Lanes<Scalar> y = g - At(points.last_gradient + i);
    Store<Scalar>(s, step + i);
    Store<Scalar>(y, change + i);
    squared += g * g;
    const Lanes<Scalar> magnitude = g < Lanes<Scalar>{} ? -g : g;
    largest = magnitude > largest ? magnitude : largest;
  }
  for (std::size_t k = 0; k < kStep; ++k) {
    products->max_gradient = std::max(products->max_gradient, static_cast<double>(largest[k]));
  }
  products->squared_gradient += SumOf(squared);
  for (int k = 0; k < kNumVectors; ++k) {
    const float* vector = history->vectors[k];
    Lanes<Scalar> with_step = {}, with_change = {}, with_gradient = {};
    for (std::size_t i = 0; i < kBlock; i += kStep) {
      Lanes<Scalar> v, s, y;
      Load<Scalar>(vector + i, &v);
      Load<Scalar>(step + i, &s);
      Load<Scalar>(change + i, &y);
      with_step += v * s;
      with_change += v * y;
      with_gradient += v * At(points.gradient + i);
    }
    products->step[k] += SumOf(with_step);
    products->change[k] += SumOf(with_change);
    products->gradient[k] += SumOf(with_gradient);
  }
}

// x = last x + sum of coefficients times vectors, plus a multiple of the gradient, in one block.
template <typename Scalar>
OCTUPOLE_INLINE void CombineBlock(const HistoryBlock& history, const Coefficients& coefficients,
                                  double gradient_coefficient, const Scalar* last_x, const Scalar* gradient,
                                  Scalar* x) {
  for (std::size_t i = 0; i < kBlock; i += kLanes<Scalar>) {
    Lanes<Scalar> sum = static_cast<Scalar>(gradient_coefficient) * At(gradient + i);
    for (int k = 0; k < kNumVectors; ++k) {
      Lanes<Scalar> v;
      Load<Scalar>(history.vectors[k] + i, &v);
      sum += static_cast<Scalar>(coefficients[k]) * v;
    }
    At(x + i) = At(last_x + i) + sum;
  }
}

// The pairs of the last steps and their inner products.
template <typename Scalar>
class History {
 public:
  History(std::size_t num_blocks, Workers* workers) : workers_(workers), blocks_(num_blocks) {}

  void Clear() { size_ = 0; }
  bool IsEmpty() const { return size_ == 0; }
  double squared_gradient() const { return products_.squared_gradient; }
  double max_gradient() const { return products_.max_gradient; }

  // Takes the pair in, unless the curvature along the step is not positive.
  void Update(const Points<Scalar>& points) {
    const int slot = (newest_ + 1) % kMemory;
    partial_products_.assign((blocks_.size() + kBlocksPerRange - 1) / kBlocksPerRange, Products());
    workers_->ForEachRange(blocks_.size(), kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
      CallVectorised([&]() OCTUPOLE_INLINE_LAMBDA {
        for (std::size_t block = begin; block < end; ++block) {
          const std::size_t i = block * kBlock;
          UpdateBlock<Scalar>(&blocks_[block], slot,
                              {points.x + i, points.last_x + i, points.gradient + i, points.last_gradient + i},
                              &partial_products_[begin / kBlocksPerRange]);
        }
      });
    });
    products_ = Products();
    for (const Products& partial : partial_products_) products_.Add(partial);
    for (int k = 0; k < kNumVectors; ++k) {
      gram_[k][2 * slot] = gram_[2 * slot][k] = products_.step[k];
      gram_[k][2 * slot + 1] = gram_[2 * slot + 1][k] = products_.change[k];
    }
    const double curvature = gram_[2 * slot][2 * slot + 1];
    if (curvature > 0) {
      newest_ = slot;
      size_ = std::min(size_ + 1, kMemory);
    } else {
      // The slot held the oldest pair.
      size_ = std::min(size_, kMemory - 1);
    }
  }

  // Finds the quasi-Newton direction as a combination of vectors, and returns its product with the gradient.
  double FindDirection(double first_step) {
    Coefficients& coefficients = coefficients_;
    double& gradient_coefficient = gradient_coefficient_;
    coefficients.fill(0);
    gradient_coefficient = 1;
    // v_i . (combination so far).
    const auto product = [&](int i) {
      double sum = gradient_coefficient * products_.gradient[i];
      for (int k = 0; k < kNumVectors; ++k) {
        if (coefficients[k] != 0) sum += coefficients[k] * gram_[i][k];
      }
      return sum;
    };
    std::array<double, kMemory> removed;
    for (int age = 0; age < size_; ++age) {
      const int s = 2 * ((newest_ - age + kMemory) % kMemory), y = s + 1;
      removed[age] = product(s) / gram_[s][y];
      coefficients[y] -= removed[age];
    }
    const int y = 2 * newest_ + 1;
    const double inverse_curvature = size_ > 0 ? gram_[y - 1][y] / gram_[y][y] : first_step / products_.max_gradient;
    for (double& coefficient : coefficients) coefficient *= inverse_curvature;
    gradient_coefficient *= inverse_curvature;
    for (int age = size_ - 1; age >= 0; --age) {
      const int s = 2 * ((newest_ - age + kMemory) % kMemory);
      coefficients[s] += removed[age] - product(s + 1) / gram_[s][s + 1];
    }
    double slope = 0;
    for (int k = 0; k < kNumVectors; ++k) {
      coefficients[k] = -coefficients[k];
      if (coefficients[k] != 0) slope += coefficients[k] * products_.gradient[k];
    }
    gradient_coefficient = -gradient_coefficient;
    return slope + gradient_coefficient * products_.squared_gradient;
  }

  // x = last x + that direction.
  void Step(const std::vector<Scalar>& last_x, const std::vector<Scalar>& gradient, std::vector<Scalar>* x) const {
    workers_->ForEachRange(blocks_.size(), kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
      CallVectorised([&]() OCTUPOLE_INLINE_LAMBDA {
        for (std::size_t block = begin; block < end; ++block) {
          const std::size_t i = block * kBlock;
          CombineBlock<Scalar>(blocks_[block], coefficients_, gradient_coefficient_, last_x.data() + i,
                               gradient.data() + i, x->data() + i);
        }
      });
    });
  }

 private:
  Workers* workers_;
  std::vector<HistoryBlock> blocks_;
  std::vector<Products> partial_products_;
  Products products_;
  std::array<Coefficients, kNumVectors> gram_ = {};
  Coefficients coefficients_ = {};
  double gradient_coefficient_ = 0;
  int newest_ = kMemory - 1;
  int size_ = 0;
};

}  // namespace

template <typename Scalar>
LbfgsSummary MinimizeLbfgs(const SmoothFunction<Scalar>& function, const LbfgsOptions& options, Workers* workers,
                           std::vector<Scalar>* x) {
  constexpr double kSufficientDecrease = 1e-4;
  constexpr int kMaxCuts = 10;
  const std::size_t size = x->size();
  const std::size_t num_blocks = (size + kBlock - 1) / kBlock;
  // Filled up with zeros to whole blocks.
  std::vector<Scalar> point = std::move(*x);
  point.resize(num_blocks * kBlock, 0);
  std::vector<Scalar> last_point(point.size()), gradient(point.size()), last_gradient(point.size());
  History<Scalar> history(num_blocks, workers);

  LbfgsSummary summary;
  double cost = 0;
  const auto evaluate = [&] {
    ++summary.num_evaluations;
    return function(point.data(), &cost, gradient.data()) && std::isfinite(cost);
  };
  const auto finish = [&] {
    point.resize(size);
    *x = std::move(point);
    return summary;
  };
  if (!evaluate()) return finish();
  summary.initial_cost = summary.final_cost = cost;
  // Only for the products with the gradient: the step is zero.
  history.Update({point.data(), point.data(), gradient.data(), gradient.data()});

  std::array<double, kWindow> last_costs;
  last_costs.fill(cost);
  summary.termination = ceres::NO_CONVERGENCE;
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    if (history.max_gradient() <= options.gradient_tolerance || summary.final_cost < options.cost_tolerance) {
      summary.termination = ceres::CONVERGENCE;
      break;
    }
    double slope = history.FindDirection(options.first_step);
    if (!(slope < 0) && !history.IsEmpty()) {
      history.Clear();
      slope = history.FindDirection(options.first_step);
    }
    std::swap(point, last_point);
    std::swap(gradient, last_gradient);
    history.Step(last_point, last_gradient, &point);
    const double last_cost = summary.final_cost;
    double step = 1;
    bool is_lower = false;
    for (int cut = 0; cut < kMaxCuts; ++cut) {
      is_lower = evaluate() && cost <= last_cost + kSufficientDecrease * step * slope;
      if (is_lower) break;
      // The minimum of the parabola through what is known, within reason.
      const double parabola = -slope * step * step / (2 * (cost - last_cost - slope * step));
      const double part = std::isfinite(parabola) ? std::clamp(parabola / step, 0.1, 0.5) : 0.1;
      step *= part;
      workers->ForEachRange(point.size(), kBlock * kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          point[i] = last_point[i] + static_cast<Scalar>(part) * (point[i] - last_point[i]);
        }
      });
    }
    if (!is_lower) {
      std::swap(point, last_point);
      std::swap(gradient, last_gradient);
      if (history.IsEmpty()) {
        summary.termination = ceres::CONVERGENCE;
        break;
      }
      history.Clear();
      continue;
    }
    history.Update({point.data(), last_point.data(), gradient.data(), last_gradient.data()});
    summary.final_cost = cost;
    ++summary.num_iterations;
    if (options.callback != nullptr) {
      ceres::IterationSummary report;
      report.iteration = summary.num_iterations;
      report.cost = cost;
      report.cost_change = last_cost - cost;
      report.gradient_max_norm = history.max_gradient();
      report.step_size = step;
      const ceres::CallbackReturnType answer = (*options.callback)(report);
      if (answer != ceres::SOLVER_CONTINUE) {
        summary.termination = answer == ceres::SOLVER_ABORT ? ceres::USER_FAILURE : ceres::USER_SUCCESS;
        break;
      }
    }
    double& oldest_cost = last_costs[summary.num_iterations % kWindow];
    if (summary.num_iterations >= kWindow && oldest_cost - cost <= kWindow * options.function_tolerance * cost) {
      summary.termination = ceres::CONVERGENCE;
      break;
    }
    oldest_cost = cost;
  }
  return finish();
}

template LbfgsSummary MinimizeLbfgs(const SmoothFunction<float>&, const LbfgsOptions&, Workers*, std::vector<float>*);
template LbfgsSummary MinimizeLbfgs(const SmoothFunction<double>&, const LbfgsOptions&, Workers*, std::vector<double>*);

}  // namespace internal

LbfgsSummary MinimizeLbfgs(const ceres::FirstOrderFunction& function, const LbfgsOptions& options, Workers* workers,
                           std::vector<double>* x) {
  return internal::MinimizeLbfgs<double>(
      [&](const double* point, double* cost, double* gradient) { return function.Evaluate(point, cost, gradient); },
      options, workers, x);
}

}  // namespace octupole
