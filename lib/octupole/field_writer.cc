#include "octupole/field_writer.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "octupole/vtu_writer.h"

namespace octupole {

template <int kDegree>
void WriteField(const std::filesystem::path& path, const TetMesh& mesh,
                const std::vector<Harmonic<kDegree>>& coefficients, const std::vector<Eigen::Matrix3d>& frames,
                const std::vector<Alignment>& alignments) {
  const std::size_t num_points = mesh.points.size();
  for (const std::size_t size : {coefficients.size(), frames.size(), alignments.size()}) {
    if (size == num_points) continue;
    throw std::invalid_argument("WriteField: " + std::to_string(size) + " values for " + std::to_string(num_points) +
                                " points");
  }
  std::array<std::vector<double>, 3> axes;
  for (int k = 0; k < 3; ++k) {
    axes[k].reserve(3 * num_points);
    for (const Eigen::Matrix3d& frame : frames) axes[k].insert(axes[k].end(), frame.col(k).begin(), frame.col(k).end());
  }
  std::vector<std::int32_t> kinds;
  kinds.reserve(num_points);
  for (const Alignment& alignment : alignments) kinds.push_back(static_cast<std::int32_t>(alignment.kind()));
  const double* first_coefficient = coefficients.empty() ? nullptr : coefficients[0].data();
  WriteVtu(path, mesh,
           {{"frame_x", 3, axes[0].data()},
            {"frame_y", 3, axes[1].data()},
            {"frame_z", 3, axes[2].data()},
            {kDegree == 3 ? "octupole" : "hexadecapole", kDimension<kDegree>, first_coefficient},
            {"alignment", 1, kinds.data()}});
}

template void WriteField<3>(const std::filesystem::path&, const TetMesh&, const std::vector<Octupole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&);
template void WriteField<4>(const std::filesystem::path&, const TetMesh&, const std::vector<Hexadecapole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&);

}  // namespace octupole
