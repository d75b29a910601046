#include <octupole/mesh/box_mesh.h>
#include <octupole/solvers/field_solver.h>

int main() {
  // The smoothest frames in a box are its axes, everywhere.
  const octupole::TetMesh mesh = octupole::MakeBoxMesh({2, 2, 2}, {1, 1, 1});
  const octupole::Field<3> field = octupole::SolveField<3>(mesh);
  return field.IsUsable() && field.frames.size() == mesh.points.size() && field.energy < 1e-6 ? 0 : 1;
}
