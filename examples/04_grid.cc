// A frame field from a surface alone, without a tet mesh: the solid lies in a grid of cubes, fine along the surface and
// coarser inside.

#include <octupole/grids/surface_grid.h>
#include <octupole/grids/surface_grid_tets.h>
#include <octupole/singularities/singular_curves.h>
#include <octupole/singularities/singular_triangles.h>
#include <octupole/solvers/fast_solver.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

// A closed cylinder of radius 1 and height 2, as an STL file might have it.
octupole::TriangleMesh MakeCylinder(int sides) {
  octupole::TriangleMesh surface;
  surface.points = {{0, 0, 0}, {0, 0, 2}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.) * i / sides;
    for (const double z : {0., 2.}) surface.points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  for (int i = 0; i < sides; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    surface.triangles.insert(surface.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
  }
  return surface;
}

}  // namespace

int main() {
  const octupole::TriangleMesh surface = MakeCylinder(96);

  octupole::GridOptions options;
  options.size = 0.05;  // of the cells along the surface
  options.levels = 2;   // those inside are up to twice as large
  const octupole::SurfaceGrid grid = octupole::MakeGrid(surface, options);

  // A graph like any other: every solver and residual block takes it.
  const octupole::FieldSolution<3> field = octupole::SolveFast<3>(grid.graph, {});

  const octupole::GridTets tets = octupole::TetsAtSingularities(grid, field.frames);
  const octupole::SingularCurves curves =
      octupole::TraceSingularCurves(tets.mesh, tets.frames, octupole::FindSingularTriangles(tets.mesh, tets.frames));

  std::printf("%zu nodes, %zu of them aligned with the surface\n", grid.points.size(),
              grid.alignment.num_normals + grid.alignment.num_frames);
  int num_of_valence_3 = 0;
  for (const octupole::SingularCurve& curve : curves.curves) num_of_valence_3 += curve.valence == 3;
  std::printf("%zu singular curves, %d of valence 3\n", curves.curves.size(), num_of_valence_3);
  // The cross field of a disk has four singular points, so a cylinder has four curves.
  return curves.curves.size() == 4 && num_of_valence_3 == 4 ? 0 : 1;
}
