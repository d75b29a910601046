#include "octupole/distributed/distributed_solver.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/alignment/aligned_frame.h"
#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/internal/graph_level.h"
#include "octupole/distributed/internal/halo.h"
#include "octupole/distributed/internal/part_alignment.h"
#include "octupole/distributed/internal/petsc.h"
#include "octupole/distributed/internal/tao_minimizer.h"
#include "octupole/energies/field_energy.h"
#include "octupole/energies/frame_energy.h"
#include "octupole/harmonics/rotation.h"
#include "octupole/solvers/fast_solver.h"

namespace octupole {
namespace {

using internal::CoarseLevel;
using internal::ContiguousType;
using internal::GraphLevel;
using internal::Halo;
using internal::TaoMinimizer;
using Frames = std::vector<Eigen::Matrix3d>;

// As of SolveFast.
constexpr double kFieldTolerance = 1e-4;
constexpr double kFrameTolerance = 2e-5;
constexpr double kZeroEnergy = 1e-10;
// What is gathered, up to 20,000 vertices, makes a graph of this size or smaller at the next step; after one more, of
// some 300, starts say little of a graph whose clusters were formed by parts.
constexpr std::size_t kMaxGatheredStartVertices = 3000;

// An evaluation: the values of ghosts travel while the vertices that touch none are swept.
template <typename Energy>
TaoMinimizer::Function EvaluationOf(const Energy& energy, const GraphLevel& level, MPI_Datatype row) {
  return [&energy, &level, row](const double* parameters, double* gradient) {
    energy.Expand(parameters);
    // Without vertices there is but the row of zeros.
    double* owned = energy.Row(0);
    double* ghosts = energy.Row(level.num_owned);
    level.halo->Begin(row, owned, ghosts);
    const double inside = energy.Sweep(0, level.num_interior, parameters, gradient);
    level.halo->End(row, owned, ghosts);
    return inside + energy.Sweep(level.num_interior, level.num_owned, parameters, gradient);
  };
}

double ZeroCost(const GraphLevel& level) {
  return kZeroEnergy * level.mean_weight * static_cast<double>(level.num_vertices);
}

// The solve of one mesh. Fields have one value per vertex of a level, ghosts too, whose values are not up to date.
template <int kDegree>
class DistributedSolve {
 public:
  DistributedSolve(MPI_Comm comm, const DistributedOptions<kDegree>& options, const FieldGraph& graph,
                   const MeshPart& part)
      : comm_(comm), options_(options), minimizer_(comm, options.minimizer) {
    finest_ = internal::MakeLevel(comm, graph, part.num_owned_points, part.ghosts, &place_of_);
    numbers_.resize(part.num_owned_points);
    for (std::size_t v = 0; v < numbers_.size(); ++v) numbers_[place_of_[v]] = part.numbers[v];
    weights_ = {options.weights};
    while (LevelAt(coarse_.size()).num_vertices > static_cast<std::int64_t>(options.max_gathered_vertices)) {
      const GraphLevel& fine = LevelAt(coarse_.size());
      CoarseLevel coarse = internal::CoarsenLevel(fine);
      // Isolated vertices cannot be clustered, nor can many small components.
      if (coarse.level.num_vertices > fine.num_vertices / 2) break;
      const double growth = coarse.level.mean_weight / finest_.mean_weight;
      weights_.push_back({growth * options.weights.scale, growth * options.weights.deviation});
      coarse_.push_back(std::move(coarse));
    }
    if (options.keep) minimizer_.SetKeeping(options.is_keep_due);
  }

  // Fills in all but the alignments.
  void Run(DistributedField<kDegree>* result) {
    std::vector<Harmonic<kDegree>> field;
    Frames frames;
    const DistributedState<kDegree>* start = options_.start;
    if (start == nullptr) {
      result->energy = SolveGathered(&field, &frames);
      if (minimizer_.termination() == ceres::FAILURE) {
        result->termination = ceres::FAILURE;
        return;
      }
      if (level_ > 0) field = Prolong(level_--, field);
    } else {
      CheckStart(*start);
      level_ = std::clamp<std::size_t>(start->level, 0, coarse_.size());
      field = Restrict(Placed(start->coefficients));
      frames = Placed(start->frames);
    }
    const bool is_whole_gathered = start == nullptr && coarse_.empty();
    const bool polish_only = is_whole_gathered || HasFrames(start);
    if (!polish_only) {
      while (true) {
        result->energy = MinimizeField(&field);
        if (level_ == 0) break;
        field = Prolong(level_--, field);
      }
      if (minimizer_.termination() == ceres::FAILURE) {
        result->termination = ceres::FAILURE;
        return;
      }
      frames = Project(field);
    }
    const ceres::TerminationType termination = minimizer_.termination();
    if (!is_whole_gathered) Polish(field, &frames);
    result->termination = termination == ceres::CONVERGENCE ? minimizer_.termination() : termination;
    result->iterations = minimizer_.iterations();
    result->num_evaluations = minimizer_.num_evaluations();
    result->traffic = {finest_.halo->num_messages(), finest_.halo->num_sent(),
                       finest_.halo->num_sent() * FieldEnergy<kDegree>::kRowSize * sizeof(double)};
    result->coefficients = Unplaced(field);
    result->frames = Unplaced(frames);
    CountUnknowns(result);
  }

 private:
  const GraphLevel& LevelAt(std::size_t level) const { return level == 0 ? finest_ : coarse_[level - 1].level; }

  // From and to the order of the part's owned points.
  template <typename Value>
  std::vector<Value> Placed(const std::vector<Value>& values) const {
    std::vector<Value> placed(finest_.graph.num_vertices());
    for (std::size_t v = 0; v < values.size(); ++v) placed[place_of_[v]] = values[v];
    return placed;
  }
  template <typename Value>
  std::vector<Value> Unplaced(const std::vector<Value>& placed) const {
    std::vector<Value> values;
    values.reserve(place_of_.size());
    for (const int place : place_of_) values.push_back(placed[place]);
    return values;
  }

  void CheckStart(const DistributedState<kDegree>& start) const {
    DoTogether(comm_, [&] {
      const std::size_t num_owned = finest_.num_owned;
      if (start.coefficients.size() == num_owned && (start.frames.empty() || start.frames.size() == num_owned)) return;
      throw std::invalid_argument("SolveDistributed: a start of " + std::to_string(start.coefficients.size()) +
                                  " coefficients and " + std::to_string(start.frames.size()) + " frames for " +
                                  std::to_string(num_owned) + " owned points");
    });
  }

  // On all ranks, those without vertices, too.
  bool HasFrames(const DistributedState<kDegree>* start) const {
    int has_frames = start != nullptr && !start->frames.empty();
    MPI_Allreduce(MPI_IN_PLACE, &has_frames, 1, MPI_INT, MPI_MAX, comm_);
    return has_frames != 0;
  }

  // The coarsest graph's field and frames, on that level, and the energy.
  double SolveGathered(std::vector<Harmonic<kDegree>>* field, Frames* frames) {
    level_ = coarse_.size();
    const GraphLevel& level = LevelAt(level_);
    // The whole mesh in its own order, so that what comes out is the same on any number of ranks.
    std::vector<std::int64_t> keys = numbers_;
    if (level_ > 0) {
      keys.resize(level.num_owned);
      std::iota(keys.begin(), keys.end(), level.first_number);
    }
    const internal::GatheredGraph whole = internal::GatherGraph(level, keys);
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    FieldSolution<kDegree> solution;
    DoTogether(comm_, [&] {
      if (rank != 0) return;
      solution = SolveFast<kDegree>(whole.graph, weights_[level_], options_.minimizer, kMaxGatheredStartVertices);
    });
    minimizer_.Continue(solution.iterations, solution.termination);
    MPI_Bcast(&solution.energy, 1, MPI_DOUBLE, 0, comm_);
    if (minimizer_.termination() == ceres::FAILURE) return solution.energy;
    Scatter(level, whole, solution.coefficients, field);
    Scatter(level, whole, solution.frames, frames);
    return solution.energy;
  }

  // A matrix for each vertex.
  template <typename Matrix>
  static void Scatter(const GraphLevel& level, const internal::GatheredGraph& whole, const std::vector<Matrix>& values,
                      std::vector<Matrix>* mine) {
    constexpr std::size_t kSize = Matrix::SizeAtCompileTime;
    std::vector<double> numbers;
    for (const Matrix& value : values) numbers.insert(numbers.end(), value.data(), value.data() + kSize);
    numbers = internal::ScatterValues(level, whole, numbers, kSize);
    mine->assign(level.graph.num_vertices(), Matrix::Zero());
    for (std::size_t v = 0; v < level.num_owned; ++v) {
      (*mine)[v] = Eigen::Map<const Matrix>(numbers.data() + kSize * v);
    }
  }

  // From level `level` to the next finer.
  std::vector<Harmonic<kDegree>> Prolong(std::size_t level, const std::vector<Harmonic<kDegree>>& field) const {
    const GraphLevel& fine = LevelAt(level - 1);
    std::vector<Harmonic<kDegree>> result(fine.graph.num_vertices(), Harmonic<kDegree>::Zero());
    const std::vector<int>& cluster_of = coarse_[level - 1].cluster_of;
    for (std::size_t v = 0; v < cluster_of.size(); ++v) result[v] = field[cluster_of[v]];
    return result;
  }

  // From the finest level to level_: each cluster gets the value of one of its vertices, since a mean would make
  // nothing of two that are opposite but stand for the same frame.
  std::vector<Harmonic<kDegree>> Restrict(std::vector<Harmonic<kDegree>> field) const {
    for (std::size_t level = 1; level <= level_; ++level) {
      std::vector<Harmonic<kDegree>> coarse(LevelAt(level).graph.num_vertices(), Harmonic<kDegree>::Zero());
      const std::vector<int>& cluster_of = coarse_[level - 1].cluster_of;
      for (std::size_t v = 0; v < cluster_of.size(); ++v) coarse[cluster_of[v]] = field[v];
      field = std::move(coarse);
    }
    return field;
  }

  double MinimizeField(std::vector<Harmonic<kDegree>>* field) {
    const GraphLevel& level = LevelAt(level_);
    std::optional<FieldEnergy<kDegree>> energy;
    std::vector<double> parameters;
    DoTogether(comm_, [&] {
      energy.emplace(level.graph, weights_[level_], minimizer_.workers(), level.num_owned);
      parameters = energy->ParametersOf(*field);
    });
    const auto keep = [&](const std::vector<double>& x) {
      std::vector<Harmonic<kDegree>> reached = energy->FieldOf(x);
      for (std::size_t l = level_; l > 0; --l) reached = Prolong(l, reached);
      options_.keep({static_cast<int>(level_), Unplaced(reached), {}});
    };
    const ContiguousType row(FieldEnergy<kDegree>::kRowSize, MPI_DOUBLE);
    const double result = minimizer_.Minimize(level_ == 0 ? "field" : "level", level, EvaluationOf(*energy, level, row),
                                              ZeroCost(level), kFieldTolerance, &parameters, keep);
    *field = energy->FieldOf(parameters);
    return result;
  }

  Frames Project(const std::vector<Harmonic<kDegree>>& field) {
    constexpr std::size_t kGrain = 1024;
    Frames frames(finest_.graph.num_vertices(), Eigen::Matrix3d::Identity());
    minimizer_.workers()->ForEachRange(finest_.num_owned, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        frames[v] = NearestAlignedFrame<kDegree>(finest_.graph.alignments[v], field[v]);
      }
    });
    return frames;
  }

  void Polish(const std::vector<Harmonic<kDegree>>& field, Frames* frames) {
    std::optional<FrameEnergy> energy;
    DoTogether(comm_, [&] {
      energy.emplace(finest_.graph, *frames, minimizer_.workers(), std::nullopt, std::vector<bool>(),
                     finest_.num_owned);
    });
    const auto keep = [&](const std::vector<double>& x) {
      options_.keep({0, Unplaced(field), Unplaced(energy->FramesOf(x))});
    };
    std::vector<double> parameters(energy->NumParameters(), 0);
    const ContiguousType row(FrameEnergy::kRowSize, MPI_DOUBLE);
    minimizer_.Minimize("frames", finest_, EvaluationOf(*energy, finest_, row), ZeroCost(finest_), kFrameTolerance,
                        &parameters, keep);
    *frames = energy->FramesOf(parameters);
  }

  void CountUnknowns(DistributedField<kDegree>* result) const {
    std::int64_t unknowns = 0;
    for (std::size_t v = 0; v < finest_.num_owned; ++v) {
      unknowns += static_cast<std::int64_t>(
          kUnknownsOfKind<kDegree>[static_cast<std::size_t>(finest_.graph.alignments[v].kind())]);
    }
    MPI_Allreduce(MPI_IN_PLACE, &unknowns, 1, MPI_INT64_T, MPI_SUM, comm_);
    result->size.unknowns = unknowns;
  }

  MPI_Comm comm_;
  const DistributedOptions<kDegree>& options_;
  TaoMinimizer minimizer_;
  GraphLevel finest_;
  /// Of each owned point of the part, in the finest level.
  std::vector<int> place_of_;
  /// Of each owned vertex of the finest level, in the whole mesh.
  std::vector<std::int64_t> numbers_;
  std::vector<CoarseLevel> coarse_;
  std::vector<EnergyWeights> weights_;
  /// At work.
  std::size_t level_ = 0;
};

// The mean weight of the whole mesh's edges; 1 where there are none but zero.
double MeanEdgeWeightOfParts(MPI_Comm comm, const FieldGraph& graph, std::size_t num_owned) {
  const auto end = static_cast<int>(num_owned);
  std::array<double, 2> sums = {};
  for (const WeightedEdge& edge : graph.edges) {
    const double share = 0.5 * ((edge.a < end) + (edge.b < end));
    sums[0] += share * edge.weight;
    sums[1] += share;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
  return sums[0] > 0 ? sums[0] / sums[1] : 1;
}

struct AlignmentOfOwner {
  AlignmentKind kind;
  Eigen::Matrix3d frame;
};

}  // namespace

template <int kDegree>
DistributedField<kDegree> SolveDistributed(MPI_Comm comm, const MeshPart& part,
                                           const DistributedOptions<kDegree>& options) {
  DistributedField<kDegree> field;
  field.alignments = internal::AlignPart(comm, part, options.feature_angle_deg, options.regions).alignments;
  field.alignments.resize(part.mesh.points.size());
  DistributedOptions<kDegree> scaled = options;
  {
    FieldGraph graph;
    DoTogether(comm, [&] { graph = MakeFieldGraph(part.mesh, field.alignments, options.edge_weights); });
    const double mean_weight = MeanEdgeWeightOfParts(comm, graph, part.num_owned_points);
    scaled.weights = {mean_weight * options.weights.scale, mean_weight * options.weights.deviation};
    DistributedSolve<kDegree> solve(comm, scaled, graph, part);
    graph = FieldGraph();
    solve.Run(&field);
  }
  if (field.termination == ceres::FAILURE) return field;

  const Halo halo(comm, part.num_owned_points, part.ghosts);
  field.coefficients.resize(part.mesh.points.size());
  field.frames.resize(part.mesh.points.size());
  halo.Update(&field.coefficients);
  halo.Update(&field.frames);
  std::vector<AlignmentOfOwner> owners;
  for (const Alignment& alignment : field.alignments) owners.push_back({alignment.kind(), alignment.frame()});
  halo.Update(&owners);
  for (std::size_t v = part.num_owned_points; v < owners.size(); ++v) {
    const auto& [kind, frame] = owners[v];
    field.alignments[v] = kind == AlignmentKind::kFree   ? Alignment()
                          : kind == AlignmentKind::kAxis ? Alignment::Axis(frame.col(2))
                                                         : Alignment::Frame(frame);
  }
  return field;
}

template <int kDegree>
DistributedField<kDegree> SolveDistributed(DM dm, const DistributedOptions<kDegree>& options) {
  std::vector<int> plex_points;
  const MeshPart part = MeshPartOfPlex(dm, &plex_points);
  DistributedField<kDegree> field =
      SolveDistributed<kDegree>(PetscObjectComm(reinterpret_cast<PetscObject>(dm)), part, options);
  if (field.termination == ceres::FAILURE) return field;
  DistributedField<kDegree> result = field;
  result.coefficients.clear();
  result.frames.clear();
  result.alignments.clear();
  for (const int v : plex_points) {
    result.coefficients.push_back(field.coefficients[v]);
    result.frames.push_back(field.frames[v]);
    result.alignments.push_back(field.alignments[v]);
  }
  return result;
}

template DistributedField<3> SolveDistributed<3>(MPI_Comm, const MeshPart&, const DistributedOptions<3>&);
template DistributedField<4> SolveDistributed<4>(MPI_Comm, const MeshPart&, const DistributedOptions<4>&);
template DistributedField<3> SolveDistributed<3>(DM, const DistributedOptions<3>&);
template DistributedField<4> SolveDistributed<4>(DM, const DistributedOptions<4>&);

}  // namespace octupole
