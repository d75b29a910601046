// A frame field on a mesh type of your own, with a cost of your own and a frame that you prescribe. All that Octupole
// needs of a mesh is which vertices are neighbours, and what the frame at each must keep to.
//
// The mesh here is the wall of a pipe, a grid in cylinder coordinates, whose cells are neither tets nor of any type
// that the library knows. Your own cost pulls the frames towards a direction that winds around the pipe, as fibres do.
#include <ceres/ceres.h>
#include <octupole/energies/field_problem.h>
#include <octupole/field/field_graph.h>
#include <octupole/frames/frame.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

// Your mesh.
struct Pipe {
  static constexpr int kAround = 24, kAlong = 12, kThrough = 3;
  static int Vertex(int i, int j, int k) { return (k * kAlong + j) * kAround + i % kAround; }
  static Eigen::Vector3d Outwards(int i) {
    const double angle = 2 * M_PI * i / kAround;
    return {std::cos(angle), std::sin(angle), 0};
  }
  // The frame of the fibres, which climb at 30 degrees; its first axis is their direction.
  static Eigen::Matrix3d FibreFrame(int i) {
    Eigen::Matrix3d frame;
    frame.col(0) = Eigen::AngleAxisd(M_PI / 6, Outwards(i)) * Eigen::Vector3d::UnitZ().cross(Outwards(i));
    frame.col(1) = Outwards(i).cross(frame.col(0));
    frame.col(2) = Outwards(i);
    return frame;
  }
};

// Your cost of an octupole a: r = sqrt(weight) (1 - (a . t)^2), zero where a is the octupole t of the fibres' frame or
// its negative, which is the same frame.
struct FibreCost {
  template <typename T>
  bool operator()(const T* a, T* residual) const {
    T dot(0);
    for (int i = 0; i < 7; ++i) dot += a[i] * target[i];
    *residual = std::sqrt(weight) * (1. - dot * dot);
    return true;
  }
  double weight;
  octupole::Octupole target;
};

int main() {
  // Edges, each with the weight of its smoothness, and alignments: the inside and the outside of the pipe have normals.
  octupole::FieldGraph graph;
  graph.alignments.resize(Pipe::kAround * Pipe::kAlong * Pipe::kThrough);
  for (int k = 0; k < Pipe::kThrough; ++k) {
    for (int j = 0; j < Pipe::kAlong; ++j) {
      for (int i = 0; i < Pipe::kAround; ++i) {
        const int v = Pipe::Vertex(i, j, k);
        graph.edges.push_back({v, Pipe::Vertex(i + 1, j, k), 1});
        if (j + 1 < Pipe::kAlong) graph.edges.push_back({v, Pipe::Vertex(i, j + 1, k), 1});
        if (k + 1 < Pipe::kThrough) graph.edges.push_back({v, Pipe::Vertex(i, j, k + 1), 1});
        if (k == 0 || k + 1 == Pipe::kThrough) graph.alignments[v] = octupole::Alignment::Axis(Pipe::Outwards(i));
      }
    }
  }
  // A feature: this one frame is given.
  const int clamp = Pipe::Vertex(0, 0, 0);
  graph.alignments[clamp] = octupole::Alignment::Frame(Eigen::Matrix3d::Identity());

  std::vector<octupole::Octupole> field = octupole::RandomField<3>(graph, /*seed=*/1);
  ceres::Problem problem;
  octupole::BuildFieldProblem<3>(graph, {}, &field, &problem);
  for (std::size_t v = 0; v < field.size(); ++v) {
    auto* cost =
        new FibreCost{10, octupole::HarmonicFromFrame<3>(Pipe::FibreFrame(static_cast<int>(v) % Pipe::kAround))};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<FibreCost, 1, 7>(cost), nullptr, field[v].data());
  }
  ceres::Solver::Options options;
  options.minimizer_type = ceres::LINE_SEARCH;
  options.max_num_iterations = 500;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  // How far the axes are from the fibres at the far end, and at the clamp, where they may not follow.
  const auto angle = [&](int v) {
    const Eigen::Matrix3d frame = octupole::NearestFrame<3>(field[v]);
    const double cosine = (frame.transpose() * Pipe::FibreFrame(v % Pipe::kAround).col(0)).cwiseAbs().maxCoeff();
    return std::acos(std::min(1., cosine)) * 180 / M_PI;
  };
  double worst = 0;
  for (int i = 0; i < Pipe::kAround; ++i) worst = std::max(worst, angle(Pipe::Vertex(i, Pipe::kAlong - 1, 1)));
  std::printf("%s\nat the far end the axes are within %.2f degrees of the fibres; at the clamp, %.2f off\n",
              summary.BriefReport().c_str(), worst, angle(clamp));
  return worst < 1 && std::abs(angle(clamp) - 30) < 1e-6 ? 0 : 1;
}
