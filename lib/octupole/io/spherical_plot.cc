#include "octupole/io/spherical_plot.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "octupole/io/atomic_file.h"

namespace octupole {
namespace {

struct SphereGrid {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

// The poles first, then circles of latitude.
SphereGrid MakeSphereGrid(int bands) {
  const int turns = 2 * bands;
  SphereGrid grid;
  grid.points = {Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ()};
  for (int i = 1; i < bands; ++i) {
    const double polar = M_PI * i / bands;
    for (int j = 0; j < turns; ++j) {
      const double azimuth = 2 * M_PI * j / turns;
      grid.points.push_back(
          {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)});
    }
  }
  const auto at = [&](int i, int j) {
    if (i == 0) return 0;
    if (i == bands) return 1;
    return 2 + (i - 1) * turns + j % turns;
  };
  for (int i = 0; i < bands; ++i) {
    for (int j = 0; j < turns; ++j) {
      if (i > 0) grid.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < bands) grid.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  }
  return grid;
}

}  // namespace

template <int kDegree>
void WriteSphericalPlot(const std::filesystem::path& path, const Harmonic<kDegree>& h, int resolution) {
  if (!h.allFinite() || resolution < 3) {
    std::ostringstream message;
    message << "WriteSphericalPlot: not finite, or fewer than 3 bands: [" << h.transpose() << "], " << resolution;
    throw std::invalid_argument(message.str());
  }
  const SphereGrid grid = MakeSphereGrid(resolution);
  WriteFileAtomically(path, [&](std::ostream& out) {
    out.precision(9);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n<PolyData>\n<Piece NumberOfPoints=\""
        << grid.points.size() << "\" NumberOfPolys=\"" << grid.triangles.size()
        << "\">\n<PointData Scalars=\"value\">\n<DataArray type=\"Float64\" Name=\"value\" format=\"ascii\">\n";
    std::vector<double> values;
    for (const Eigen::Vector3d& point : grid.points) values.push_back(h.dot(EvaluateBasis<kDegree>(point)));
    for (const double value : values) out << value << '\n';
    out << "</DataArray>\n</PointData>\n<Points>\n"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
    for (std::size_t i = 0; i < values.size(); ++i) out << (std::abs(values[i]) * grid.points[i]).transpose() << '\n';
    out << "</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
    for (const auto& [a, b, c] : grid.triangles) out << a << ' ' << b << ' ' << c << '\n';
    out << "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t i = 1; i <= grid.triangles.size(); ++i) out << 3 * i << '\n';
    out << "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  });
}

template void WriteSphericalPlot<3>(const std::filesystem::path&, const Octupole&, int);
template void WriteSphericalPlot<4>(const std::filesystem::path&, const Hexadecapole&, int);

}  // namespace octupole
