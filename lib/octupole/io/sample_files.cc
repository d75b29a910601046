#include "octupole/io/sample_files.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string>

#include "octupole/io/atomic_file.h"
#include "octupole/io/vtu_writer.h"
#include "octupole/readers/internal/mesh_readers.h"
#include "octupole/readers/internal/number_rows.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

template <std::size_t kSize>
Vector3d CenterOf(const std::vector<Vector3d>& points, const std::array<int, kSize>& cell) {
  Vector3d sum = Vector3d::Zero();
  int size = 0;
  for (const int v : cell) {
    if (v < 0) break;
    sum += points[v];
    ++size;
  }
  return sum / size;
}

void WriteCsv(const std::filesystem::path& path, const std::vector<Vector3d>& points, const FieldSamples& samples) {
  WriteFileAtomically(path, [&](std::ostream& out) {
    out << "x,y,z,frame_x_x,frame_x_y,frame_x_z,frame_y_x,frame_y_y,frame_y_z,frame_z_x,frame_z_y,frame_z_z,is_"
           "inside\n";
    constexpr int kMaxLength = 32;
    std::array<char, 13 * kMaxLength> line;
    for (std::size_t i = 0; i < points.size(); ++i) {
      char* end = line.data();
      const auto append = [&](double number) {
        end = std::to_chars(end, end + kMaxLength - 1, number).ptr;
        *end++ = ',';
      };
      for (const double x : points[i]) append(x);
      for (const double x : samples.frames[i].reshaped()) append(x);
      *end++ = samples.is_inside[i] != 0 ? '1' : '0';
      *end++ = '\n';
      out.write(line.data(), end - line.data());
    }
  });
}

void WriteVtuOfPoints(const std::filesystem::path& path, const std::vector<Vector3d>& points,
                      const FieldSamples& samples) {
  std::array<std::vector<double>, 3> axes;
  for (int k = 0; k < 3; ++k) {
    for (const Eigen::Matrix3d& frame : samples.frames) {
      axes[k].insert(axes[k].end(), frame.col(k).begin(), frame.col(k).end());
    }
  }
  std::vector<int> vertices(points.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  const std::vector<std::int32_t> is_inside(samples.is_inside.begin(), samples.is_inside.end());
  WriteVtu(path, points, {{VtuCellType::kVertex, vertices.data(), vertices.size()}},
           {{"frame_x", 3, axes[0].data()},
            {"frame_y", 3, axes[1].data()},
            {"frame_z", 3, axes[2].data()},
            {"is_inside", 1, is_inside.data()}},
           {});
}

}  // namespace

std::vector<Vector3d> ReadPoints(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension != ".csv" && extension != ".txt" && extension != ".xyz") return internal::ReadAnyMesh(path).mesh.points;
  std::vector<Vector3d> points;
  internal::ForEachNumberRow(path, [&](int line, const std::vector<double>& numbers) {
    if (numbers.size() != 3) {
      internal::FailAtLine(path, line, std::to_string(numbers.size()) + " numbers, where a point has 3");
    }
    points.emplace_back(numbers[0], numbers[1], numbers[2]);
  });
  return points;
}

std::vector<Vector3d> ReadCellCenters(const std::filesystem::path& path) {
  const internal::ParsedMesh parsed = internal::ReadAnyMesh(path, /*with_other_volumes=*/true);
  std::vector<Vector3d> centers;
  for (const auto& tet : parsed.mesh.tets) centers.push_back(CenterOf(parsed.mesh.points, tet));
  for (const auto& cell : parsed.other_volumes) centers.push_back(CenterOf(parsed.mesh.points, cell));
  if (centers.empty()) {
    throw std::runtime_error(path.string() +
                             ": no tetrahedra, hexahedra, prisms or pyramids, whose centres were asked for");
  }
  return centers;
}

void WriteSamples(const std::filesystem::path& path, const std::vector<Vector3d>& points, const FieldSamples& samples) {
  if (samples.frames.size() != points.size() || samples.is_inside.size() != points.size()) {
    throw std::invalid_argument("WriteSamples: " + std::to_string(samples.frames.size()) + " samples for " +
                                std::to_string(points.size()) + " points");
  }
  if (path.extension() == ".vtu") {
    WriteVtuOfPoints(path, points, samples);
  } else if (path.extension() == ".csv") {
    WriteCsv(path, points, samples);
  } else {
    throw std::runtime_error(path.string() + ": the extension is neither .vtu nor .csv");
  }
}

}  // namespace octupole
