#include "octupole/solvers/seamless_map.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/maps/foldover_energy.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/solvers/internal/map_energy.h"

namespace octupole {
namespace {

using internal::MapEnergy;
using internal::SolveByConjugateGradients;
using internal::Vector;
using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double MeanEdgeLength(const TetMesh& mesh) {
  double sum = 0;
  const auto edges = MeshEdges(mesh);
  for (const auto& [a, b] : edges) sum += (mesh.points[a] - mesh.points[b]).norm();
  return sum / static_cast<double>(edges.size());
}

void Check(const MapOptions& options) {
  const auto fail = [](const char* what, double value) {
    std::ostringstream message;
    message << "SolveSeamlessMap: " << what << " is " << value;
    throw std::invalid_argument(message.str());
  };
  if (!(options.size >= 0 && std::isfinite(options.size))) fail("the size", options.size);
  if (options.max_iterations < 0) fail("max_iterations", options.max_iterations);
}

// A volume that is no more than this part of what it should be counts as none.
constexpr double kLeastDeterminant = 1e-6;

std::vector<int> FindFlipped(const std::vector<double>& determinants, const std::vector<int>& collapsed) {
  std::vector<int> flipped = collapsed;
  for (std::size_t t = 0; t < determinants.size(); ++t) {
    if (determinants[t] <= kLeastDeterminant) flipped.push_back(static_cast<int>(t));
  }
  std::sort(flipped.begin(), flipped.end());
  return flipped;
}

void AddTo(const Vector& step, double factor, Vector* y) {
  for (std::size_t i = 0; i < y->size(); ++i) (*y)[i] += factor * step[i];
}

double Dot(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.); }

// The least squares fit of the frames in the unknowns that are not held, from y.
void FitFrames(double tolerance, MapEnergy* energy, Vector* y) {
  constexpr int kMaxIterations = 5000;
  Vector gradient;
  energy->EvaluateFrames(*y, &gradient);
  for (double& g : gradient) g = -g;
  Vector step(y->size(), 0);
  SolveByConjugateGradients(energy, gradient, tolerance, kMaxIterations, &step);
  AddTo(step, 1, y);
}

// Newton's method on the foldover-free energy.
class Untangler {
 public:
  Untangler(const MapOptions& options, MapEnergy* energy, Clock::time_point start)
      : options_(options), energy_(energy), start_(start) {}

  int num_iterations() const { return num_iterations_; }

  ceres::TerminationType Run(Vector* y) {
    double least = energy_->LeastDeterminant(*y), epsilon = FirstEpsilon(least);
    Vector gradient, step(y->size()), trial;
    int num_idle = 0;
    while (least <= kLeastDeterminant) {
      if (num_iterations_ == options_.max_iterations) return ceres::NO_CONVERGENCE;
      const double before = energy_->EvaluateFoldovers(*y, epsilon, &gradient);
      for (double& g : gradient) g = -g;
      std::fill(step.begin(), step.end(), 0.);
      SolveByConjugateGradients(energy_, gradient, kForcing, kMaxInner, &step);
      const double slope = Dot(gradient, step);
      double length = 1, after = before;
      for (; length > kShortestStep; length /= 2) {
        trial = *y;
        AddTo(step, length, &trial);
        after = energy_->EvaluateFoldovers(trial, epsilon, nullptr);
        if (after <= before - 1e-4 * length * slope) break;
      }
      if (length > kShortestStep) {
        y->swap(trial);
      } else {
        after = before;
      }
      ++num_iterations_;
      least = energy_->LeastDeterminant(*y);
      num_idle = before - after > 1e-5 * before ? 0 : num_idle + 1;
      epsilon = NextEpsilon(epsilon, least, before, after);
      const ceres::CallbackReturnType wish = Report(before, after, gradient);
      if (wish == ceres::SOLVER_ABORT) return ceres::USER_FAILURE;
      if (wish == ceres::SOLVER_TERMINATE_SUCCESSFULLY) return ceres::USER_SUCCESS;
      if (num_idle == kMaxIdle) return ceres::NO_CONVERGENCE;
    }
    return ceres::CONVERGENCE;
  }

 private:
  static constexpr double kForcing = 0.05;
  static constexpr int kMaxInner = 200;
  static constexpr double kShortestStep = 1e-6;
  static constexpr int kMaxIdle = 10;

  ceres::CallbackReturnType Report(double before, double after, const Vector& gradient) const {
    if (options_.callback == nullptr) return ceres::SOLVER_CONTINUE;
    ceres::IterationSummary summary;
    summary.iteration = num_iterations_;
    summary.cost = after;
    summary.cost_change = before - after;
    for (const double g : gradient) summary.gradient_max_norm = std::max(summary.gradient_max_norm, std::abs(g));
    summary.cumulative_time_in_seconds = SecondsSince(start_);
    return (*options_.callback)(summary);
  }

  const MapOptions& options_;
  MapEnergy* energy_;
  const Clock::time_point start_;
  int num_iterations_ = 0;
};

CornerParameters AtCorners(const MapDomain& domain, const Vector& y) {
  const std::vector<double> u = domain.unknowns.Parameters(y);
  CornerParameters parameters(domain.mesh.tets.size());
  for (std::size_t t = 0; t < parameters.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      parameters[t][i] = Eigen::Map<const Eigen::Vector3d>(&u[3 * static_cast<std::size_t>(domain.cut.nodes[t][i])]);
    }
  }
  return parameters;
}

// Rounds the unknowns that must be whole, the surest first, and fits the rest again after each batch.
int RoundUnknowns(const std::vector<bool>& is_integer, MapEnergy* energy, Vector* y) {
  std::vector<bool> is_held(y->size(), false);
  std::vector<int> open;
  for (std::size_t j = 0; j < y->size(); ++j) {
    if (is_integer[j]) open.push_back(static_cast<int>(j));
  }
  const int num_rounded = static_cast<int>(open.size());
  const auto distance = [&](int j) { return std::abs((*y)[j] - std::round((*y)[j])); };
  while (!open.empty()) {
    // All that are nearly whole at once, and at least the surest twelfth.
    constexpr double kNearlyWhole = 0.02;
    std::sort(open.begin(), open.end(), [&](int a, int b) { return distance(a) < distance(b); });
    std::size_t count = (open.size() + 11) / 12;
    while (count < open.size() && distance(open[count]) < kNearlyWhole) ++count;
    for (std::size_t i = 0; i < count; ++i) {
      (*y)[open[i]] = std::round((*y)[open[i]]);
      is_held[open[i]] = true;
    }
    open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(count));
    energy->Hold(is_held);
    FitFrames(1e-4, energy, y);
  }
  return num_rounded;
}

}  // namespace

SeamlessMap SolveSeamlessMap(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                             const MapOptions& options) {
  Check(options);
  const Clock::time_point start = Clock::now();
  Workers workers(options.num_threads);
  SeamlessMap map;
  map.domain = MakeMapDomain(mesh, frames);
  map.size = options.size > 0 ? options.size : 2 * MeanEdgeLength(mesh);
  const MapDomain& domain = map.domain;
  std::vector<bool> is_left_out(domain.mesh.tets.size(), false);
  for (const int t : domain.collapsed) is_left_out[t] = true;
  MapEnergy energy(domain.mesh, domain.combed, domain.cut, domain.unknowns, map.size, is_left_out, &workers);
  Vector y(domain.unknowns.num_unknowns, 0);
  map.setup_seconds = SecondsSince(start);

  const Clock::time_point ready = Clock::now();
  FitFrames(1e-5, &energy, &y);
  if (options.integer) map.num_rounded = RoundUnknowns(domain.unknowns.is_integer, &energy, &y);
  map.flipped_before = FindFlipped(energy.Determinants(y), domain.collapsed);
  map.linear_seconds = SecondsSince(ready);

  const Clock::time_point fitted = Clock::now();
  Untangler untangler(options, &energy, start);
  map.termination = untangler.Run(&y);
  map.num_iterations = untangler.num_iterations();
  map.flipped = FindFlipped(energy.Determinants(y), domain.collapsed);
  map.parameters = AtCorners(domain, y);
  map.foldover_seconds = SecondsSince(fitted);
  return map;
}

}  // namespace octupole
