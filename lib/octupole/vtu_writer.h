#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "octupole/tet_mesh.h"

namespace octupole {

/// An array of a VTU file: a view of the caller's numbers, `components` per point, point by point.
struct VtuArray {
  std::string name;
  int components;
  std::variant<const double*, const std::int32_t*> values;
};

/// Writes a mesh and arrays on its points for ParaView: a VTU file with binary data, every bit of
/// the numbers kept. The regions, if there are any, become the cell array `region`. The file
/// appears under its name only when it is complete, see WriteFileAtomically().
///
/// \throw std::invalid_argument if an array has no values, name or components.
/// \throw std::runtime_error naming the path and the cause if the file cannot be written.
void WriteVtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<VtuArray>& point_data);

}  // namespace octupole
