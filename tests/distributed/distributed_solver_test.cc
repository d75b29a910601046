#include "octupole/distributed/distributed_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "ball_mesh.h"
#include "octupole/distributed/distributed_error.h"
#include "octupole/distributed/distributed_quality.h"
#include "octupole/distributed/field_output.h"
#include "octupole/frames/frame.h"
#include "octupole/io/field_reader.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/solvers/field_solver.h"
#include "ranks.h"

namespace octupole {
namespace {

MeshPart PartOf(const TetMesh& mesh) {
  const SharedFolder folder;
  if (Rank() == 0) WriteVtu(folder / "mesh.vtu", mesh, {});
  return ReadMeshPart(MPI_COMM_WORLD, folder / "mesh.vtu");
}

// So few are gathered that even small meshes have distributed levels.
template <int kDegree>
DistributedOptions<kDegree> WithLevels() {
  DistributedOptions<kDegree> options;
  options.max_gathered_vertices = 60;
  return options;
}

struct NumberedFrame {
  std::int64_t number;
  std::array<double, 9> frame;
};

// The frames of the whole mesh, on all ranks.
std::vector<Eigen::Matrix3d> WholeFrames(const MeshPart& part, const std::vector<Eigen::Matrix3d>& frames) {
  std::vector<NumberedFrame> mine(part.num_owned_points);
  for (std::size_t v = 0; v < mine.size(); ++v) {
    mine[v].number = part.numbers[v];
    std::copy_n(frames[v].data(), 9, mine[v].frame.data());
  }
  mine = OfAllRanks(mine);
  std::vector<Eigen::Matrix3d> whole(mine.size());
  for (const auto& [number, frame] : mine) whole.at(number) = Eigen::Map<const Eigen::Matrix3d>(frame.data());
  return whole;
}

void ExpectSameQuality(const FieldQuality& measured, const FieldQuality& expected) {
  EXPECT_EQ(measured.edges, expected.edges);
  EXPECT_NEAR(measured.energy3, expected.energy3, 1e-9 * expected.energy3 + 1e-12);
  EXPECT_NEAR(measured.energy4, expected.energy4, 1e-9 * expected.energy4 + 1e-12);
  EXPECT_NEAR(measured.boundary_rms_deg, expected.boundary_rms_deg, 1e-9);
  EXPECT_NEAR(measured.boundary_max_deg, expected.boundary_max_deg, 1e-9);
  EXPECT_EQ(measured.smooth_boundary_vertices, expected.smooth_boundary_vertices);
  EXPECT_EQ(measured.singular_triangles, expected.singular_triangles);
  EXPECT_EQ(measured.singular_triangles_of_type, expected.singular_triangles_of_type);
}

template <typename Degree>
class SolveDistributedTest : public testing::Test {};
using Degrees = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SolveDistributedTest, Degrees);

TYPED_TEST(SolveDistributedTest, FindsAFieldAsGoodAsOnOneMachine) {
  constexpr int kDegree = TypeParam::value;
  const TetMesh whole = MakeBallMesh(12);
  const MeshPart part = PartOf(whole);
  const auto field = SolveDistributed<kDegree>(MPI_COMM_WORLD, part, WithLevels<kDegree>());
  EXPECT_EQ(field.termination, ceres::CONVERGENCE);
  ASSERT_EQ(field.frames.size(), part.mesh.points.size());
  const FieldQuality quality = MeasureField(MPI_COMM_WORLD, part, field.frames);
  EXPECT_LT(quality.boundary_max_deg, 1e-10);
  const std::vector<Eigen::Matrix3d> frames = WholeFrames(part, field.frames);
  ExpectSameQuality(quality, MeasureField(whole, frames));
  const Field<kDegree> expected = SolveField<kDegree>(whole);
  // Local minima are some percent apart on a mesh as coarse as this.
  EXPECT_LT(quality.energy4, 1.03 * MeasureField(whole, expected.frames).energy4);
  EXPECT_EQ(field.size.unknowns, expected.size.unknowns);

  for (std::size_t v = 0; v < part.numbers.size(); ++v) {
    EXPECT_EQ((field.frames[v] - frames[part.numbers[v]]).norm(), 0);
    EXPECT_EQ(field.alignments[v].kind(), expected.alignment.alignments[part.numbers[v]].kind());
  }
}

TYPED_TEST(SolveDistributedTest, FindsTheConstantFieldOfABox) {
  constexpr int kDegree = TypeParam::value;
  const MeshPart part = PartOf(MakeBoxMesh({8, 6, 5}, {8, 6, 5}));
  const auto field = SolveDistributed<kDegree>(MPI_COMM_WORLD, part, WithLevels<kDegree>());
  for (std::size_t v = 0; v < field.frames.size(); ++v) {
    EXPECT_LT(FrameDifference<4>(field.frames[v], Eigen::Matrix3d::Identity()), 1e-4) << v;
  }
}

TEST(SolveDistributed, IsTheFastSolverWhereTheMeshIsSmall) {
  const TetMesh whole = MakeBallMesh(8);
  const MeshPart part = PartOf(whole);
  const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part);
  const Field<3> expected = SolveField<3>(whole);
  EXPECT_NEAR(MeasureField(MPI_COMM_WORLD, part, field.frames).energy4, MeasureField(whole, expected.frames).energy4,
              1e-2);
  EXPECT_NEAR(field.energy, expected.energy, 1e-2);
}

TEST(SolveDistributed, FollowsInterfacesAndMarkedFeaturesThatFewRanksSee) {
  // Two regions that meet in a plane; and one marked edge at the far end, so that no edge counts by its angle.
  TetMesh whole = MakeBoxMesh({12, 3, 3}, {12, 3, 3});
  for (const auto& tet : whole.tets) {
    double x = 0;
    for (const int v : tet) x += whole.points[v].x() / 4;
    whole.regions.push_back(x < 7 ? 1 : 2);
  }
  const SharedFolder folder;
  const auto expect_kinds = [&](const MeshPart& part) {
    const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part, WithLevels<3>());
    const auto expected = AlignToBoundary(whole).alignments;
    for (std::size_t v = 0; v < part.numbers.size(); ++v) {
      EXPECT_EQ(field.alignments[v].kind(), expected[part.numbers[v]].kind()) << whole.points[part.numbers[v]];
    }
  };
  expect_kinds(PartOf(whole));
  const auto corner = static_cast<int>(whole.points.size()) - 1;
  whole.feature_edges = {{corner - 1, corner}};
  MeshPart part = PartOf(whole);
  for (std::size_t v = 0; v < part.numbers.size(); ++v) {
    for (std::size_t w = 0; w < part.numbers.size(); ++w) {
      if (part.numbers[v] == corner - 1 && part.numbers[w] == corner) {
        part.mesh.feature_edges = {{static_cast<int>(v), static_cast<int>(w)}};
      }
    }
  }
  expect_kinds(part);
}

TEST(SolveDistributed, TakesMeshesThatFallApartOrAreSmallerThanTheRanks) {
  TetMesh two = MakeBoxMesh({4, 4, 4}, {1, 1, 1});
  const TetMesh one = two;
  for (const auto& p : one.points) two.points.push_back(p + Eigen::Vector3d(5, 0, 0));
  for (auto tet : one.tets) {
    for (int& v : tet) v += static_cast<int>(one.points.size());
    two.tets.push_back(tet);
  }
  const TetMesh tet = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
  for (const TetMesh& mesh : {two, tet}) {
    const MeshPart part = PartOf(mesh);
    for (const std::size_t max_gathered_vertices : {20000, 1}) {
      DistributedOptions<3> options;
      options.max_gathered_vertices = max_gathered_vertices;
      const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part, options);
      EXPECT_TRUE(field.IsUsable());
      EXPECT_LT(MeasureField(MPI_COMM_WORLD, part, field.frames).boundary_max_deg, 1e-10);
    }
  }
}

class StopsOnOneRank final : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const bool is_last = Rank() == NumRanks() - 1;
    return is_last && summary.iteration > 150 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
};

TEST(SolveDistributed, EndsOnAllRanksWhatOneEnds) {
  const MeshPart part = PartOf(MakeBallMesh(12));
  StopsOnOneRank callback;
  auto options = WithLevels<3>();
  options.minimizer.callback = &callback;
  const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part, options);
  EXPECT_EQ(field.termination, ceres::USER_SUCCESS);
  EXPECT_LT(MeasureField(MPI_COMM_WORLD, part, field.frames).boundary_max_deg, 1e-10);
  const std::vector<std::size_t> counts = OfAllRanks(std::vector<std::size_t>{field.iterations.size()});
  EXPECT_EQ(*std::min_element(counts.begin(), counts.end()), *std::max_element(counts.begin(), counts.end()));
}

TEST(SolveDistributed, SpendsNoMoreIterationsThanItMay) {
  const MeshPart part = PartOf(MakeBallMesh(8));
  auto options = WithLevels<3>();
  options.minimizer.max_iterations = 0;
  const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part, options);
  EXPECT_EQ(field.termination, ceres::NO_CONVERGENCE);
  EXPECT_TRUE(field.iterations.empty());
  EXPECT_EQ(field.frames.size(), part.mesh.points.size());
}

TEST(SolveDistributed, GoesOnFromWhatWasKept) {
  const TetMesh whole = MakeBallMesh(10);
  const MeshPart part = PartOf(whole);
  std::vector<DistributedState<3>> kept;
  auto options = WithLevels<3>();
  options.is_keep_due = [] { return true; };
  options.keep = [&](const DistributedState<3>& state) { kept.push_back(state); };
  const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part, options);
  const double energy = MeasureField(MPI_COMM_WORLD, part, field.frames).energy4;
  ASSERT_FALSE(kept.empty());
  EXPECT_GT(kept.front().level, 0);
  const bool is_empty = part.num_owned_points == 0;
  EXPECT_EQ(kept.back().frames.empty(), is_empty);
  for (const DistributedState<3>* state : {&kept.front(), &kept[kept.size() / 2], &kept.back()}) {
    auto again = WithLevels<3>();
    again.start = state;
    const auto restarted = SolveDistributed<3>(MPI_COMM_WORLD, part, again);
    EXPECT_LT(MeasureField(MPI_COMM_WORLD, part, restarted.frames).energy4, 1.03 * energy);
  }
  DistributedState<3> wrong = kept.back();
  if (Rank() == NumRanks() - 1) wrong.coefficients.emplace_back();
  auto again = WithLevels<3>();
  again.start = &wrong;
  EXPECT_THROW(SolveDistributed<3>(MPI_COMM_WORLD, part, again), DistributedError);
}

TEST(SolveDistributed, RefusesBadOptionsOnAllRanks) {
  const MeshPart part = PartOf(MakeBallMesh(4));
  auto options = WithLevels<3>();
  options.feature_angle_deg = 200;
  EXPECT_THROW(SolveDistributed<3>(MPI_COMM_WORLD, part, options), DistributedError);
  options = WithLevels<3>();
  options.weights.scale = -1;
  EXPECT_THROW(SolveDistributed<3>(MPI_COMM_WORLD, part, options), DistributedError);
}

TEST(DoTogether, ThrowsOnAllRanksWhatOneThrows) {
  DoTogether(MPI_COMM_WORLD, [] {});
  const int last = NumRanks() - 1;
  try {
    DoTogether(MPI_COMM_WORLD, [&] {
      if (Rank() == last) throw std::runtime_error("what happened");
    });
    ADD_FAILURE();
  } catch (const DistributedError& error) {
    EXPECT_EQ(std::string(error.what()), (last > 0 ? "rank " + std::to_string(last) + ": " : "") + "what happened");
  }
}

TEST(FieldOutput, HasEveryTetrahedronOnce) {
  const SharedFolder folder;
  const TetMesh whole = MakeBallMesh(6);
  const MeshPart part = PartOf(whole);
  const auto field = SolveDistributed<3>(MPI_COMM_WORLD, part);
  WritePvtu<3>(MPI_COMM_WORLD, folder / "field.pvtu", part, field);
  const FieldFile piece = ReadField(folder / ("field_" + std::to_string(Rank()) + ".vtu"));
  EXPECT_EQ(piece.tet_mesh.tets.size(), part.num_owned_tets);
  const std::vector<std::size_t> counts = OfAllRanks(std::vector<std::size_t>{piece.tet_mesh.tets.size()});
  std::size_t sum = 0;
  for (const std::size_t count : counts) sum += count;
  EXPECT_EQ(sum, whole.tets.size());
  for (std::size_t t = 0; t < part.num_owned_tets; ++t) {
    for (int k = 0; k < 4; ++k) {
      const int v = piece.tet_mesh.tets[t][k], w = part.mesh.tets[t][k];
      EXPECT_EQ((piece.tet_mesh.points[v] - part.mesh.points[w]).norm(), 0);
      EXPECT_LT((piece.frames[v] - field.frames[w]).norm(), 1e-12);
    }
  }
  const std::string index = ReadText(folder / "field.pvtu");
  for (int rank = 0; rank < NumRanks(); ++rank) {
    EXPECT_NE(index.find("Source=\"field_" + std::to_string(rank) + ".vtu\""), std::string::npos);
  }
  EXPECT_THROW(WritePvtu<3>(MPI_COMM_WORLD, folder / "missing/field.pvtu", part, field), DistributedError);
}

TEST(FieldOutput, ComesBackFromHdf5) {
  const SharedFolder folder;
  const MeshPart part = PartOf(MakeBallMesh(6)), other = PartOf(MakeBallMesh(4));
  const auto field = SolveDistributed<4>(MPI_COMM_WORLD, part);
  const auto num_owned = static_cast<std::ptrdiff_t>(part.num_owned_points);
  DistributedState<4> state = {3, {field.coefficients.begin(), field.coefficients.begin() + num_owned}, {}};
  for (const bool with_frames : {false, true}) {
    if (with_frames) state.frames = {field.frames.begin(), field.frames.begin() + num_owned};
    WriteFieldHdf5<4>(MPI_COMM_WORLD, folder / "state.h5", part, state);
    const DistributedState<4> read = ReadFieldHdf5<4>(MPI_COMM_WORLD, folder / "state.h5", part);
    EXPECT_EQ(read.level, 3);
    EXPECT_EQ(read.coefficients, state.coefficients);
    EXPECT_EQ(read.frames, state.frames);
  }
  EXPECT_THROW(ReadFieldHdf5<3>(MPI_COMM_WORLD, folder / "state.h5", part), DistributedError);
  EXPECT_THROW(ReadFieldHdf5<4>(MPI_COMM_WORLD, folder / "state.h5", other), DistributedError);
  EXPECT_THROW(ReadFieldHdf5<4>(MPI_COMM_WORLD, folder / "missing.h5", part), DistributedError);
  EXPECT_THROW(WriteFieldHdf5<4>(MPI_COMM_WORLD, folder / "missing/state.h5", part, state), DistributedError);
}

}  // namespace
}  // namespace octupole
