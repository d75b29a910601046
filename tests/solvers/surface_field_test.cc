// Fields on surfaces, by all the ways that lead to one.

#include <ceres/solver.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "method_checks.h"
#include "octupole/energies/field_problem.h"
#include "octupole/field/cross_field.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/surface_corners.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/solvers/fast_solver.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A grid of (u, v), closed around u and, if asked, around v, each cell cut along a random diagonal.
template <typename PointAt>
TriangleMesh Tube(int num_u, int num_v, bool is_closed, const PointAt& point_at) {
  TriangleMesh mesh;
  std::mt19937 generator(1);
  for (int j = 0; j < num_v; ++j) {
    for (int i = 0; i < num_u; ++i) mesh.points.push_back(point_at(i, j));
  }
  for (int j = 0; j < (is_closed ? num_v : num_v - 1); ++j) {
    for (int i = 0; i < num_u; ++i) {
      const int next_i = (i + 1) % num_u, next_j = (j + 1) % num_v;
      const int a = j * num_u + i, b = j * num_u + next_i, c = next_j * num_u + next_i, d = next_j * num_u + i;
      if (generator() % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return mesh;
}

TriangleMesh Cylinder(int num_u, int num_v) {
  const double step = 2 * EIGEN_PI / num_u;
  return Tube(num_u, num_v, false,
              [&](int i, int j) { return Vector3d(std::cos(step * i), std::sin(step * i), step * j); });
}

TriangleMesh Torus(int num_u, int num_v) {
  return Tube(num_u, num_v, true, [&](int i, int j) {
    const double u = 2 * EIGEN_PI * i / num_u, v = 2 * EIGEN_PI * j / num_v;
    return Vector3d((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
  });
}

TriangleMesh Sphere(int cells) {
  TriangleMesh sphere = BoundarySurface(MakeBoxMesh({cells, cells, cells}, {2, 2, 2}));
  for (Vector3d& p : sphere.points) p = (p - Vector3d::Ones()).stableNormalized();
  return sphere;
}

// The angles in degrees between directions around the z axis and the nearest axes.
std::vector<double> AnglesToPrincipal(const TriangleMesh& mesh, const std::vector<Matrix3d>& frames) {
  std::vector<double> angles;
  for (std::size_t v = 0; v < frames.size(); ++v) {
    const Vector3d around = Vector3d::UnitZ().cross(mesh.points[v]).normalized();
    const double cosine = (frames[v].transpose() * around).cwiseAbs().maxCoeff();
    angles.push_back(std::acos(std::min(1., cosine)) * 180 / EIGEN_PI);
  }
  return angles;
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double Largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

TEST(AlignToSurface, GivesOpenBoundariesTheirTangents) {
  // A flat square with one corner pushed out to 45 degrees, where neither side wins.
  TriangleMesh square = Tube(5, 5, false, [](int i, int j) { return Vector3d(i, j, 0); });
  const auto is_seam = [](const std::array<int, 3>& t) {
    const auto [least, largest] = std::minmax({t[0] % 5, t[1] % 5, t[2] % 5});
    return largest - least > 1;
  };
  square.triangles.erase(std::remove_if(square.triangles.begin(), square.triangles.end(), is_seam),
                         square.triangles.end());
  for (Vector3d& p : square.points) p.x() += p.y();
  const BoundaryAlignment aligned = AlignToSurface(square);
  EXPECT_EQ(aligned.num_frames, 12u);
  EXPECT_EQ(aligned.num_normals, 13u) << "inside, and at the four corners";
  EXPECT_EQ(aligned.feature_edges.size(), 0u);
  // An inner vertex of a slanted side.
  EXPECT_NEAR((aligned.alignments[10].frame().transpose() * Vector3d(1, 1, 0)).cwiseAbs().maxCoeff(), std::sqrt(2.),
              1e-12);
  EXPECT_EQ(AlignToSurface(square, 40, OpenBoundary::kFree).num_normals, 25u);
}

TEST(SolveField, FollowsThePrincipalDirectionsOfAnOpenCylinder) {
  const TriangleMesh cylinder = Cylinder(32, 12);
  EXPECT_LT(Largest(AnglesToPrincipal(cylinder, SolveField<3>(cylinder).frames)), 1);
  EXPECT_LT(Largest(AnglesToPrincipal(cylinder, SolveField<4>(cylinder).frames)), 1);
  // With nothing but the normals to go by, degree 4 finds them (docs/surfaces.md).
  FieldOptions<4> free;
  free.open_boundary = OpenBoundary::kFree;
  EXPECT_LT(Largest(AnglesToPrincipal(cylinder, SolveField<4>(cylinder, free).frames)), 1);
}

// The random diagonals of the grid cost a few degrees where it is coarse.
TEST(SolveField, FollowsThePrincipalDirectionsOfATorus) {
  const TriangleMesh torus = Torus(64, 24);
  for (const auto& frames : {SolveField<3>(torus).frames, SolveField<4>(torus).frames}) {
    const std::vector<double> angles = AnglesToPrincipal(torus, frames);
    EXPECT_LT(RootMeanSquare(angles), 2);
    EXPECT_LT(Largest(angles), 7);
    for (const int index : QuarterIndices(torus.points, torus.triangles, frames)) EXPECT_EQ(index, 0);
  }
}

TEST(SolveField, LeavesASphereEightPointsOfAQuarter) {
  const TriangleMesh sphere = Sphere(12);
  const Field<3> field = SolveField<3>(sphere);
  EXPECT_EQ(field.alignment.num_normals, sphere.triangles.size() / 2 + 2);
  std::vector<Vector3d> singular_points;
  const std::vector<int> indices = QuarterIndices(sphere.points, sphere.triangles, field.frames);
  for (std::size_t t = 0; t < indices.size(); ++t) {
    if (indices[t] == 0) continue;
    EXPECT_EQ(indices[t], 1);
    singular_points.push_back(sphere.points[sphere.triangles[t][0]]);
  }
  EXPECT_EQ(singular_points.size(), 8u);
  for (const Vector3d& p : singular_points) {
    for (const Vector3d& q : singular_points) EXPECT_TRUE(p == q || (p - q).norm() > 0.7) << "they keep apart";
  }
}

// All faces of a box are flat: the constant frame is free of energy, and is the only field that is.
TEST(SolveField, IsConstantOnABox) {
  const TriangleMesh box = BoundarySurface(MakeBoxMesh({4, 5, 6}, {4, 5, 6}));
  const Field<3> field = SolveField<3>(box);
  EXPECT_LT(field.energy, 1e-6);
  for (const int v : CutToManifold(box).points) {
    EXPECT_LT(FrameDifference<3>(field.frames[v], Matrix3d::Identity()), 1e-6);
  }
  const std::vector<int> indices = QuarterIndices(box.points, box.triangles, field.frames);
  EXPECT_EQ(std::accumulate(indices.begin(), indices.end(), 0), 8);
  for (std::size_t t = 0; t < indices.size(); ++t) {
    if (indices[t] == 0) continue;
    // The eight quarters are at the corners.
    const auto& triangle = box.triangles[t];
    EXPECT_TRUE(std::any_of(triangle.begin(), triangle.end(), [&](int v) {
      return ((box.points[v].array() == 0) || (box.points[v].array() == Eigen::Array3d(4, 5, 6))).all();
    }));
  }
}

// Two unknowns a vertex, and both ways arrive at fields of the same energy.
TEST(SolveField, TakesResidualBlocksOnSurfaces) {
  const TriangleMesh torus = Torus(24, 10);
  FieldOptions<3> options;
  options.solver = MakeSolverOptions(SolverPreset::kLbfgs);
  options.solver->max_num_iterations = 2000;
  const Field<3> by_blocks = SolveField<3>(torus, options);
  const Field<3> fast = SolveField<3>(torus);
  EXPECT_EQ(by_blocks.size.unknowns, 2 * torus.points.size());
  EXPECT_EQ(fast.size.unknowns, 2 * torus.points.size());
  const FieldGraph graph = MakeFieldGraph(torus, std::vector<Alignment>(torus.points.size()));
  EXPECT_LE(FrameEnergyOf(graph, fast.frames), FrameEnergyOf(graph, by_blocks.frames));
  EXPECT_NEAR(by_blocks.energy, fast.energy, 3e-2 * fast.energy);
}

TEST(SolveField, RefusesWhatIsNoSurface) {
  EXPECT_THROW(SolveField<3>(TriangleMesh()), std::invalid_argument);
  FieldOptions<3> options;
  options.feature_angle_deg = 0;
  EXPECT_THROW(SolveField<3>(Torus(6, 6), options), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
