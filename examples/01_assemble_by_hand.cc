// A frame field from nothing but arrays of points and tets: our residual blocks, a ceres::Problem
// of your own, and whatever Ceres solver you like. The mesh here is a bar, 6 x 2 x 2, each of its
// cubes cut into six tets.
#include <ceres/ceres.h>
#include <octupole/cost_functions/alignment_manifold.h>
#include <octupole/cost_functions/deviation_cost.h>
#include <octupole/cost_functions/scale_cost.h>
#include <octupole/cost_functions/smoothness_cost.h>
#include <octupole/frames/frame.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

int main() {
  // The arrays, as they might come from your mesh.
  const int nx = 6, ny = 2, nz = 2;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 4>> tets;
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) {
        const int v = static_cast<int>(points.size());
        points.emplace_back(x, y, z);
        if (x == nx || y == ny || z == nz) continue;
        // From corner v of a cube to the opposite one, along its edges in each order.
        std::array<int, 3> step = {1, nx + 1, (nx + 1) * (ny + 1)};
        do {
          tets.push_back({v, v + step[0], v + step[0] + step[1], v + step[0] + step[1] + step[2]});
        } while (std::next_permutation(step.begin(), step.end()));
      }
    }
  }

  // One octupole per vertex, from any start.
  std::vector<octupole::Octupole> field(points.size());
  for (std::size_t v = 0; v < field.size(); ++v) field[v] = octupole::Octupole::Random();

  ceres::Problem problem;
  for (std::size_t v = 0; v < field.size(); ++v) {
    problem.AddParameterBlock(field[v].data(), 7);
    problem.AddResidualBlock(octupole::ScaleCost<3>::Create(5), nullptr, field[v].data());
    problem.AddResidualBlock(octupole::DeviationCost<3>::Create(0.25), nullptr, field[v].data());
  }
  std::set<std::pair<int, int>> edges;
  for (const auto& tet : tets)
    for (const int a : tet)
      for (const int b : tet)
        if (a < b) edges.emplace(a, b);
  for (const auto& [a, b] : edges)
    problem.AddResidualBlock(octupole::SmoothnessCost<3>::Create(1), nullptr, field[a].data(), field[b].data());

  // Hard alignment with the normal of the side z = 0.
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (points[v].z() != 0) continue;
    const auto alignment = octupole::Alignment::Axis({0, 0, 1});
    field[v] = octupole::AlignedSubspace<3>(alignment).Project(field[v]);
    problem.SetManifold(field[v].data(), new octupole::AlignmentManifold<3>(alignment));
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 200;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  const Eigen::Matrix3d frame = octupole::NearestFrame<3>(field.back());
  std::printf("%s\nenergy %g\nframe at the far corner:\n", summary.BriefReport().c_str(), 2 * summary.final_cost);
  for (int k = 0; k < 3; ++k) std::printf("  axis (%7.4f, %7.4f, %7.4f)\n", frame(0, k), frame(1, k), frame(2, k));
  // The constant field has no energy, and z is an axis of it everywhere.
  return 2 * summary.final_cost < 1e-8 && frame.row(2).cwiseAbs().maxCoeff() > 1 - 1e-8 ? 0 : 1;
}
