#include "octupole/io/field_reader.h"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "octupole/io/vtu_writer.h"
#include "octupole/readers/internal/mesh_readers.h"
#include "octupole/readers/internal/vtk_cells.h"

namespace octupole {
namespace {

using internal::VtuContent;

[[noreturn]] void Refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

const std::vector<double>* Find(const std::map<std::string, std::vector<double>>& arrays, const std::string& name,
                                std::size_t size) {
  const auto found = arrays.find(name);
  return found == arrays.end() || found->second.size() != size ? nullptr : &found->second;
}

std::vector<Eigen::Matrix3d> ReadFrames(const std::filesystem::path& path, const VtuContent& content) {
  const std::size_t num_points = content.parsed.mesh.points.size();
  std::array<const std::vector<double>*, 3> axes = {};
  for (const std::array<const char*, 3>& names :
       {std::array{"frame_x", "frame_y", "frame_z"}, std::array{"tangent_u", "tangent_v", "normal"}}) {
    for (int k = 0; k < 3; ++k) axes[k] = Find(content.point_arrays, names[k], 3 * num_points);
    if (axes[0] && axes[1] && axes[2]) break;
  }
  if (!axes[0] || !axes[1] || !axes[2]) {
    Refuse(path, "no field: the point arrays frame_x, frame_y and frame_z are missing, which 'octupole field' writes");
  }
  std::vector<Eigen::Matrix3d> frames(num_points);
  for (std::size_t v = 0; v < num_points; ++v) {
    Eigen::Matrix3d& frame = frames[v];
    for (int k = 0; k < 3; ++k) frame.col(k) = Eigen::Map<const Eigen::Vector3d>(axes[k]->data() + 3 * v);
    const double error = (frame.transpose() * frame - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    constexpr double kTolerance = 0.01, kRounding = 1e-12;
    if (!(error <= kTolerance)) Refuse(path, "the axes at point " + std::to_string(v) + " are not orthonormal");
    // Frames are left as they are to the last bit, on which matches may hang where they are ties.
    const Eigen::Vector3d normal = frame.col(2);
    const bool is_right_handed = frame.col(0).cross(frame.col(1)).dot(normal) > 0;
    if (error <= kRounding && is_right_handed) continue;
    frame.col(0).normalize();
    frame.col(1) = (frame.col(1) - frame.col(0).dot(frame.col(1)) * frame.col(0)).normalized();
    if (!is_right_handed) frame.col(1) = -frame.col(1);
    frame.col(2) = frame.col(0).cross(frame.col(1));
  }
  return frames;
}

// Calls visit(cell, its first vertex, how many) for each cell of the type.
template <typename Visit>
void ForEachCell(const VtuContent& content, VtuCellType type, const Visit& visit) {
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < content.cells.types.size(); begin = content.cells.ends[c++]) {
    if (content.cells.types[c] != static_cast<int>(type)) continue;
    visit(c, content.cells.connectivity.data() + begin, content.cells.ends[c] - begin);
  }
}

}  // namespace

FieldFile ReadField(const std::filesystem::path& path) {
  VtuContent content = internal::ReadVtuContent(path);
  FieldFile field;
  field.frames = ReadFrames(path, content);
  if (!content.parsed.mesh.tets.empty()) {
    field.tet_mesh = internal::FinishMesh(path.string(), std::move(content.parsed), nullptr);
    return field;
  }
  field.surface.points = content.parsed.mesh.points;
  ForEachCell(content, VtuCellType::kTriangle, [&](std::size_t, const std::int64_t* v, std::int64_t size) {
    if (size != 3) Refuse(path, "a triangle of " + std::to_string(size) + " vertices");
    field.surface.triangles.push_back({static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])});
  });
  if (field.surface.triangles.empty()) Refuse(path, "neither tetrahedra nor triangles");
  try {
    CheckTriangleMesh(field.surface);
  } catch (const std::invalid_argument& error) {
    Refuse(path, error.what());
  }
  return field;
}

SingularStructure ReadSingularities(const std::filesystem::path& path) {
  const VtuContent content = internal::ReadVtuContent(path);
  const std::vector<Eigen::Vector3d>& points = content.parsed.mesh.points;
  const auto array = [&](const char* name) -> const std::vector<double>& {
    const auto* found = Find(content.cell_arrays, name, content.cells.types.size());
    if (found == nullptr && content.cells.types.empty()) {
      static const std::vector<double> kNone;
      return kNone;
    }
    if (found == nullptr) {
      Refuse(path, std::string("no singular curves: the cell array ") + name +
                     " is missing, which 'octupole field "
                     "--singularities' writes");
    }
    return *found;
  };
  const auto &types = array("type"), &valences = array("valence"), &numbers = array("curve"),
             &num_ends = array("num_ends"), &indices = array("quarter_index");

  SingularStructure structure;
  ForEachCell(content, VtuCellType::kVertex, [&](std::size_t c, const std::int64_t* v, std::int64_t size) {
    if (size != 1) Refuse(path, "a vertex of " + std::to_string(size) + " points");
    if (indices[c] != 0) {
      structure.points.push_back({points[v[0]], static_cast<int>(indices[c])});
    } else {
      structure.curves.nodes.push_back({points[v[0]], static_cast<int>(num_ends[c])});
    }
  });
  double last_number = -1;
  std::int64_t last_vertex = -1;
  ForEachCell(content, VtuCellType::kLine, [&](std::size_t c, const std::int64_t* v, std::int64_t size) {
    if (size != 2) Refuse(path, "a line of " + std::to_string(size) + " points");
    std::vector<SingularCurve>& curves = structure.curves.curves;
    if (curves.empty() || numbers[c] != last_number || v[0] != last_vertex) {
      if (types[c] < 0 || types[c] > static_cast<int>(TurnType::kThird)) {
        Refuse(path, "a curve of type " + std::to_string(static_cast<int>(types[c])));
      }
      SingularCurve& curve = curves.emplace_back();
      curve.type = static_cast<TurnType>(static_cast<int>(types[c]));
      curve.valence = static_cast<int>(valences[c]);
      curve.points = {points[v[0]]};
    }
    SingularCurve& curve = curves.back();
    curve.length += (points[v[1]] - curve.points.back()).norm();
    curve.points.push_back(points[v[1]]);
    last_number = numbers[c];
    last_vertex = v[1];
  });
  for (SingularCurve& curve : structure.curves.curves) {
    if (curve.points.front() == curve.points.back()) continue;
    for (int end = 0; end < 2; ++end) {
      const Eigen::Vector3d& point = end == 0 ? curve.points.front() : curve.points.back();
      curve.ends[end] = CurveEnd::kBoundary;
      for (const SingularNode& node : structure.curves.nodes) {
        if (node.point == point) curve.ends[end] = CurveEnd::kNode;
      }
    }
  }
  return structure;
}

}  // namespace octupole
