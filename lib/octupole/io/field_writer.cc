#include "octupole/io/field_writer.h"

#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <stdexcept>
#include <string>

#include "octupole/harmonics/rotation.h"
#include "octupole/io/atomic_file.h"

namespace octupole {
namespace {

// The shortest digits that read back as the same numbers.
void WriteLine(std::ostream& out, std::initializer_list<double> numbers) {
  constexpr int kMaxLength = 32;
  char line[4 * kMaxLength];
  char* end = line;
  for (const double x : numbers) {
    if (end != line) *end++ = ' ';
    end = std::to_chars(end, end + kMaxLength - 2, x).ptr;
  }
  *end++ = '\n';
  out.write(line, end - line);
}

}  // namespace

template <int kDegree>
void WriteField(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
                const std::vector<VtuCells>& cells, const std::vector<Harmonic<kDegree>>& coefficients,
                const std::vector<Eigen::Matrix3d>& frames, const std::vector<Alignment>& alignments,
                std::vector<VtuArray> point_data, const std::vector<VtuArray>& cell_data) {
  const std::size_t num_points = points.size();
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
  const std::vector<VtuArray> field = {
      {"frame_x", 3, axes[0].data()},
      {"frame_y", 3, axes[1].data()},
      {"frame_z", 3, axes[2].data()},
      {kDegree == 3 ? "octupole" : "hexadecapole", kDimension<kDegree>, first_coefficient},
      {"alignment", 1, kinds.data()}};
  point_data.insert(point_data.begin(), field.begin(), field.end());
  WriteVtu(path, points, cells, point_data, cell_data);
}

template <int kDegree>
void WriteField(const std::filesystem::path& path, const TetMesh& mesh,
                const std::vector<Harmonic<kDegree>>& coefficients, const std::vector<Eigen::Matrix3d>& frames,
                const std::vector<Alignment>& alignments) {
  std::vector<VtuArray> cell_data;
  if (!mesh.regions.empty()) cell_data.push_back({"region", 1, mesh.regions.data()});
  WriteField<kDegree>(path, mesh.points, {CellsOf(mesh)}, coefficients, frames, alignments, {}, cell_data);
}

void WriteFra(const std::filesystem::path& path, const std::vector<Eigen::Matrix3d>& tet_frames) {
  WriteFileAtomically(path, [&](std::ostream& out) {
    constexpr int kVectorsPerTet = 3, kType = 0;
    out << "FRA 1\n" << tet_frames.size() << " " << kVectorsPerTet << " " << kType << "\n";
    for (const Eigen::Matrix3d& frame : tet_frames) {
      for (const auto& axis : frame.colwise()) WriteLine(out, {axis.x(), axis.y(), axis.z()});
    }
  });
}

void WriteQuaternions(const std::filesystem::path& path, const std::vector<Eigen::Matrix3d>& frames) {
  for (const Eigen::Matrix3d& frame : frames) CheckRotation("WriteQuaternions", frame);
  WriteFileAtomically(path, [&](std::ostream& out) {
    for (const Eigen::Matrix3d& frame : frames) {
      Eigen::Quaterniond q(frame);
      q.normalize();
      if (q.w() < 0) q.coeffs() = -q.coeffs();
      WriteLine(out, {q.w(), q.x(), q.y(), q.z()});
    }
  });
}

template void WriteField<3>(const std::filesystem::path&, const std::vector<Eigen::Vector3d>&,
                            const std::vector<VtuCells>&, const std::vector<Octupole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&, std::vector<VtuArray>,
                            const std::vector<VtuArray>&);
template void WriteField<3>(const std::filesystem::path&, const TetMesh&, const std::vector<Octupole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&);
template void WriteField<4>(const std::filesystem::path&, const std::vector<Eigen::Vector3d>&,
                            const std::vector<VtuCells>&, const std::vector<Hexadecapole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&, std::vector<VtuArray>,
                            const std::vector<VtuArray>&);
template void WriteField<4>(const std::filesystem::path&, const TetMesh&, const std::vector<Hexadecapole>&,
                            const std::vector<Eigen::Matrix3d>&, const std::vector<Alignment>&);

}  // namespace octupole
