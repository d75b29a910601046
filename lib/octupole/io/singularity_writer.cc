#include "octupole/io/singularity_writer.h"

#include <cstddef>
#include <cstdint>

#include "octupole/io/vtu_writer.h"
#include "octupole/singularities/surface_singularities.h"

namespace octupole {

void WriteSingularities(const std::filesystem::path& path, const SingularCurves& curves,
                        const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<int, 3>>& surface,
                        const std::vector<int>& quarter_indices) {
  std::vector<Eigen::Vector3d> all_points;
  std::vector<int> lines, vertices;
  std::vector<std::int32_t> types, valences, numbers, num_ends, indices;
  const auto add_cell = [&](TurnType type, int valence, int number, int ends, int index) {
    types.push_back(static_cast<std::int32_t>(type));
    valences.push_back(valence);
    numbers.push_back(number);
    num_ends.push_back(ends);
    indices.push_back(index);
  };
  for (std::size_t k = 0; k < curves.curves.size(); ++k) {
    const SingularCurve& curve = curves.curves[k];
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      const auto at = static_cast<int>(all_points.size() + i);
      lines.insert(lines.end(), {at - 1, at});
      add_cell(curve.type, curve.valence, static_cast<int>(k), 0, 0);
    }
    all_points.insert(all_points.end(), curve.points.begin(), curve.points.end());
  }
  const auto add_vertex = [&](const Eigen::Vector3d& point, int ends, int index) {
    vertices.push_back(static_cast<int>(all_points.size()));
    all_points.push_back(point);
    add_cell(TurnType::kNone, 0, -1, ends, index);
  };
  for (const SingularNode& node : curves.nodes) add_vertex(node.point, node.num_ends, 0);
  for (const SingularPoint& point : SingularPoints(points, surface, quarter_indices)) {
    add_vertex(point.point, 0, point.quarter_index);
  }
  WriteVtu(
      path, all_points,
      {{VtuCellType::kLine, lines.data(), lines.size() / 2}, {VtuCellType::kVertex, vertices.data(), vertices.size()}},
      {},
      {{"type", 1, types.data()},
       {"valence", 1, valences.data()},
       {"curve", 1, numbers.data()},
       {"num_ends", 1, num_ends.data()},
       {"quarter_index", 1, indices.data()}});
}

}  // namespace octupole
