#include "octupole/map_solvers/internal/map_transfer.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "cylinder_mesh.h"
#include "octupole/solvers/field_solver.h"

namespace octupole::internal {
namespace {

// Neither the names of axes nor shifts change it.
Eigen::Matrix3d MetricOf(const TetMesh& mesh, const CornerParameters& parameters, int t) {
  Eigen::Matrix3d edges, images;
  for (int i = 0; i < 3; ++i) {
    edges.col(i) = mesh.points[mesh.tets[t][i + 1]] - mesh.points[mesh.tets[t][0]];
    images.col(i) = parameters[t][i + 1] - parameters[t][0];
  }
  const Eigen::Matrix3d gradients = images * edges.inverse();
  return gradients.transpose() * gradients;
}

// Whatever the map, on a mesh with singular curves: every part has the metric of its whole.
TEST(MapTransfer, KeepsTheMetric) {
  const TetMesh mesh = MakeCylinderMesh(6, 4, 2);
  const MapDomain domain = MakeMapDomain(mesh, SolveField<3>(mesh).frames);
  ASSERT_FALSE(domain.singular_edges.empty());
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector y(domain.unknowns.num_unknowns);
  for (double& value : y) value = uniform(generator);
  const CornerParameters before = ParametersAtCorners(domain, y);
  const MapDomain finer = RefineMapDomain(domain, {20, 100, 250});
  ASSERT_GT(finer.mesh.tets.size(), domain.mesh.tets.size());
  const CornerParameters after = ParametersAtCorners(finer, TransferMap(domain, before, finer));
  for (int t = 0; t < static_cast<int>(after.size()); ++t) {
    const Eigen::Matrix3d one = MetricOf(finer.mesh, after, t), other = MetricOf(domain.mesh, before, finer.parents[t]);
    EXPECT_LT((one - other).norm(), 1e-9 * other.norm()) << t;
  }
}

}  // namespace
}  // namespace octupole::internal
