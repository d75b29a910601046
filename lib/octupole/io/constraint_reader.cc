#include "octupole/io/constraint_reader.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "octupole/readers/internal/number_rows.h"
#include "octupole/readers/internal/vtk_cells.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using internal::FailAtLine;

constexpr const char* kAxisName = "constraint_axis";
constexpr const char* kSecondAxisName = "constraint_axis_2";

// The alignment of one, two or three axes.
Alignment AlignmentOfAxes(const std::vector<Vector3d>& axes) {
  if (axes.size() == 1) return Alignment::Axis(axes[0]);
  Alignment frame = Alignment::TwoAxes(axes[0], axes[1]);
  if (axes.size() == 3) {
    // It must fit both others; the frame is that of the first two.
    Alignment::TwoAxes(axes[0], axes[2]);
    Alignment::TwoAxes(axes[1], axes[2]);
  }
  return frame;
}

std::vector<Constraint> ReadFromVtu(const std::filesystem::path& path, std::size_t num_vertices) {
  const internal::VtuContent content = internal::ReadVtuContent(path);
  const auto fail = [&](const std::string& message) { throw std::runtime_error(path.string() + ": " + message); };
  const std::size_t num_points = content.parsed.mesh.points.size();
  if (num_points != num_vertices) {
    fail(std::to_string(num_points) + " points, but the mesh has " + std::to_string(num_vertices));
  }
  const auto vectors = [&](const char* name) {
    std::vector<Vector3d> result(num_vertices, Vector3d::Zero());
    const auto found = content.point_arrays.find(name);
    if (found == content.point_arrays.end()) return result;
    const std::vector<double>& numbers = found->second;
    if (numbers.size() != 3 * num_vertices) {
      fail(std::string("the point array ") + name + " has not 3 numbers for each point");
    }
    for (std::size_t v = 0; v < num_vertices; ++v) result[v] = Eigen::Map<const Vector3d>(&numbers[3 * v]);
    return result;
  };
  if (content.point_arrays.count(kAxisName) == 0) fail(std::string("the point array ") + kAxisName + " is missing");
  const std::vector<Vector3d> first = vectors(kAxisName), second = vectors(kSecondAxisName);
  std::vector<Constraint> constraints;
  for (std::size_t v = 0; v < num_vertices; ++v) {
    if (first[v].isZero(0) && second[v].isZero(0)) continue;
    std::vector<Vector3d> axes = {first[v]};
    if (!second[v].isZero(0)) axes.push_back(second[v]);
    try {
      constraints.push_back({static_cast<int>(v), AlignmentOfAxes(axes)});
    } catch (const std::invalid_argument& error) {
      fail("point " + std::to_string(v) + ": " + error.what());
    }
  }
  return constraints;
}

}  // namespace

std::vector<Constraint> ReadConstraints(const std::filesystem::path& path, std::size_t num_vertices) {
  if (path.extension() == ".vtu") return ReadFromVtu(path, num_vertices);
  std::vector<Constraint> constraints;
  // Of each vertex the number of its constraint, and the lines of the constraints.
  std::vector<int> constraint_of(num_vertices, -1);
  std::vector<int> lines;
  internal::ForEachNumberRow(path, [&](int line, const std::vector<double>& numbers) {
    const std::size_t size = numbers.size();
    if (size != 4 && size != 7 && size != 10) {
      FailAtLine(path, line,
                 std::to_string(size) + " numbers, where a vertex and one, two or three axes have 4, 7 or 10");
    }
    std::ostringstream name;
    name << "vertex " << numbers[0];
    if (!(numbers[0] >= 0 && numbers[0] < static_cast<double>(num_vertices) && numbers[0] == std::floor(numbers[0]))) {
      FailAtLine(path, line,
                 name.str() + " is none of 0.." + std::to_string(static_cast<std::int64_t>(num_vertices) - 1));
    }
    const int vertex = static_cast<int>(numbers[0]);
    std::vector<Vector3d> axes;
    for (std::size_t i = 1; i < size; i += 3) axes.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    Constraint constraint = {vertex, {}};
    try {
      constraint.alignment = AlignmentOfAxes(axes);
    } catch (const std::invalid_argument& error) {
      FailAtLine(path, line, name.str() + ": " + error.what());
    }
    if (const int earlier = constraint_of[vertex]; earlier >= 0) {
      if (AreSame(constraints[earlier].alignment, constraint.alignment)) return;
      FailAtLine(path, line, name.str() + " has another direction in line " + std::to_string(lines[earlier]));
    }
    constraint_of[vertex] = static_cast<int>(constraints.size());
    constraints.push_back(constraint);
    lines.push_back(line);
  });
  return constraints;
}

}  // namespace octupole
