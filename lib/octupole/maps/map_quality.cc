#include "octupole/maps/map_quality.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/frames/internal/symmetric_eigen.h"

namespace octupole {
namespace {

double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

MapQuality MeasureMap(const TetMesh& mesh, const CornerParameters& parameters, double size) {
  if (parameters.size() != mesh.tets.size()) {
    throw std::invalid_argument("MeasureMap: parameters for " + std::to_string(parameters.size()) +
                                " tetrahedra, not " + std::to_string(mesh.tets.size()));
  }
  MapQuality quality;
  std::vector<double> least, largest;
  double volume = 0;
  for (std::size_t t = 0; t < parameters.size(); ++t) {
    Eigen::Matrix3d edges, images;
    for (int i = 0; i < 3; ++i) {
      edges.col(i) = mesh.points[mesh.tets[t][i + 1]] - mesh.points[mesh.tets[t][0]];
      images.col(i) = parameters[t][i + 1] - parameters[t][0];
    }
    const double det = edges.determinant(), image = images.determinant();
    const double sign = det < 0 ? -1 : 1;
    volume += std::abs(det);
    quality.parameter_volume += sign * image / 6;
    if (det == 0) continue;
    if (sign * image <= 0) {
      ++quality.flipped;
      quality.flipped_volume += std::abs(det);
    }
    const Eigen::Matrix3d jacobian = size * images * edges.inverse();
    const auto eigen = internal::DecomposeSymmetric(jacobian.transpose() * jacobian);
    least.push_back(std::sqrt(std::max(0., eigen.values[0])));
    largest.push_back(std::sqrt(eigen.values[2]));
  }
  quality.flipped_volume /= volume;
  quality.stretch_5 = Percentile(std::move(least), 0.05);
  quality.stretch_95 = Percentile(std::move(largest), 0.95);
  return quality;
}

}  // namespace octupole
