#include "octupole/map_solvers/seamless_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/frames/octahedral_group.h"
#include "octupole/map_solvers/internal/map_energy.h"
#include "octupole/map_solvers/internal/map_system.h"
#include "octupole/map_solvers/internal/map_transfer.h"
#include "octupole/map_solvers/internal/untangler.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/minimization/internal/seconds_since.h"
#include "octupole/minimization/workers.h"

namespace octupole {
namespace {

using internal::MakeMapSystem;
using internal::MapEnergy;
using internal::MapSystem;
using internal::SecondsSince;
using internal::SolveByConjugateGradients;
using internal::Vector;
using Clock = std::chrono::steady_clock;

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

// The tetrahedron of the start that a tetrahedron of the domain is, or that is a part of the same one of the mesh: as
// splitting leaves what is left first, that of its number.
int CounterpartOf(const MapDomain& domain, const TetMesh& start, int t) {
  const bool is_same = t < static_cast<int>(start.tets.size()) && start.tets[t] == domain.mesh.tets[t];
  return is_same ? t : domain.parents[t];
}

// Times H the gradients of the start, its axes named as those of the domain's frames. Scaled to fit the frames best,
// which changes nothing for a fit of them, but makes up for another H.
std::vector<Eigen::Matrix3d> StartJacobians(const TetMesh& mesh, const MapDomain& domain, const MeshMap& start) {
  const std::size_t num_points = mesh.points.size();
  const bool is_of_mesh = start.mesh.points.size() >= num_points && start.mesh.tets.size() >= mesh.tets.size() &&
                          start.parameters.size() == start.mesh.tets.size() &&
                          std::equal(mesh.points.begin(), mesh.points.end(), start.mesh.points.begin());
  if (!is_of_mesh) {
    throw std::invalid_argument("SolveSeamlessMap: the start is a map of another mesh, of " +
                                std::to_string(start.mesh.points.size()) + " points and " +
                                std::to_string(start.mesh.tets.size()) + " tetrahedra");
  }
  std::vector<Eigen::Matrix3d> jacobians(domain.mesh.tets.size(), Eigen::Matrix3d::Zero());
  double fit = 0, square = 0;
  for (int t = 0; t < static_cast<int>(jacobians.size()); ++t) {
    const int s = CounterpartOf(domain, start.mesh, t);
    Eigen::Matrix3d edges, images;
    for (int i = 0; i < 3; ++i) {
      edges.col(i) = start.mesh.points[start.mesh.tets[s][i + 1]] - start.mesh.points[start.mesh.tets[s][0]];
      images.col(i) = start.parameters[s][i + 1] - start.parameters[s][0];
    }
    const double volume = std::abs(edges.determinant());
    const Eigen::Matrix3d gradients = images * edges.inverse(), frame = domain.combed.frames[t].transpose();
    if (!gradients.allFinite()) continue;  // of a flat tetrahedron
    double best = -1;
    for (const OctahedralRotation& g : OctahedralGroup()) {
      const Eigen::Matrix3d named = g.matrix() * gradients;
      // As they are, unless others are far more like: a map that is far from the frames names none of them anew.
      const double likeness = named.cwiseProduct(frame).sum() * (g == OctahedralRotation() ? 2 : 1);
      if (likeness <= best) continue;
      best = likeness;
      jacobians[t] = named;
    }
    fit += volume * jacobians[t].cwiseProduct(frame).sum();
    square += volume * jacobians[t].squaredNorm();
  }
  const double scale = square > 0 ? fit / square : 0;
  for (Eigen::Matrix3d& jacobian : jacobians) jacobian *= scale;
  return jacobians;
}

constexpr double kFitTolerance = 1e-5;

// A map on its way.
class MapSolver {
 public:
  MapSolver(const MapOptions& options, const MapDomain& domain, double size, int num_iterations,
            Clock::time_point start)
      : options_(options),
        domain_(domain),
        size_(size),
        start_(start),
        num_iterations_(num_iterations),
        workers_(options.num_threads),
        y_(domain.unknowns.num_unknowns, 0),
        is_held_(domain.unknowns.num_unknowns, false),
        whole_(MakeMapSystem(domain, y_, std::vector<bool>(domain.unknowns.num_unknowns, true))),
        whole_energy_(domain, whole_, size, &workers_) {}

  const Vector& y() const { return y_; }
  int num_iterations() const { return num_iterations_; }
  int num_held() const { return static_cast<int>(std::count(is_held_.begin(), is_held_.end(), true)); }

  // What fits draw the Jacobians to, instead of the frames.
  void SetTargets(std::vector<Eigen::Matrix3d> jacobians) {
    targets_ = std::move(jacobians);
    whole_energy_.SetTargets(targets_);
  }

  void Begin(Vector y) { y_ = std::move(y); }

  // All that is free.
  void Fit(double tolerance) {
    if (std::find(is_held_.begin(), is_held_.end(), true) == is_held_.end()) {
      FitFrames(tolerance, &whole_energy_, &y_);
      return;
    }
    FitPart(IsFree(), tolerance);
  }

  // Only what is around the tetrahedra.
  void FitAround(const std::vector<int>& tets, double tolerance) {
    constexpr int kNumRings = 12;
    FitPart(IsFreeAround(tets, kNumRings), tolerance);
  }

  // Those that are turned over or flat, in ascending order.
  std::vector<int> FindFlipped() {
    std::vector<int> flipped = FindOpen();
    flipped.insert(flipped.end(), domain_.collapsed.begin(), domain_.collapsed.end());
    std::sort(flipped.begin(), flipped.end());
    return flipped;
  }

  // The same without those that are flat in every map.
  std::vector<int> FindOpen() {
    std::vector<int> open;
    const std::vector<double>& determinants = whole_energy_.Determinants(y_);
    for (std::size_t i = 0; i < determinants.size(); ++i) {
      if (determinants[i] <= internal::kLeastDeterminant) open.push_back(whole_.tets[i]);
    }
    return open;
  }

  // Six times that of tetrahedra.
  double VolumeOf(const std::vector<int>& tets) const {
    const std::vector<double> volumes = SixfoldVolumes(domain_.mesh);
    double sum = 0;
    for (const int t : tets) sum += std::abs(volumes[t]);
    return sum;
  }

  // In neighbourhoods of what is turned over, larger and larger; then, if it is to be and not too much, everywhere and
  // from the beginning. The best of these remains.
  ceres::TerminationType Unfold(bool everywhere) {
    if (ended_) return *ended_;
    constexpr int kEverywhere = -1;
    constexpr std::size_t kMaxEverywhere = 50000;
    const int last_iteration = num_iterations_ + options_.max_iterations;
    const Vector start = y_;
    Vector best = y_;
    std::size_t least = FindOpen().size();
    for (const int num_rings : {3, 6, 12, kEverywhere}) {
      const std::vector<int> open = FindOpen();
      if (open.empty()) return ceres::CONVERGENCE;
      if (num_rings == kEverywhere) {
        if (!everywhere || y_.size() > kMaxEverywhere) break;
        y_ = start;
      }
      const MapSystem system =
          MakeMapSystem(domain_, y_, num_rings == kEverywhere ? IsFree() : IsFreeAround(open, num_rings));
      MapEnergy energy(domain_, system, size_, &workers_);
      Vector x = system.Part(y_);
      const int max_iterations = num_rings == kEverywhere ? 60 : 25;
      internal::Untangle({std::min(max_iterations, last_iteration - num_iterations_),
                          [&](double before, double after, const Vector& gradient) {
                            return Report(num_iterations_, before, after, gradient);
                          }},
                         &energy, &x, &num_iterations_);
      system.PutPart(x, &y_);
      if (const std::size_t now = FindOpen().size(); now <= least) {
        least = now;
        best = y_;
      }
      if (ended_) return *ended_;
    }
    y_ = best;
    return FindOpen().empty() ? ceres::CONVERGENCE : ceres::NO_CONVERGENCE;
  }

  // Also from the fit around what is still turned over then; of the two, that remains of which it is less volume.
  ceres::TerminationType UnfoldTwice() {
    const ceres::TerminationType termination = Unfold(false);
    if (termination != ceres::NO_CONVERGENCE) return termination;
    const Vector first = y_;
    const std::vector<int> open = FindOpen();
    FitAround(open, kFitTolerance);
    const ceres::TerminationType second = Unfold(false);
    if (VolumeOf(FindOpen()) >= VolumeOf(open)) y_ = first;
    return second;
  }

  // Those that must be whole and are, but for rounding.
  void HoldWhole() {
    constexpr double kWhole = 1e-6;
    for (std::size_t j = 0; j < y_.size(); ++j) {
      const double whole = std::round(y_[j]);
      if (!domain_.unknowns.is_integer[j] || std::abs(y_[j] - whole) > kWhole) continue;
      y_[j] = whole;
      is_held_[j] = true;
    }
  }

  // Rounds the unknowns that must be whole and are not held yet, the surest first, a twelfth of those open at a time
  // and all that are nearly whole; fits and unfolds the rest after each batch. A batch that leaves more turned over
  // than before is undone and halved; a single unknown goes to its other side. What fails on both stays on the better
  // one.
  ceres::TerminationType Round() {
    std::vector<int> open;
    for (std::size_t j = 0; j < y_.size(); ++j) {
      if (domain_.unknowns.is_integer[j] && !is_held_[j]) open.push_back(static_cast<int>(j));
    }
    std::size_t num_flipped = FindFlipped().size(), limit = open.size();
    while (!open.empty() && !ended_) {
      constexpr double kNearlyWhole = 0.02;
      const auto distance = [&](int j) { return std::abs(y_[j] - std::round(y_[j])); };
      std::sort(open.begin(), open.end(), [&](int a, int b) { return distance(a) < distance(b); });
      std::size_t count = (open.size() + 11) / 12;
      while (count < open.size() && distance(open[count]) < kNearlyWhole) ++count;
      count = std::min(count, limit);
      const std::vector<int> batch(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(count));
      const Vector before = y_;
      Hold(batch, [](double value) { return std::round(value); });
      std::size_t now = FindFlipped().size();
      if (now > num_flipped && count > 1) {
        Release(batch, before);
        limit = count / 2;
        continue;
      }
      if (now > num_flipped) {
        const Vector rounded = y_;
        Release(batch, before);
        Hold(batch, [](double value) { return std::round(value) > value ? std::floor(value) : std::ceil(value); });
        const std::size_t other = FindFlipped().size();
        if (other < now) {
          now = other;
        } else {
          y_ = rounded;
        }
      }
      num_flipped = now;
      limit = 2 * count;
      open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (ended_) return *ended_;
    return FindOpen().empty() ? ceres::CONVERGENCE : ceres::NO_CONVERGENCE;
  }

 private:
  std::vector<bool> IsFree() const {
    std::vector<bool> is_free = is_held_;
    is_free.flip();
    return is_free;
  }

  std::vector<bool> IsFreeAround(const std::vector<int>& tets, int num_rings) const {
    std::vector<bool> is_free = internal::FindUnknownsAround(domain_, tets, num_rings);
    for (std::size_t j = 0; j < is_free.size(); ++j) is_free[j] = is_free[j] && !is_held_[j];
    return is_free;
  }

  void FitPart(const std::vector<bool>& is_free, double tolerance) {
    const MapSystem system = MakeMapSystem(domain_, y_, is_free);
    MapEnergy energy(domain_, system, size_, &workers_);
    if (!targets_.empty()) energy.SetTargets(targets_);
    Vector x = system.Part(y_);
    FitFrames(tolerance, &energy, &x);
    system.PutPart(x, &y_);
  }

  // The least squares fit of the targets in the unknowns of the system, from x.
  void FitFrames(double tolerance, MapEnergy* energy, Vector* x) {
    if (ended_) return;
    constexpr int kMaxIterations = 5000;
    Vector gradient;
    double cost = energy->EvaluateFrames(*x, &gradient);
    for (double& g : gradient) g = -g;
    Vector step(x->size(), 0);
    int iteration = 0;
    SolveByConjugateGradients(energy, gradient, tolerance, kMaxIterations, &step,
                              [&](double gain, const Vector& residual) {
                                cost -= gain;
                                return Report(++iteration, cost + gain, cost, residual);
                              });
    for (std::size_t i = 0; i < x->size(); ++i) (*x)[i] += step[i];
  }

  template <typename Rounding>
  void Hold(const std::vector<int>& batch, const Rounding& rounding) {
    for (const int j : batch) {
      y_[j] = rounding(y_[j]);
      is_held_[j] = true;
    }
    Fit(1e-4);
    Unfold(false);
  }

  void Release(const std::vector<int>& batch, const Vector& y) {
    y_ = y;
    for (const int j : batch) is_held_[j] = false;
  }

  // Whether to go on.
  bool Report(int iteration, double before, double after, const Vector& gradient) {
    if (options_.callback == nullptr) return true;
    ceres::IterationSummary summary;
    summary.iteration = iteration;
    summary.cost = after;
    summary.cost_change = before - after;
    for (const double g : gradient) summary.gradient_max_norm = std::max(summary.gradient_max_norm, std::abs(g));
    summary.cumulative_time_in_seconds = SecondsSince(start_);
    const ceres::CallbackReturnType wish = (*options_.callback)(summary);
    if (wish == ceres::SOLVER_ABORT) ended_ = ceres::USER_FAILURE;
    if (wish == ceres::SOLVER_TERMINATE_SUCCESSFULLY) ended_ = ceres::USER_SUCCESS;
    return !ended_;
  }

  const MapOptions& options_;
  const MapDomain& domain_;
  const double size_;
  const Clock::time_point start_;
  int num_iterations_;
  Workers workers_;
  Vector y_;
  std::vector<bool> is_held_;
  std::vector<Eigen::Matrix3d> targets_;
  const MapSystem whole_;
  MapEnergy whole_energy_;
  std::optional<ceres::TerminationType> ended_;  // by the callback
};

// Whether as many unknowns being whole makes all whole that has to be, on the boundary everywhere.
bool IsWhole(const MapDomain& domain, int num_whole) {
  const std::vector<bool>& is_integer = domain.unknowns.is_integer;
  const std::vector<BoundarySheets::Face>& faces = domain.sheets.faces;
  return num_whole == std::count(is_integer.begin(), is_integer.end(), true) && domain.unknowns.num_fractional == 0 &&
         std::none_of(faces.begin(), faces.end(), [](const auto& face) { return face.is_released; });
}

}  // namespace

SeamlessMap SolveSeamlessMap(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                             const MapOptions& options) {
  Check(options);
  const Clock::time_point start = Clock::now();
  SeamlessMap map;
  map.domain = MakeMapDomain(mesh, frames, options.boundary);
  map.size = options.size > 0 ? options.size : 2 * MeanEdgeLength(mesh);
  map.setup_seconds = SecondsSince(start);

  Vector begin;
  double open_volume = 0;
  bool is_rounded = false;
  for (int round = 0, first_round = 0;; ++round) {
    const Clock::time_point ready = Clock::now();
    MapSolver solver(options, map.domain, map.size, map.num_iterations, start);
    if (round == 0) {
      if (options.start) solver.SetTargets(StartJacobians(mesh, map.domain, *options.start));
      solver.Fit(kFitTolerance);
      map.flipped_before = solver.FindFlipped();
    } else {
      solver.Begin(std::move(begin));
    }
    if (is_rounded) solver.HoldWhole();
    map.linear_seconds += SecondsSince(ready);

    const Clock::time_point fitted = Clock::now();
    map.termination = round == 0 ? solver.Unfold(true) : solver.UnfoldTwice();
    // What no step has turned back may need more vertices to move; not those that have not helped.
    std::vector<int> open;
    const auto is_last = [&] {
      constexpr int kMaxRounds = 4;
      constexpr std::size_t kFew = 20;
      open = solver.FindOpen();
      const double volume = solver.VolumeOf(open);
      const bool has_helped = round == first_round || open.size() <= kFew || 2 * volume <= open_volume;
      open_volume = volume;
      return map.termination != ceres::NO_CONVERGENCE || round == first_round + kMaxRounds || !has_helped ||
             options.max_iterations == 0;
    };
    if (is_rounded) map.termination = solver.Round();  // what the finer map has new
    bool is_done = is_last();
    if (is_done && options.integer && !is_rounded) {
      map.termination = solver.Round();
      is_rounded = true;
      first_round = round;
      is_done = is_last();
    }
    map.num_iterations = solver.num_iterations();
    map.parameters = internal::ParametersAtCorners(map.domain, solver.y());
    if (is_done) {
      map.num_rounded = solver.num_held();
      map.flipped = solver.FindFlipped();
      map.is_integer_grid = is_rounded && map.flipped.empty() && IsWhole(map.domain, map.num_rounded);
      map.foldover_seconds += SecondsSince(fitted);
      return map;
    }
    MapDomain finer = RefineMapDomain(map.domain, open);
    begin = internal::TransferMap(map.domain, map.parameters, finer);
    for (int& parent : finer.parents) parent = map.domain.parents[parent];
    map.domain = std::move(finer);
    map.foldover_seconds += SecondsSince(fitted);
  }
}

}  // namespace octupole
