#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "fields.h"
#include "octupole/grids/surface_grid.h"
#include "octupole/grids/surface_grid_field.h"
#include "octupole/grids/surface_grid_quality.h"
#include "octupole/grids/surface_grid_sampler.h"
#include "octupole/grids/surface_grid_tets.h"
#include "octupole/grids/surface_grid_vdb.h"
#include "octupole/grids/surface_grid_writer.h"
#include "octupole/io/singularity_writer.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/singular_triangles.h"
#include "octupole/solvers/field_solver.h"
#include "surface_mesh.h"

namespace octupole::python {

template <>
struct ElementLayout<float> {
  using Scalar = float;
  static std::vector<py::ssize_t> shape() { return {}; }
  static std::vector<py::ssize_t> strides() { return {}; }
};

namespace {

struct GridField : AnyField {
  std::shared_ptr<const SurfaceMesh> surface;
  SurfaceGrid grid;
  std::vector<std::string> warnings;
  /// Made when it is first asked for; it refers to the grid and the frames of this field.
  std::shared_ptr<const GridSampler> sampler;

  const std::vector<Eigen::Matrix3d>& frames() const { return solution().frames; }
};

// Neither moves nor copies, because of the sampler.
using GridFieldPointer = std::unique_ptr<GridField>;

template <int kDegree>
Field<kDegree> SolveOnGridsUnlocked(const GridOptions& grid_options, const SolveArguments& arguments,
                                    Progress* progress, GridField* result) {
  FieldOptions<kDegree> options = OptionsFrom<kDegree>(arguments, progress);
  Field<kDegree> field;
  const auto solve = [&](const SurfaceGrid& grid, std::vector<Eigen::Matrix3d> start) {
    // The classics begin afresh on each grid.
    if (options.method == FieldMethod::kPenalty) options.start_frames = std::move(start);
    field = SolveField<kDegree>(grid.graph, options);
    {
      const py::gil_scoped_acquire locked;
      progress->ThrowError();
    }
    CheckUsable(field);
    return field.frames;
  };
  result->grid = Unlocked([&] { return SolveOnGrids(*result->surface, grid_options, solve, &result->warnings); });
  return field;
}

GridFieldPointer SolveGrid(const std::shared_ptr<SurfaceMesh>& surface, std::optional<int> resolution,
                           std::optional<double> size, int levels, const std::string& repair,
                           const SolveArguments& arguments, const py::object& callback) {
  if (resolution && size) throw std::invalid_argument("solve_grid: either resolution or size, not both");
  GridOptions options;
  options.size = size ? *size : SizeForResolution(*surface, resolution.value_or(64));
  options.levels = levels;
  options.feature_angle_deg = arguments.feature_angle;
  options.repair = HoleRepairOf(repair);
  options.num_threads = arguments.threads;
  Progress progress(callback);
  auto result = std::make_unique<GridField>();
  result->surface = surface;
  result->field = OfDegree(arguments.degree, [&](auto degree) -> std::variant<Field<3>, Field<4>> {
    return SolveOnGridsUnlocked<decltype(degree)::value>(options, arguments, &progress, result.get());
  });
  for (const std::string& warning : result->warnings) Warn(warning, 2);
  return result;
}

SingularCurves CurvesOf(const GridField& field) {
  const GridTets tets = TetsAtSingularities(field.grid, field.frames());
  return TraceSingularCurves(tets.mesh, tets.frames, FindSingularTriangles(tets.mesh, tets.frames));
}

py::tuple Tets(const GridField& field) {
  GridTets tets = Unlocked([&] { return TetsOfGrid(field.grid, field.frames()); });
  return py::make_tuple(std::make_shared<TetMesh>(std::move(tets.mesh)), ArrayOf(std::move(tets.frames)));
}

py::tuple SampleGrid(GridField& field, const py::object& points) {
  const std::vector<Eigen::Vector3d> where = PointsFrom(points, "points");
  if (!field.sampler) {
    field.sampler = Unlocked([&] { return std::make_shared<const GridSampler>(field.grid, field.frames()); });
  }
  const std::shared_ptr<const GridSampler> sampler = field.sampler;
  FieldSamples samples = Unlocked([&] { return sampler->Sample(where); });
  return py::make_tuple(ArrayOf(std::move(samples.frames)), ArrayOf(std::move(samples.is_inside)));
}

template <int kDegree>
void WriteFieldOf(const std::filesystem::path& path, const SurfaceGrid& grid, const Field<kDegree>& field) {
  WriteGridField<kDegree>(path, grid, field.coefficients, field.frames);
}

void WriteGrid(const GridField& field, const std::filesystem::path& path) {
  WithFile([&] { std::visit([&](const auto& f) { WriteFieldOf(path, field.grid, f); }, field.field); });
}

// A property that views a member of the grid.
template <typename Element>
auto ViewOfGrid(std::vector<Element> SurfaceGrid::*member) {
  return py::cpp_function(
      [member](const py::object& self) { return ViewOf(self.cast<const GridField&>().grid.*member, self); });
}

py::array HangingNodesOf(const GridField& field) {
  std::vector<std::array<int, 3>> rows;
  for (const HangingNode& hanging : field.grid.hanging_nodes) {
    rows.push_back({hanging.node, hanging.ends[0], hanging.ends[1]});
  }
  return ArrayOf(std::move(rows));
}

void AddGridQuality(py::module_* module) {
  py::class_<GridQuality>(*module, "GridQuality", "What can be said of a field on a grid.")
      .def_readonly("energy3", &GridQuality::energy3, "sum over the edges of weight times frame_difference in degree 3")
      .def_readonly("energy4", &GridQuality::energy4, "the same in degree 4; compare methods by it")
      .def_readonly(
          "boundary_rms_deg", &GridQuality::boundary_rms_deg,
          "degrees between the surface's own normal and the nearest axis, at points of the surface less than a "
          "cell apart where the normal is all that it asks of the nodes around, root mean square")
      .def_readonly("boundary_max_deg", &GridQuality::boundary_max_deg, "the largest of them")
      .def_readonly("boundary_samples", &GridQuality::boundary_samples, "how many points there are")
      .def("__repr__", [](const GridQuality& quality) {
        return "<octupole.GridQuality: energy4 " + static_cast<std::string>(py::str(py::float_(quality.energy4))) +
               ", boundary error " + static_cast<std::string>(py::str(py::float_(quality.boundary_rms_deg))) +
               " degrees>";
      });
}

void AddGridField(py::module_* module) {
  py::class_<GridField, AnyField>(*module, "GridField",
                                  R"(A frame field inside a closed surface: one frame per node of a grid of cubes.

iterations, seconds, unknowns and termination are those of the finest grid.)")
      .def_property_readonly(
          "surface", [](const GridField& field) { return std::const_pointer_cast<SurfaceMesh>(field.surface); },
          "the TriangleMesh")
      .def_property_readonly(
          "size", [](const GridField& field) { return field.grid.size; },
          "edge length of the finest cells, in the unit of the points")
      .def_property_readonly("nodes", ViewOfGrid(&SurfaceGrid::points), "(n, 3) float64: coordinates")
      .def_property_readonly(
          "cells", ViewOfGrid(&SurfaceGrid::cells),
          "(m, 8) int32: nodes in VTK's order, around the face of lowest z, then around that of highest z")
      .def_property_readonly(
          "level",
          [](const GridField& field) {
            return ArrayOf(std::vector<int>(field.grid.levels.begin(), field.grid.levels.end()));
          },
          "(m,) int32: a cell is 2**level * size wide")
      .def_property_readonly(
          "hanging_nodes", &HangingNodesOf,
          "(k, 3) int32: {v, a, b}, v being the node in the middle of a and b, which are the ends of "
          "an edge of a coarser cell, or of the diagonal of one of its faces")
      .def_property_readonly("distance", ViewOfGrid(&SurfaceGrid::distances),
                             "(n,) float32: of each node to the surface, in the unit of the points, negative inside; "
                             "deeper than three widths of the cells there, minus three widths")
      .def_property_readonly(
          "conflicts", [](const GridField& field) { return field.grid.alignment.num_conflicts; },
          "nodes that are free because several sheets of the surface pass near them whose normals no frame meets")
      .def_property_readonly(
          "separating_size", [](const GridField& field) { return field.grid.alignment.separating_size; },
          "the largest size of cells for which there would be no conflicts, or None where there are none")
      .def_readonly("warnings", &GridField::warnings,
                    "list of str: what is odd about the surface; each was a UserWarning, too")
      .def(
          "quality",
          [](const GridField& field) {
            return Unlocked([&] { return MeasureGridField(*field.surface, field.grid, field.frames()); });
          },
          R"(quality(self)
--

Its GridQuality: energies of the frames, error at the surface.)")
      .def(
          "singular_curves", [](const GridField& field) { return Unlocked([&] { return CurvesOf(field); }); },
          R"(singular_curves(self)
--

Its SingularCurves: curves with type, valence, length and ends, and the nodes where they meet.)")
      .def("tets", &Tets, R"(tets(self)
--

All cells cut into tets: a TetMesh, with a staircase for a boundary, and frames (k, 3, 3) float64, one per point of it.)")
      .def("sample", &SampleGrid, py::arg("points"), R"(sample(self, points)
--

The field anywhere. Returns frames (k, 3, 3) float64, and (k,) bool: whether a cell contains the point; cells reach up to
the width of one beyond the solid. Outside it is the frame of the nearest point of the cells.

points: (k, 3) coordinates.)")
      .def("write", &WriteGrid, py::arg("path"), R"(write(self, path)
--

Writes a .vtu file with the cells, the axes, the coefficients, the alignment, the distance and the level, as the command
octupole grid does, byte by byte. The file appears when it is complete. Raises OSError when it cannot be written.)")
      .def(
          "write_vdb",
          [](const GridField& field, const std::filesystem::path& path) {
            WithFile([&] { WriteGridVdb(path, field.grid, field.frames()); });
          },
          py::arg("path"), R"(write_vdb(self, path)
--

Writes an OpenVDB file with the grids distance, frame_x, frame_y and frame_z.)")
      .def(
          "write_singularities",
          [](const GridField& field, const std::filesystem::path& path) {
            WithFile([&] { WriteSingularities(path, CurvesOf(field), {}, {}, {}); });
          },
          py::arg("path"), R"(write_singularities(self, path)
--

Writes a .vtu file with the singular curves as lines, and their nodes as vertices.)");
}

}  // namespace

void AddGrids(py::module_* module) {
  AddGridQuality(module);
  AddGridField(module);
  module->def(
      "_solve_grid",
      [](const std::shared_ptr<SurfaceMesh>& surface, std::optional<int> resolution, std::optional<double> size,
         int levels, int degree, const std::string& method, double feature_angle, std::uint32_t seed, int starts,
         int threads, const std::string& solver, std::optional<int> max_iterations, const std::string& repair,
         const py::object& callback) {
        return SolveGrid(surface, resolution, size, levels, repair,
                         {degree, method, feature_angle, seed, starts, threads, solver, max_iterations}, callback);
      },
      py::arg("surface"), py::kw_only(), py::arg("resolution"), py::arg("size"), py::arg("levels"), py::arg("degree"),
      py::arg("method"), py::arg("feature_angle"), py::arg("seed"), py::arg("starts"), py::arg("threads"),
      py::arg("solver"), py::arg("max_iterations"), py::arg("repair"), py::arg("callback"));
}

}  // namespace octupole::python
