#include "octupole/adaptors/openmesh_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
// MeshIO.hh has to come before the meshes.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <numeric>
#include <stdexcept>

#include "corpus.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/surface_corners.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "octupole/solvers/field_solver.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::ElementsAre;

struct EigenTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
  VertexAttributes(OpenMesh::Attributes::Normal);
  FaceAttributes(OpenMesh::Attributes::Normal);
};
using FloatTriMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoublePolyMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using EigenTriMesh = OpenMesh::TriMesh_ArrayKernelT<EigenTraits>;

// The faces of the unit cube, vertex x + 2 y + 4 z.
template <typename Mesh>
Mesh QuadCube() {
  Mesh mesh;
  for (int v = 0; v < 8; ++v) {
    typename Mesh::Point p;
    for (int k = 0; k < 3; ++k) p[k] = v >> k & 1;
    mesh.add_vertex(p);
  }
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.add_face(
        {OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b), OpenMesh::VertexHandle(c), OpenMesh::VertexHandle(d)});
  }
  return mesh;
}

template <typename Mesh>
class OpenMeshOfAnyTraits : public testing::Test {};
using Meshes = testing::Types<FloatTriMesh, DoublePolyMesh, EigenTriMesh>;
TYPED_TEST_SUITE(OpenMeshOfAnyTraits, Meshes);

// There and back: points, triangles and their order.
TYPED_TEST(OpenMeshOfAnyTraits, BecomesTheArraysItWasMadeOf) {
  TriangleMesh box = BoundarySurface(MakeBoxMesh({2, 1, 1}, {2, 1, 0.5}));
  box.feature_edges = {{1, 0}};
  box.feature_points = {11};
  const OpenMeshSurface<TypeParam> surface = MakeOpenMesh<TypeParam>(box);
  EXPECT_EQ(surface.num_copies, 0u);
  std::vector<int> faces;
  const TriangleMesh back = TriangleMeshFromOpenMesh(surface.mesh, &faces);
  EXPECT_EQ(back.points, box.points);
  ASSERT_EQ(back.triangles.size(), box.triangles.size());
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    EXPECT_EQ(faces[t], static_cast<int>(t));
    EXPECT_TRUE(std::is_permutation(back.triangles[t].begin(), back.triangles[t].end(), box.triangles[t].begin()));
    EXPECT_GT(TriangleNormal(box.points, back.triangles[t]).dot(TriangleNormal(box.points, box.triangles[t])), 0.99);
  }
  ASSERT_EQ(back.feature_edges.size(), 1u);
  EXPECT_THAT(back.feature_edges[0], testing::UnorderedElementsAre(0, 1));
  EXPECT_THAT(back.feature_points, ElementsAre(11));
  const FieldGraph graph = FieldGraphFromOpenMesh(surface.mesh, std::vector<Alignment>(12));
  EXPECT_EQ(graph.edges.size(), MeshEdges(box).size());
}

TYPED_TEST(OpenMeshOfAnyTraits, TakesFramesAndIndicesAsPropertiesOfAnyName) {
  const TriangleMesh box = BoundarySurface(MakeBoxMesh({1, 1, 1}, {1, 1, 1}));
  TypeParam mesh = MakeOpenMesh<TypeParam>(box).mesh;
  const std::vector<Matrix3d> frames(8, Eigen::AngleAxisd(0.5, Vector3d::UnitZ()).toRotationMatrix());
  for (int round = 0; round < 2; ++round) {
    SetVertexFrames({"u", "v", "my normal"}, frames, &mesh);
    SetVertexProperty("whole frame", frames, &mesh);
    SetFaceProperty("index", std::vector<int>(12, 7 + round), &mesh);
  }
  const auto v = OpenMesh::VProp<typename TypeParam::Point>(mesh, "v");
  EXPECT_NEAR(v[OpenMesh::VertexHandle(7)][0], -std::sin(0.5), 1e-7);
  EXPECT_EQ(OpenMesh::VProp<Matrix3d>(mesh, "whole frame")[OpenMesh::VertexHandle(0)], frames[0]);
  EXPECT_EQ(OpenMesh::FProp<int>(mesh, "index")[OpenMesh::FaceHandle(11)], 8);
  EXPECT_THROW(SetVertexProperty("u", std::vector<Vector3d>(7), &mesh), std::invalid_argument);
  EXPECT_THROW(SetFaceProperty("index", std::vector<int>(8), &mesh), std::invalid_argument);
}

TEST(TriangleMeshFromOpenMesh, CutsPolygonsButAddsNoEdgesToTheGraph) {
  const auto mesh = QuadCube<DoublePolyMesh>();
  std::vector<int> faces;
  const TriangleMesh triangles = TriangleMeshFromOpenMesh(mesh, &faces);
  EXPECT_THAT(faces, ElementsAre(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5));
  EXPECT_TRUE(triangles.feature_edges.empty());
  EXPECT_EQ(FieldGraphFromOpenMesh(mesh, std::vector<Alignment>(8)).edges.size(), 12u);
  EXPECT_THROW(FieldGraphFromOpenMesh(mesh, std::vector<Alignment>(7)), std::invalid_argument);
  // Eight quarters in all, whatever the frames.
  const std::vector<int> indices = FaceQuarterIndices(mesh, std::vector<Matrix3d>(8, Matrix3d::Identity()));
  EXPECT_EQ(indices.size(), 6u);
  EXPECT_EQ(std::accumulate(indices.begin(), indices.end(), 0), 8);
}

TEST(TriangleMeshFromOpenMesh, TakesFeaturesThatOpenMeshFoundByAngle) {
  FloatTriMesh mesh = MakeOpenMesh<FloatTriMesh>(BoundarySurface(MakeBoxMesh({1, 1, 1}, {1, 1, 1}))).mesh;
  mesh.request_face_normals();
  mesh.update_face_normals();
  mesh.find_feature_edges(OpenMesh::deg_to_rad(40.0));
  EXPECT_EQ(TriangleMeshFromOpenMesh(mesh).feature_edges.size(), 12u);
}

TEST(TriangleMeshFromOpenMesh, LeavesOutWhatIsDeleted) {
  FloatTriMesh mesh = MakeOpenMesh<FloatTriMesh>(BoundarySurface(MakeBoxMesh({1, 1, 1}, {1, 1, 1}))).mesh;
  mesh.request_face_status();
  mesh.request_halfedge_status();
  const std::size_t num_triangles = mesh.n_faces() - mesh.valence(OpenMesh::VertexHandle(1));
  mesh.delete_vertex(OpenMesh::VertexHandle(1));
  std::vector<int> faces;
  const TriangleMesh rest = TriangleMeshFromOpenMesh(mesh, &faces);
  EXPECT_EQ(rest.points.size(), 8u);
  EXPECT_EQ(rest.triangles.size(), num_triangles);
  EXPECT_EQ(faces.size(), num_triangles);
  for (const auto& triangle : rest.triangles) EXPECT_THAT(triangle, testing::Not(testing::Contains(1)));
  for (const WeightedEdge& edge : FieldGraphFromOpenMesh(mesh, std::vector<Alignment>(8)).edges) {
    EXPECT_TRUE(edge.a != 1 && edge.b != 1);
  }
}

TEST(HandBackFeatures, ReplacesThoseOnTheBoundaryAndKeepsThoseInside) {
  TetMesh mesh = MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  // From corner to corner along x, from the centre of a side inwards.
  mesh.feature_edges = {{0, 1}, {1, 2}, {4, 13}};
  mesh.feature_points = {13, 26};
  OpenMeshSurface<FloatTriMesh> boundary = MakeOpenMesh<FloatTriMesh>(BoundarySurface(mesh));
  EXPECT_EQ(boundary.points.size(), 26u);
  HandBackFeatures(boundary, &mesh);
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array{0, 1}, std::array{1, 2}, std::array{4, 13}));
  EXPECT_THAT(mesh.feature_points, ElementsAre(13, 26));

  const auto vertex_at = [&](int v) {
    const auto found = std::find(boundary.points.begin(), boundary.points.end(), v);
    return OpenMesh::VertexHandle(static_cast<int>(found - boundary.points.begin()));
  };
  FloatTriMesh& surface = boundary.mesh;
  const auto edge_at = [&](int a, int b) {
    return surface.edge_handle(surface.find_halfedge(vertex_at(a), vertex_at(b)));
  };
  surface.status(edge_at(0, 1)).set_feature(false);
  surface.status(edge_at(26, 25)).set_feature(true);
  surface.status(vertex_at(26)).set_feature(false);
  surface.status(vertex_at(2)).set_feature(true);
  HandBackFeatures(boundary, &mesh);
  EXPECT_THAT(mesh.feature_edges, ElementsAre(std::array{1, 2}, std::array{4, 13}, std::array{25, 26}));
  EXPECT_THAT(mesh.feature_points, ElementsAre(2, 13));
}

class OpenMeshCorpus : public CorpusTest {};

// OpenMesh refuses faces at edges and vertices that are not manifold. Not ours.
TEST_F(OpenMeshCorpus, HasEveryTriangleOfBoundariesThatAreNoManifolds) {
  for (const char* name : {"nonmanifold_edge.mesh", "nonmanifold_vertex.mesh", "good_small.mesh"}) {
    const TriangleMesh surface = BoundarySurface(ReadTetMesh(folder_ / "bad" / name));
    const OpenMeshSurface<FloatTriMesh> boundary = MakeOpenMesh<FloatTriMesh>(surface);
    EXPECT_EQ(boundary.mesh.n_faces(), surface.triangles.size()) << name;
    EXPECT_EQ(boundary.num_copies == 0, std::string(name) == "good_small.mesh") << name;
  }
}

// At vertices in the middle of a crease, where it has two edges on about one line, an axis runs along it.
TEST_F(OpenMeshCorpus, CreasesOfTheFandiskCarryTheField) {
  DoublePolyMesh mesh;
  mesh.request_face_normals();
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, (folder_ / "surface/fandisk.obj").string()));
  mesh.update_face_normals();
  mesh.request_edge_status();
  mesh.find_feature_edges(OpenMesh::deg_to_rad(40.0));
  const TriangleMesh surface = TriangleMeshFromOpenMesh(mesh);
  const Field<3> field = SolveField<3>(surface);
  EXPECT_TRUE(field.alignment.has_marked_features);

  std::vector<std::vector<Vector3d>> directions(surface.points.size());
  for (const auto& [a, b] : surface.feature_edges) {
    const Vector3d direction = (surface.points[b] - surface.points[a]).normalized();
    directions[a].push_back(direction);
    directions[b].push_back(-direction);
  }
  std::vector<double> angles;
  for (std::size_t v = 0; v < directions.size(); ++v) {
    if (directions[v].size() != 2 || directions[v][0].dot(directions[v][1]) > -std::cos(0.1)) continue;
    const Vector3d tangent = (directions[v][0] - directions[v][1]).normalized();
    const double cosine = (field.frames[v].transpose() * tangent).cwiseAbs().maxCoeff();
    angles.push_back(std::acos(std::min(1., cosine)) * 180 / EIGEN_PI);
  }
  EXPECT_GT(angles.size(), 500u);
  std::sort(angles.begin(), angles.end());
  RecordProperty("crease_vertices", static_cast<int>(angles.size()));
  RecordProperty("median_deg", std::to_string(angles[angles.size() / 2]));
  RecordProperty("p95_deg", std::to_string(angles[angles.size() * 95 / 100]));
  RecordProperty("largest_deg", std::to_string(angles.back()));
  EXPECT_LT(angles[angles.size() / 2], 1);
  EXPECT_LT(angles[angles.size() * 95 / 100], 5);
}

}  // namespace
}  // namespace octupole
