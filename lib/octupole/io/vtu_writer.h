#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// An array of a VTU file: a view of the caller's numbers, `components` per point or cell, one after the other.
struct VtuArray {
  std::string name;
  int components;
  std::variant<const double*, const std::int32_t*> values;
};

/// Kinds of cells, by VTK's numbers.
enum class VtuCellType : std::uint8_t { kVertex = 1, kLine = 3, kTriangle = 5, kTet = 10, kHexahedron = 12 };

/// Cells of one kind: a view of the caller's indices of points, 1, 2, 3, 4 or 8 per cell, cell by cell.
struct VtuCells {
  VtuCellType type;
  const int* vertices;
  std::size_t count;
};

/// Writes points, cells and arrays on them for ParaView, meshio and the like: a VTU file with binary data, compressed
/// with zlib, every bit of the numbers kept. Cells and their data are in the order of `cells`. The file appears under
/// its name only when it is complete, see WriteFileAtomically().
///
/// \throw std::invalid_argument if an array has no name or components, or points or cells but no values, or if the
/// index
///     of a point is out of range.
/// \throw std::runtime_error naming the path and the cause if the file cannot be written.
void WriteVtu(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
              const std::vector<VtuCells>& cells, const std::vector<VtuArray>& point_data,
              const std::vector<VtuArray>& cell_data);

/// The tetrahedra of a mesh.
VtuCells CellsOf(const TetMesh& mesh);

/// The same for the tetrahedra of a mesh. The regions, if there are any, become the cell array `region`.
void WriteVtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<VtuArray>& point_data);

}  // namespace octupole
