#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

#include "octupole/singularities/singular_curves.h"

namespace octupole {

/// Writes the singular structure of a field for ParaView, meshio and the like: the curves' segments as lines, the nodes
/// and the singular points of a surface as vertices, with the cell arrays
///  - `type`: the TurnType of a curve, else 0,
///  - `valence`: of a curve, or 0 where it has none,
///  - `curve`: its number, or -1,
///  - `num_ends`: how many curve ends meet in a node, else 0,
///  - `quarter_index`: four times the index of a surface point, else 0.
///
/// \param points, surface, quarter_indices a surface and its QuarterIndices; a singular point is drawn in the middle of
///     its triangle.
/// \throw std::invalid_argument unless there is one index per triangle.
/// \throw std::runtime_error naming path and cause when the file cannot be written; an existing one stays as it was.
void WriteSingularities(const std::filesystem::path& path, const SingularCurves& curves,
                        const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<int, 3>>& surface,
                        const std::vector<int>& quarter_indices);

}  // namespace octupole
