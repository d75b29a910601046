#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "octupole/grids/surface_grid.h"

namespace octupole::internal {

/// The number of the node at a point of the lattice of the finest cells, or -1.
using NodeAt = std::function<int(const Eigen::Vector3i&)>;

/// A function of a point on a triangle, in the lattice's coordinates, and of the area that it stands for.
using SurfaceSample = std::function<void(const Eigen::Vector3d&, double)>;

/// Samples lie this close when a surface is averaged, in widths of the lattice.
inline constexpr double kSampleSpacing = 0.4;

/// Cuts a triangle until no side is longer than `spacing`, and samples the parts in the middle.
void SampleTriangle(const std::array<Eigen::Vector3d, 3>& corners, double spacing, const SurfaceSample& sample);

/// What the surface asks of the nodes near it; see MakeGrid. The separating size is in widths of the lattice.
/// \param points of the surface, in the lattice's coordinates.
GridAlignment AlignGrid(const TriangleMesh& surface, const std::vector<Eigen::Vector3d>& points,
                        double feature_angle_deg, const NodeAt& node_at, std::vector<Alignment>* alignments);

}  // namespace octupole::internal
