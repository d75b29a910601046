#include <octupole/alignment/boundary_alignment.h>
#include <octupole/harmonics/harmonics.h>
#include <octupole/io/field_writer.h>
#include <octupole/readers/tet_mesh_reader.h>

#include <Eigen/Core>
#include <cmath>

#if defined(CHECK) || defined(LOG)
#error "glog's macros have come through octupole::core"
#endif

int main() {
  // The reference frame is the coordinate axes: its harmonic has the same value along each of them.
  const octupole::Hexadecapole h = octupole::ReferenceHarmonic<4>();
  const double along_x = h.dot(octupole::EvaluateBasis<4>(Eigen::Vector3d::UnitX()));
  const double along_z = h.dot(octupole::EvaluateBasis<4>(Eigen::Vector3d::UnitZ()));
  return std::abs(along_x - along_z) < 1e-12 && std::abs(h.norm() - 1) < 1e-12 ? 0 : 1;
}
