#include "octupole/field/field_quality.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "octupole/frames/octahedral_group.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "random_inputs.h"
#include "turn.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(MeasureField, FindsNothingWrongWithTheConstantFieldOfABox) {
  const TetMesh mesh = MakeBoxMesh({3, 4, 5}, {1, 1, 1});
  std::vector<Matrix3d> frames(mesh.points.size());
  // Order and signs of the axes do not count.
  for (std::size_t v = 0; v < frames.size(); ++v) frames[v] = OctahedralGroup()[v % 24].matrix();
  const FieldQuality quality = MeasureField(mesh, frames);
  // A box of a x b x c cubes, each of six tets around a diagonal: edges along three axes, three kinds of face diagonals
  // and one of space diagonals.
  EXPECT_EQ(quality.edges, 3u * 5 * 6 + 4u * 4 * 6 + 4u * 5 * 5 + 3u * 4 * 6 + 3u * 5 * 5 + 4u * 4 * 5 + 3u * 4 * 5);
  EXPECT_NEAR(quality.energy3, 0, 1e-12);
  EXPECT_NEAR(quality.energy4, 0, 1e-12);
  EXPECT_NEAR(quality.boundary_max_deg, 0, 1e-12);
  EXPECT_EQ(quality.singular_triangles, 0u);
  // The inner vertices of the six faces: those on edges are not smooth.
  EXPECT_EQ(quality.smooth_boundary_vertices, 2u * (2 * 3 + 3 * 4 + 2 * 4));
}

// A constant field 10 degrees off about z: four of the six faces of a cube see the whole angle, two see none.
TEST(MeasureField, MeasuresTheAngleToTheNormal) {
  const TetMesh mesh = MakeBoxMesh({3, 3, 3}, {1, 1, 1});
  const std::vector<Matrix3d> frames(mesh.points.size(), Turn(10 * EIGEN_PI / 180, Vector3d::UnitZ()));
  const FieldQuality quality = MeasureField(mesh, frames);
  EXPECT_NEAR(quality.boundary_max_deg, 10, 1e-12);
  EXPECT_NEAR(quality.boundary_rms_deg, 10 * std::sqrt(4. / 6), 1e-12);
}

// Frames that twist by a small angle from one layer to the next: 16 t^2 and 20/3 t^2 for every edge between layers.
TEST(MeasureField, SumsTheEnergiesOverEdges) {
  const TetMesh mesh = MakeBoxMesh({3, 3, 3}, {3, 3, 3});
  const double t = 1e-3;
  std::vector<Matrix3d> frames;
  for (const Vector3d& p : mesh.points) frames.push_back(Turn(t * p.z(), Vector3d(1, 2, 3).normalized()));
  int between_layers = 0;
  for (const auto& [a, b] : MeshEdges(mesh)) between_layers += mesh.points[a].z() != mesh.points[b].z();
  const FieldQuality quality = MeasureField(mesh, frames);
  EXPECT_NEAR(quality.energy3 / (16 * t * t * between_layers), 1, 1e-5);
  EXPECT_NEAR(quality.energy4 / (20. / 3 * t * t * between_layers), 1, 1e-5);
}

// Frames that turn by a quarter around a vertical line are singular there: the line crosses the 4 layers' horizontal
// triangles and, in each of the 3 cells between, the faces between the three tets that it passes.
TEST(MeasureField, CountsTrianglesCrossedByASingularCurve) {
  const TetMesh mesh = MakeBoxMesh({5, 5, 3}, {5, 5, 3});
  for (const double turn : {.25, -.25}) {
    std::vector<Matrix3d> frames;
    for (const Vector3d& p : mesh.points) {
      frames.push_back(Turn(turn * std::atan2(p.y() - 2.4, p.x() - 2.45), Vector3d::UnitZ()));
    }
    const FieldQuality quality = MeasureField(mesh, frames);
    EXPECT_EQ(quality.singular_triangles, 4u + 3u * 2u);
    EXPECT_EQ(quality.singular_triangles_of_type[static_cast<int>(TurnType::kQuarter)], quality.singular_triangles);
  }
}

// However much frames turn across the mesh, a field without a singular curve has no singular triangle.
TEST(MeasureField, DoesNotTakeTwistForSingularity) {
  const TetMesh mesh = MakeBoxMesh({5, 5, 3}, {5, 5, 3});
  std::vector<Matrix3d> frames;
  for (const Vector3d& p : mesh.points) {
    frames.push_back(Turn(.3 * p.x(), Vector3d(1, 2, 3).normalized()) * Turn(.3 * p.y(), Vector3d::UnitX()));
  }
  EXPECT_EQ(MeasureField(mesh, frames).singular_triangles, 0u);
}

TEST(MeasureField, WantsOneFramePerPoint) {
  EXPECT_THROW(MeasureField(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), std::vector<Matrix3d>(7)), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
