#include "octupole/io/field_reader.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/field/alignment.h"
#include "octupole/io/internal/mesh_readers.h"

namespace octupole {

FieldFile ReadField(const std::filesystem::path& path) {
  constexpr const char* kNames[] = {"frame_x", "frame_y"};
  internal::ParsedMesh parsed = internal::ReadAnyMesh(path, {kNames[0], kNames[1]});
  for (const char* name : kNames) {
    if (parsed.vectors.count(name) > 0) continue;
    throw std::runtime_error(path.string() + ": this is no field: the point array " + name + " is missing");
  }
  FieldFile field;
  const std::vector<Eigen::Vector3d>& x = parsed.vectors[kNames[0]];
  const std::vector<Eigen::Vector3d>& y = parsed.vectors[kNames[1]];
  field.frames.reserve(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    try {
      field.frames.push_back(Alignment::TwoAxes(x[v], y[v]).frame());
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(path.string() + ": the frame of point " + std::to_string(v) + ": " + error.what());
    }
  }
  field.mesh = internal::FinishMesh(path.string(), std::move(parsed), nullptr);
  return field;
}

}  // namespace octupole
