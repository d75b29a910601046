// Fields on meshes as pipelines have them: of several materials, with seams, of second order, with points of no tet.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "ball_in_box_mesh.h"
#include "ball_mesh.h"
#include "cylinder_mesh.h"
#include "octupole/field/field_quality.h"
#include "octupole/frames/frame.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/surface_corners.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/solver_presets.h"
#include "quadratic_mesh.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(SolveField, FollowsTheSphereBetweenTwoMaterials) {
  const TetMesh mesh = MakeBallInBoxMesh(8);
  const Field<3> field = SolveField<3>(mesh);
  const auto normals = VertexNormals(mesh.points, field.alignment.interfaces.triangles);
  int num_on_sphere = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (normals[v].isZero(0)) continue;
    ++num_on_sphere;
    const Vector3d along = field.frames[v].transpose() * normals[v];
    Eigen::Index axis;
    along.cwiseAbs().maxCoeff(&axis);
    EXPECT_LT(field.frames[v].col(axis).cross(normals[v]).norm(), 1e-8) << v;
  }
  EXPECT_EQ(num_on_sphere, 98);
  EXPECT_LT(MeasureNormals(mesh.points, field.alignment.interfaces.triangles, field.frames).max_deg, 1e-6);
  // Without the ball, the field of a box is constant.
  EXPECT_GT(MeasureField(mesh, field.frames).energy4, 1);
  FieldOptions<3> ignoring;
  ignoring.regions = RegionUse::kIgnore;
  EXPECT_LT(MeasureField(mesh, SolveField<3>(mesh, ignoring).frames).energy4, 1e-3);
}

// The curve that a CAD model has from pole to pole.
TEST(SolveField, IsNotTurnedBySeams) {
  constexpr int kCells = 8;
  TetMesh mesh = MakeBallMesh(kCells);
  const Field<3> unmarked = SolveField<3>(mesh);
  const auto at = [](int i, int j, int k) { return i + (kCells + 1) * (j + (kCells + 1) * k); };
  for (int k = 0; k < kCells; ++k)
    mesh.feature_edges.push_back({at(kCells, kCells / 2, k), at(kCells, kCells / 2, k + 1)});
  EXPECT_TRUE(AlignToBoundary(mesh).has_marked_features);
  EXPECT_GT(SolveField<3>(mesh).alignment.num_frames, 0u) << "marked, and no tags that tell";
  mesh.surface_triangles = BoundaryTriangles(mesh);
  mesh.surface_tags.assign(mesh.surface_triangles.size(), 1);
  const Field<3> tagged = SolveField<3>(mesh);
  EXPECT_EQ(tagged.alignment.num_seam_edges, static_cast<std::size_t>(kCells));
  EXPECT_FALSE(tagged.alignment.has_marked_features);
  EXPECT_EQ(tagged.alignment.num_frames, 0u);
  EXPECT_EQ(tagged.energy, unmarked.energy);
}

template <int kDegree>
void ExpectSameAtCorners(const TetMesh& linear, const TetMesh& quadratic, const FieldOptions<kDegree>& options) {
  const Field<kDegree> expected = SolveField<kDegree>(linear, options);
  const Field<kDegree> field = SolveField<kDegree>(quadratic, options);
  ASSERT_EQ(field.frames.size(), quadratic.points.size());
  ASSERT_EQ(field.coefficients.size(), quadratic.points.size());
  for (std::size_t v = 0; v < linear.points.size(); ++v) {
    ASSERT_LT((field.frames[v] - expected.frames[v]).norm(), 1e-9) << v;
    ASSERT_LT((field.coefficients[v] - expected.coefficients[v]).norm(), 1e-9) << v;
  }
  EXPECT_EQ(field.size.unknowns, expected.size.unknowns);
  EXPECT_EQ(field.size.nonzeros, expected.size.nonzeros);
  for (const auto& [node, a, b] : quadratic.mid_edge_nodes) {
    const Matrix3d& frame = field.frames[node];
    ASSERT_LT((frame.transpose() * frame - Matrix3d::Identity()).norm(), 1e-12);
    // As far from one end as from the other, but for what is left of it on a curved path.
    ASSERT_NEAR(FrameDifference<4>(frame, field.frames[a]), FrameDifference<4>(frame, field.frames[b]), 0.1);
    ASSERT_LT((field.coefficients[node] - HarmonicFromFrame<kDegree>(frame)).norm(), 1e-12);
  }
}

TEST(SolveField, IsTheSameOnASecondOrderMeshInEveryMethod) {
  const TetMesh linear = MakeCylinderMesh(4, 4, 2);
  const TetMesh quadratic = MakeQuadratic(linear);
  ExpectSameAtCorners<3>(linear, quadratic, {});
  ExpectSameAtCorners<4>(linear, quadratic, {});
  for (const FieldMethod method : {FieldMethod::kRaySokolov, FieldMethod::kHuang, FieldMethod::kMbo}) {
    FieldOptions<4> options;
    options.method = method;
    ExpectSameAtCorners<4>(linear, quadratic, options);
  }
  FieldOptions<3> with_ceres;
  with_ceres.solver = MakeSolverOptions(SolverPreset::kLbfgs);
  ExpectSameAtCorners<3>(linear, quadratic, with_ceres);
}

TEST(SolveField, KeepsToConstraintsOnMidEdgeNodes) {
  const TetMesh mesh = MakeQuadratic(MakeCylinderMesh(4, 4, 2));
  const int axis_node = mesh.mid_edge_nodes[5][0], frame_node = mesh.mid_edge_nodes[9][0];
  const Vector3d axis = Vector3d(1, 2, 3).normalized();
  const Matrix3d axes = Eigen::AngleAxisd(0.5, axis).toRotationMatrix();
  FieldOptions<3> options;
  options.constraints = {{axis_node, Alignment::Axis(axis)}, {frame_node, Alignment::Frame(axes)}};
  const Field<3> field = SolveField<3>(mesh, options);
  EXPECT_LT(field.frames[axis_node].col(2).cross(axis).norm(), 1e-12);
  EXPECT_LT(FrameDifference<4>(field.frames[frame_node], axes), 1e-12);
  for (const int v : {axis_node, frame_node}) {
    EXPECT_LT((field.coefficients[v] - HarmonicFromFrame<3>(field.frames[v])).norm(), 1e-12) << v;
  }
}

TEST(SolveField, DoesNotMindPointsOfNoTet) {
  const TetMesh mesh = MakeCylinderMesh(4, 4, 2);
  TetMesh with_points = mesh;
  const int num_isolated = 3 * static_cast<int>(mesh.points.size());
  // In front and behind.
  with_points.points.insert(with_points.points.begin(), num_isolated, Vector3d(9, 9, 9));
  with_points.points.insert(with_points.points.end(), 5, Vector3d(9, 9, 9));
  for (auto& tet : with_points.tets) {
    for (int& v : tet) v += num_isolated;
  }
  const Field<3> expected = SolveField<3>(mesh), field = SolveField<3>(with_points);
  EXPECT_EQ(field.size.unknowns, expected.size.unknowns);
  EXPECT_EQ(field.energy, expected.energy);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) EXPECT_EQ(field.frames[num_isolated + v], expected.frames[v]);
  EXPECT_EQ(field.frames.front(), Matrix3d::Identity());
  EXPECT_EQ(field.frames.back(), Matrix3d::Identity());
}

}  // namespace
}  // namespace octupole
