// With OpenMesh: a cross field on a surface mesh, and features marked on the boundary of a tet mesh that steer the
// frames inside. Any mesh type of OpenMesh will do.
#include <octupole/adaptors/openmesh_surface.h>
#include <octupole/field/cross_field.h>
#include <octupole/mesh/box_mesh.h>
#include <octupole/solvers/fast_solver.h>
#include <octupole/solvers/field_solver.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <algorithm>
#include <cmath>
#include <cstdio>

using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<>;

// Quadrilaterals on the unit sphere, without the caps.
PolyMesh MakeZone(int around, int along) {
  PolyMesh mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i < around; ++i) {
      const double azimuth = 2 * M_PI * i / around, z = 1.6 * j / along - 0.8, r = std::sqrt(1 - z * z);
      v.push_back(mesh.add_vertex(PolyMesh::Point(r * std::cos(azimuth), r * std::sin(azimuth), z)));
    }
  }
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      mesh.add_face({v[a], v[b], v[b + around], v[a + around]});
    }
  }
  return mesh;
}

int main() {
  // 1. A cross field. The graph has the mesh's own edges; normals and borders say what each vertex keeps to.
  PolyMesh zone = MakeZone(32, 12);
  const octupole::TriangleMesh triangles = octupole::TriangleMeshFromOpenMesh(zone);
  const octupole::BoundaryAlignment alignment = octupole::AlignToSurface(triangles);
  const octupole::FieldGraph graph = octupole::FieldGraphFromOpenMesh(zone, alignment.alignments);
  const auto solution = octupole::SolveFast<3>(graph, {});

  // The result goes to properties of whatever names you like.
  octupole::SetVertexFrames({"u", "v", "n"}, octupole::CrossField(triangles, solution.frames), &zone);
  octupole::SetFaceProperty("quarter index", octupole::FaceQuarterIndices(zone, solution.frames), &zone);

  int num_singular = 0;
  for (const auto& face : zone.faces()) num_singular += OpenMesh::FProp<int>(zone, "quarter index")[face] != 0;
  const PolyMesh::Point u = OpenMesh::VProp<PolyMesh::Point>(zone, "u")[OpenMesh::VertexHandle(0)];
  std::printf("zone of a sphere: %d singular faces; a tangent on the border: (%.3f, %.3f, %.3f)\n", num_singular, u[0],
              u[1], u[2]);

  // 2. A line marked on the boundary of a tet mesh: the diagonal of a box's top, along which the grid has edges.
  octupole::TetMesh box = octupole::MakeBoxMesh({6, 6, 2}, {6, 6, 2});
  auto boundary = octupole::MakeOpenMesh<TriMesh>(octupole::BoundarySurface(box));
  TriMesh& surface = boundary.mesh;
  for (const auto& edge : surface.edges()) {
    const TriMesh::Point a = surface.point(edge.v0()), b = surface.point(edge.v1());
    const bool is_on_diagonal = a[2] == 2 && b[2] == 2 && a[0] == a[1] && b[0] == b[1];
    surface.status(edge).set_feature(is_on_diagonal);
  }
  octupole::HandBackFeatures(boundary, &box);
  const octupole::Field<3> field = octupole::SolveField<3>(box);

  // In the middle of the top, the axes have turned into the diagonal.
  const std::size_t middle = 2 * 49 + 3 * 7 + 3;
  const double cosine =
      (field.frames[middle].transpose() * Eigen::Vector3d(1, 1, 0)).cwiseAbs().maxCoeff() / std::sqrt(2);
  std::printf("box: %zu feature edges; on the line an axis is %.2g degrees from it\n", box.feature_edges.size(),
              std::acos(std::min(1., cosine)) * 180 / M_PI);
  return num_singular == 0 && box.feature_edges.size() == 6 && cosine > 1 - 1e-9 ? 0 : 1;
}
