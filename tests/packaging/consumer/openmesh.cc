#include <octupole/adaptors/openmesh_surface.h>
#include <octupole/alignment/boundary_alignment.h>
#include <octupole/mesh/box_mesh.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

int main() {
  // The boundary of a box: six normals, and frames at its edges.
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  const octupole::TetMesh box = octupole::MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const auto boundary = octupole::MakeOpenMesh<Mesh>(octupole::BoundarySurface(box));
  const auto alignment = octupole::AlignToSurface(octupole::TriangleMeshFromOpenMesh(boundary.mesh));
  return boundary.mesh.n_vertices() == 26 && alignment.num_normals == 6 && alignment.num_frames == 20 ? 0 : 1;
}
