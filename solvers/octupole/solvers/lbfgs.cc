#include "octupole/solvers/lbfgs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "octupole/solvers/internal/simd.h"

namespace octupole {
namespace {

using internal::Lanes;

constexpr int kMemory = 5;
// The steps s_i are at 2 i, the changes of the gradient y_i at 2 i + 1.
constexpr int kNumVectors = 2 * kMemory;
// Unknowns in a block of the history: small enough for all vectors of a block to stay in the first cache.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kBlocksPerRange = 16;
// Iterations over which the decrease of the cost is averaged.
constexpr int kWindow = 5;

typedef double UnalignedLanes __attribute__((vector_size(32), aligned(8), may_alias));
typedef float FloatLanes __attribute__((vector_size(16), aligned(4), may_alias));

OCTUPOLE_INLINE const UnalignedLanes& At(const double* address) {
  return *reinterpret_cast<const UnalignedLanes*>(address);
}
OCTUPOLE_INLINE UnalignedLanes& At(double* address) { return *reinterpret_cast<UnalignedLanes*>(address); }
OCTUPOLE_INLINE double SumOf(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }

struct HistoryBlock {
  float vectors[kNumVectors][kBlock];
};

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

struct Points {
  const double* x;
  const double* last_x;
  const double* gradient;
  const double* last_gradient;
};

// Stores the pair of one block in its slot, and adds up the block's inner products.
OCTUPOLE_INLINE void UpdateBlock(HistoryBlock* history, int slot, const Points& points, Products* products) {
  float* step = history->vectors[2 * slot];
  float* change = history->vectors[2 * slot + 1];
  Lanes squared = {};
  for (std::size_t i = 0; i < kBlock; i += 4) {
    const Lanes s = At(points.x + i) - At(points.last_x + i);
    const Lanes y = At(points.gradient + i) - At(points.last_gradient + i);
    *reinterpret_cast<FloatLanes*>(step + i) = __builtin_convertvector(s, FloatLanes);
    *reinterpret_cast<FloatLanes*>(change + i) = __builtin_convertvector(y, FloatLanes);
    squared += At(points.gradient + i) * At(points.gradient + i);
  }
  for (std::size_t i = 0; i < kBlock; ++i) {
    products->max_gradient = std::max(products->max_gradient, std::abs(points.gradient[i]));
  }
  products->squared_gradient += SumOf(squared);
  for (int k = 0; k < kNumVectors; ++k) {
    const float* vector = history->vectors[k];
    Lanes with_step = {}, with_change = {}, with_gradient = {};
    for (std::size_t i = 0; i < kBlock; i += 4) {
      const Lanes v = __builtin_convertvector(*reinterpret_cast<const FloatLanes*>(vector + i), Lanes);
      with_step += v * __builtin_convertvector(*reinterpret_cast<const FloatLanes*>(step + i), Lanes);
      with_change += v * __builtin_convertvector(*reinterpret_cast<const FloatLanes*>(change + i), Lanes);
      with_gradient += v * At(points.gradient + i);
    }
    products->step[k] += SumOf(with_step);
    products->change[k] += SumOf(with_change);
    products->gradient[k] += SumOf(with_gradient);
  }
}

// direction = sum of coefficients times vectors, plus a multiple of the gradient, in one block.
OCTUPOLE_INLINE void CombineBlock(const HistoryBlock& history, const Coefficients& coefficients,
                                  double gradient_coefficient, const double* gradient, double* direction) {
  for (std::size_t i = 0; i < kBlock; i += 4) {
    Lanes sum = gradient_coefficient * At(gradient + i);
    for (int k = 0; k < kNumVectors; ++k) {
      sum += coefficients[k] *
             __builtin_convertvector(*reinterpret_cast<const FloatLanes*>(history.vectors[k] + i), Lanes);
    }
    At(direction + i) = sum;
  }
}

void UpdateNarrow(HistoryBlock* history, int slot, const Points& points, Products* products) {
  UpdateBlock(history, slot, points, products);
}
OCTUPOLE_WIDE void UpdateWide(HistoryBlock* history, int slot, const Points& points, Products* products) {
  UpdateBlock(history, slot, points, products);
}
void CombineNarrow(const HistoryBlock& history, const Coefficients& coefficients, double gradient_coefficient,
                   const double* gradient, double* direction) {
  CombineBlock(history, coefficients, gradient_coefficient, gradient, direction);
}
OCTUPOLE_WIDE void CombineWide(const HistoryBlock& history, const Coefficients& coefficients,
                               double gradient_coefficient, const double* gradient, double* direction) {
  CombineBlock(history, coefficients, gradient_coefficient, gradient, direction);
}

// The pairs of the last steps and their inner products.
class History {
 public:
  History(std::size_t num_blocks, Workers* workers) : workers_(workers), blocks_(num_blocks) {}

  void Clear() { size_ = 0; }
  bool IsEmpty() const { return size_ == 0; }
  double squared_gradient() const { return products_.squared_gradient; }
  double max_gradient() const { return products_.max_gradient; }

  // Takes the pair in, unless the curvature along the step is not positive.
  void Update(const Points& points) {
    const int slot = (newest_ + 1) % kMemory;
    partial_products_.assign((blocks_.size() + kBlocksPerRange - 1) / kBlocksPerRange, Products());
    workers_->ForEachRange(blocks_.size(), kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
      const auto update = internal::HasWideLanes() ? UpdateWide : UpdateNarrow;
      for (std::size_t block = begin; block < end; ++block) {
        const std::size_t i = block * kBlock;
        update(&blocks_[block], slot, {points.x + i, points.last_x + i, points.gradient + i, points.last_gradient + i},
               &partial_products_[begin / kBlocksPerRange]);
      }
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

  // The quasi-Newton direction, and its product with the gradient.
  double Direction(const std::vector<double>& gradient, double first_step, std::vector<double>* direction) const {
    Coefficients coefficients = {};
    double gradient_coefficient = 1;
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
    workers_->ForEachRange(blocks_.size(), kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
      const auto combine = internal::HasWideLanes() ? CombineWide : CombineNarrow;
      for (std::size_t block = begin; block < end; ++block) {
        combine(blocks_[block], coefficients, -gradient_coefficient, gradient.data() + block * kBlock,
                direction->data() + block * kBlock);
      }
    });
    return slope - gradient_coefficient * products_.squared_gradient;
  }

 private:
  Workers* workers_;
  std::vector<HistoryBlock> blocks_;
  std::vector<Products> partial_products_;
  Products products_;
  std::array<Coefficients, kNumVectors> gram_ = {};
  int newest_ = kMemory - 1;
  int size_ = 0;
};

}  // namespace

LbfgsSummary MinimizeLbfgs(const ceres::FirstOrderFunction& function, const LbfgsOptions& options, Workers* workers,
                           std::vector<double>* x) {
  constexpr double kSufficientDecrease = 1e-4;
  constexpr int kMaxCuts = 10;
  const std::size_t size = x->size();
  const std::size_t num_blocks = (size + kBlock - 1) / kBlock;
  // Filled up with zeros to whole blocks.
  std::vector<double> point(num_blocks * kBlock, 0), last_point(point), gradient(point), last_gradient(point),
      direction(point);
  std::copy(x->begin(), x->end(), point.begin());
  History history(num_blocks, workers);

  LbfgsSummary summary;
  double cost = 0;
  const auto evaluate = [&] {
    ++summary.num_evaluations;
    return function.Evaluate(point.data(), &cost, gradient.data()) && std::isfinite(cost);
  };
  if (!evaluate()) return summary;
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
    double slope = history.Direction(gradient, options.first_step, &direction);
    if (!(slope < 0) && !history.IsEmpty()) {
      history.Clear();
      slope = history.Direction(gradient, options.first_step, &direction);
    }
    std::swap(point, last_point);
    std::swap(gradient, last_gradient);
    const double last_cost = summary.final_cost;
    double step = 1;
    bool is_lower = false;
    for (int cut = 0; cut < kMaxCuts; ++cut) {
      workers->ForEachRange(point.size(), kBlock * kBlocksPerRange, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) point[i] = last_point[i] + step * direction[i];
      });
      is_lower = evaluate() && cost <= last_cost + kSufficientDecrease * step * slope;
      if (is_lower) break;
      // The minimum of the parabola through what is known, within reason.
      const double parabola = -slope * step * step / (2 * (cost - last_cost - slope * step));
      step = std::isfinite(parabola) ? std::clamp(parabola, 0.1 * step, 0.5 * step) : 0.1 * step;
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
  std::copy_n(point.begin(), size, x->begin());
  return summary;
}

}  // namespace octupole
