#include "octupole/map_solvers/internal/untangler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "octupole/map_solvers/internal/hessian_solver.h"
#include "octupole/maps/foldover_energy.h"

namespace octupole::internal {
namespace {

constexpr double kForcing = 0.05;
constexpr int kMaxInner = 200;
constexpr double kShortestStep = 1e-6;
// Less than this part of the energy gained counts as idle, ten times in a row as the end.
constexpr double kLeastGain = 1e-3;
constexpr int kMaxIdle = 10;

void AddTo(const Vector& step, double factor, Vector* x) {
  for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] += factor * step[i];
}

double LeastOf(const Vector& values) { return *std::min_element(values.begin(), values.end()); }

}  // namespace

void Untangle(const UntangleOptions& options, MapEnergy* energy, Vector* x, int* num_iterations) {
  if (energy->num_tets() == 0) return;
  HessianSolver solver(energy);
  double least = LeastOf(energy->Determinants(*x)), epsilon = FirstEpsilon(least);
  Vector gradient, step, trial;
  int num_idle = 0;
  for (int iteration = 0; least <= kLeastDeterminant; ++iteration) {
    if (iteration == options.max_iterations) return;
    const double before = energy->EvaluateFoldovers(*x, epsilon, &gradient);
    for (double& g : gradient) g = -g;
    solver.Solve(gradient, kForcing, kMaxInner, &step);
    const double slope = std::inner_product(gradient.begin(), gradient.end(), step.begin(), 0.);
    double length = 1, after = before;
    for (; length > kShortestStep; length /= 2) {
      trial = *x;
      AddTo(step, length, &trial);
      after = energy->EvaluateFoldovers(trial, epsilon, nullptr);
      if (after <= before - 1e-4 * length * slope) break;
    }
    if (length > kShortestStep) {
      x->swap(trial);
    } else {
      after = before;
    }
    ++*num_iterations;
    least = LeastOf(energy->Determinants(*x));
    num_idle = before - after > kLeastGain * before ? 0 : num_idle + 1;
    epsilon = NextEpsilon(epsilon, least, before, after);
    if (!options.goes_on(before, after, gradient) || num_idle == kMaxIdle) return;
  }
}

}  // namespace octupole::internal
