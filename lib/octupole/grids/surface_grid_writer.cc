#include "octupole/grids/surface_grid_writer.h"

#include <cstdint>

#include "octupole/io/field_writer.h"

namespace octupole {

template <int kDegree>
void WriteGridField(const std::filesystem::path& path, const SurfaceGrid& grid,
                    const std::vector<Harmonic<kDegree>>& coefficients, const std::vector<Eigen::Matrix3d>& frames) {
  const std::vector<double> distances(grid.distances.begin(), grid.distances.end());
  const std::vector<std::int32_t> levels(grid.levels.begin(), grid.levels.end());
  WriteField<kDegree>(path, grid.points, {{VtuCellType::kHexahedron, grid.cells[0].data(), grid.cells.size()}},
                      coefficients, frames, grid.graph.alignments, {{"distance", 1, distances.data()}},
                      {{"level", 1, levels.data()}});
}

template void WriteGridField<3>(const std::filesystem::path&, const SurfaceGrid&, const std::vector<Harmonic<3>>&,
                                const std::vector<Eigen::Matrix3d>&);
template void WriteGridField<4>(const std::filesystem::path&, const SurfaceGrid&, const std::vector<Harmonic<4>>&,
                                const std::vector<Eigen::Matrix3d>&);

}  // namespace octupole
