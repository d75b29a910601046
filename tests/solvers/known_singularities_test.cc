// Fields whose singular structure is known, from mesh to curves.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ball_mesh.h"
#include "corpus.h"
#include "cylinder_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/solvers/field_solver.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

struct Structure {
  SingularCurves curves;
  SurfaceSingularities surface;
};

template <int kDegree>
Structure Solve(const TetMesh& mesh, const FieldOptions<kDegree>& options = {}) {
  const auto frames = SolveField<kDegree>(mesh, options).frames;
  return {TraceSingularCurves(mesh, frames, FindSingularTriangles(mesh, frames)),
          FindSurfaceSingularities(mesh.points, BoundaryTriangles(mesh), frames)};
}

std::size_t CountEnds(const SingularCurves& traced, CurveEnd kind) {
  std::size_t count = 0;
  for (const SingularCurve& curve : traced.curves) count += (curve.ends[0] == kind) + (curve.ends[1] == kind);
  return count;
}

template <int kDegree>
void ExpectFourStraightCurves(const TetMesh& mesh, double height, double cell) {
  const Structure structure = Solve<kDegree>(mesh);
  EXPECT_TRUE(structure.curves.nodes.empty());
  ASSERT_EQ(structure.curves.curves.size(), 4u);
  for (const SingularCurve& curve : structure.curves.curves) {
    EXPECT_EQ(curve.type, TurnType::kQuarter);
    EXPECT_EQ(curve.valence, 3);
    EXPECT_GT(curve.mean_cosine, .9);
    EXPECT_EQ(curve.ends, (std::array<CurveEnd, 2>{CurveEnd::kBoundary, CurveEnd::kBoundary}));
    const Vector3d &first = curve.points.front(), &last = curve.points.back();
    EXPECT_NEAR(std::min(first.z(), last.z()), 0, 1e-12);
    EXPECT_NEAR(std::max(first.z(), last.z()), height, 1e-12);
    EXPECT_LT(curve.length, 1.1 * height);
    // About a cell from the line through the ends, at most, which is vertical to two cells.
    for (const Vector3d& point : curve.points) {
      EXPECT_LT((point - first).cross((last - first).normalized()).norm(), cell);
    }
    EXPECT_LT((last - first).head<2>().norm(), 2 * cell);
  }
  // Four where the curves end, on the top and on the bottom; the rims have none.
  EXPECT_EQ(std::count(structure.surface.quarter_indices.begin(), structure.surface.quarter_indices.end(), 1), 8);
  EXPECT_EQ(structure.surface.components.at(0).quarter_index_sum, 8);
}

TEST(KnownSingularities, OfACylinderAreFourStraightCurvesOfValence3) {
  ExpectFourStraightCurves<3>(MakeCylinderMesh(8, 8, 2), 2, .25);
  ExpectFourStraightCurves<4>(MakeCylinderMesh(8, 8, 2), 2, .25);
}

// Eight points on the sphere, the corners of a cube, from which curves lead to the corners of a smaller cube inside,
// whose twelve edges are curves, too.
TEST(KnownSingularities, OfABallAreACubeAndWaysToEightPoints) {
  const Structure structure = Solve<3>(MakeBallMesh(10));
  EXPECT_EQ(std::count(structure.surface.quarter_indices.begin(), structure.surface.quarter_indices.end(), 1), 8);
  EXPECT_EQ(std::count(structure.surface.quarter_indices.begin(), structure.surface.quarter_indices.end(), -1), 0);
  ASSERT_EQ(structure.surface.components.size(), 1u);
  EXPECT_EQ(structure.surface.components[0].quarter_index_sum, 8);
  EXPECT_EQ(structure.surface.components[0].euler_characteristic, 2);
  EXPECT_TRUE(structure.surface.components[0].is_normal);

  const SingularCurves& traced = structure.curves;
  EXPECT_EQ(CountEnds(traced, CurveEnd::kBoundary), 8u);
  EXPECT_EQ(CountEnds(traced, CurveEnd::kNone), 0u);
  EXPECT_EQ(CountEnds(traced, CurveEnd::kOpen), 0u);
  int num_long = 0;
  for (const SingularCurve& curve : traced.curves) {
    EXPECT_NE(curve.valence, 5);
    if (curve.length < .5) continue;
    ++num_long;
    EXPECT_EQ(curve.valence, 3);
    EXPECT_EQ(curve.ends, (std::array<CurveEnd, 2>{CurveEnd::kNode, CurveEnd::kNode}));
  }
  EXPECT_EQ(num_long, 12);
}

// Points at the corners of the surface only, where the faces' fields meet.
TEST(KnownSingularities, OfABoxAreNone) {
  const Structure structure = Solve<3>(MakeBoxMesh({6, 5, 4}, {1, 1, 2}));
  EXPECT_TRUE(structure.curves.curves.empty());
  EXPECT_TRUE(structure.curves.nodes.empty());
  EXPECT_EQ(std::count(structure.surface.quarter_indices.begin(), structure.surface.quarter_indices.end(), 1), 8);
  EXPECT_EQ(structure.surface.components.at(0).quarter_index_sum, 8);
}

// A bar bent until its ends meet. The field follows it around, if that does not turn it much from vertex to vertex:
// with 16 cells around, eight curves have the lower energy.
TEST(KnownSingularities, OfARingOfSquareSectionAreNone) {
  TetMesh ring = MakeBoxMesh({32, 4, 4}, {1, 1, 1});
  const std::vector<Vector3d> bar = ring.points;
  std::vector<int> joined(bar.size());
  for (std::size_t v = 0; v < bar.size(); ++v) {
    const Vector3d start(bar[v].x() == 1 ? 0 : bar[v].x(), bar[v].y(), bar[v].z());
    joined[v] = static_cast<int>(std::find(bar.begin(), bar.end(), start) - bar.begin());
    const double angle = 2 * EIGEN_PI * bar[v].x(), radius = 2 + bar[v].y();
    ring.points[v] = Vector3d(radius * std::cos(angle), radius * std::sin(angle), bar[v].z());
  }
  for (auto& tet : ring.tets) {
    for (int& vertex : tet) vertex = joined.at(vertex);
  }
  const Structure structure = Solve<3>(ring);
  EXPECT_TRUE(structure.curves.curves.empty());
  ASSERT_EQ(structure.surface.components.size(), 1u);
  EXPECT_EQ(structure.surface.components[0].euler_characteristic, 0);
  for (const int index : structure.surface.quarter_indices) EXPECT_EQ(index, 0);
}

class KnownSingularitiesCorpus : public CorpusTest {};

// A few iterations will do: the sum holds for any field, and so do the ends of curves.
TEST_F(KnownSingularitiesCorpus, IndicesSumToTheEulerCharacteristicAndCurvesEnd) {
  int num_meshes = 0;
  for (const Row& row : ReadManifest(folder_ / "tet/manifest.tsv")) {
    const std::filesystem::path path = folder_ / "tet" / row.at("name");
    SCOPED_TRACE(path);
    // The largest would take most of the suite's time.
    if (std::stoi(row.at("nV")) > 100000) continue;
    ++num_meshes;
    const TetMesh mesh = ReadTetMesh(path);
    const bool is_smooth = row.at("sharp_edges_gt60deg") == "0";
    FieldOptions<3> options;
    options.minimizer.max_iterations = 20;
    const Structure structure = Solve<3>(mesh, options);
    EXPECT_EQ(CountEnds(structure.curves, CurveEnd::kOpen), 0u);
    int euler_characteristic = 0;
    for (const SurfaceComponent& component : structure.surface.components) {
      EXPECT_TRUE(component.is_closed);
      EXPECT_EQ(component.quarter_index_sum, 4 * component.euler_characteristic);
      euler_characteristic += component.euler_characteristic;
    }
    EXPECT_EQ(structure.surface.components.size(), std::stoul(row.at("boundary_components")));
    EXPECT_EQ(euler_characteristic,
              2 * std::stoi(row.at("boundary_components")) - 2 * std::lround(std::stod(row.at("genus"))));
    EXPECT_TRUE(!is_smooth || structure.surface.components[0].is_normal);
  }
  EXPECT_EQ(num_meshes, 11);
}

}  // namespace
}  // namespace octupole
