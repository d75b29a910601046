#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "octupole/alignment/boundary_alignment.h"
#include "octupole/field/field_graph.h"
#include "octupole/mesh/triangle_mesh.h"

namespace octupole {

// The component octupole::openvdb: a field from a surface alone (docs/grids.md).

/// What to do about a surface that is open.
enum class HoleRepair : std::uint8_t {
  kNone,   ///< refuse it
  kClose,  ///< close each hole with a cap, triangles from its border to its middle, that does not align the field
};

/// "none" or "close". \throw std::invalid_argument naming them for another name.
HoleRepair HoleRepairOf(const std::string& name);

struct GridOptions {
  /// Of the finest cells.
  double size = 0;
  /// Cells have the sizes `size`, 2 size, ..., 2^(levels - 1) size. The finest are those that the surface runs through
  /// and their siblings, the others as large as neighbours that differ by two at most allow. With one level the grid is
  /// uniform.
  int levels = 1;
  /// Cells are the finest near these points, too: the singular curves of a coarser grid's field, for example. Those
  /// within `size` along each coordinate.
  std::vector<Eigen::Vector3d> fine_points;
  /// As in AlignToSurface.
  double feature_angle_deg = 40;
  HoleRepair repair = HoleRepair::kNone;
  int num_threads = 1;
  /// No grid is made that, with SolveFast, would need more bytes (see ForecastGrid); by default what the system says is
  /// available.
  std::optional<double> max_bytes;
};

/// A node of a grid in the middle of an edge of a coarser cell, or of the diagonal of one of its faces, from the corner
/// with the least coordinates to that with the largest.
struct HangingNode {
  int node;
  std::array<int, 2> ends;
};

/// How the surface aligns the nodes near it.
struct GridAlignment : AlignmentCounts {
  std::size_t num_feature_edges = 0;
  bool has_marked_features = false;
  /// Of num_free, the nodes near which several sheets of the surface pass whose normals no frame meets, as in a wall or
  /// a gap thinner than two cells; and the largest size of cells for which none of these nodes would see two sheets.
  std::size_t num_conflicts = 0;
  std::optional<double> separating_size;
};

/// A solid as a grid of cubes in which its surface is immersed: the cells that meet the solid, of several sizes, cells
/// that touch differing by a factor of at most two.
struct SurfaceGrid {
  /// The size of the finest cells.
  double size = 0;
  /// Cells of width s lie at multiples of s from here.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /// The nodes, corners of cells.
  std::vector<Eigen::Vector3d> points;
  /// Of each node to the surface, negative inside; deeper than three widths of the cells there, minus three widths.
  std::vector<float> distances;
  /// Corners in VTK's order: around the face of lowest z, then around that of highest z.
  std::vector<std::array<int, 8>> cells;
  /// Of each cell, which is 2^level size wide.
  std::vector<std::uint8_t> levels;
  std::vector<HangingNode> hanging_nodes;
  /// The nodes, edges between nodes of a cell, and what the surface asks of the nodes near it.
  ///
  /// A cell of width s gives each of its 12 edges the weight s / (4 size), so that the cells around an inner edge of
  /// the finest give it 1. Where smaller cells touch it, it has edges to their nodes, too (CellSprings). Then for
  /// linear u the sum of w |u(b) - u(a)|^2 over the edges is the integral of |grad u|^2 over the cells, divided by
  /// `size`, and the sum of w (u(b) - u(a)) over the edges of an inner node is zero, whatever the levels: on smooth
  /// fields, neither the energy nor its minimum depends on them.
  FieldGraph graph;
  GridAlignment alignment;
};

/// How large a grid will be, roughly: within 30 % where the solid is many cells wide everywhere.
struct GridForecast {
  double nodes;
  /// For making it and for SolveFast.
  double bytes;
};

/// \throw std::invalid_argument as MakeGrid, but takes open surfaces.
GridForecast ForecastGrid(const TriangleMesh& surface, const GridOptions& options);

/// A grid of the solid that a closed surface bounds, and its alignment with the surface.
///
/// The surface may intersect itself, and its triangles may have either orientation, lie twice or be flat. The solid is
/// what cannot be reached from outside. A shell inside another is a cavity if it is oriented against that; otherwise
/// its inside belongs to the solid, too.
///
/// Nodes within 0.9 `size` of the surface are aligned by the rule of AlignToSurface, the projectors of the normals
/// being averaged over the surface near the node: by area, falling linearly with the distance. Edges that the surface
/// marks align the nodes near them, too; those that are sharp where no frame fits. Theory: Yu. Nesterenko, *Spectral
/// boundary conditions*, arXiv 2309.13477.
///
/// \param warnings receives a line about each thing that is odd.
/// \throw std::invalid_argument when the surface fails CheckTriangleMesh, or is open and not to be closed; when the
/// size is not positive and finite, the levels are not from 1 to 8, the angle is not between 0 and 180, or no cell
/// meets the solid. \throw std::length_error when the grid would need more memory than max_bytes.
SurfaceGrid MakeGrid(const TriangleMesh& surface, const GridOptions& options,
                     std::vector<std::string>* warnings = nullptr);

/// The size of `resolution` cells along the longest side of the surface's bounding box.
/// \throw std::invalid_argument when the resolution is below 1 or the surface fails CheckTriangleMesh.
double SizeForResolution(const TriangleMesh& surface, int resolution);

}  // namespace octupole
