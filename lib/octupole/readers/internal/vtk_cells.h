#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {

/// The cells of an unstructured grid as both kinds of VTK files have them.
struct VtkCells {
  std::vector<int> types;
  /// Where each cell ends in the connectivity.
  std::vector<std::int64_t> ends;
  std::vector<std::int64_t> connectivity;
  /// One region tag per cell, or empty.
  std::vector<int> regions;
  bool with_other_volumes = false;
};

/// A VTU file with the arrays on its points and cells.
struct VtuContent {
  ParsedMesh parsed;
  /// Those of all pieces, counting from the first point of all. Without regions.
  VtkCells cells;
  /// The arrays of numbers by name, component after component.
  std::map<std::string, std::vector<double>> point_arrays;
  std::map<std::string, std::vector<double>> cell_arrays;
};

/// \throw std::runtime_error "path:line: message", as the readers.
VtuContent ReadVtuContent(const NamedText& file);
VtuContent ReadVtuContent(const std::filesystem::path& path);

/// Adds the tetrahedra among the cells and what the others mark: lines and points are features, triangles with a tag
/// parts of surfaces. The connectivity counts from `first_point`, behind which all points of the mesh are the cells'.
///
/// `fail` throws a message about an entry of the connectivity.
void AddVtkCells(const VtkCells& cells, std::size_t first_point,
                 const std::function<void(std::int64_t entry, const std::string& message)>& fail, ParsedMesh* result);

}  // namespace octupole::internal
