#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "bindings.h"
#include "octupole/field/mesh_summary.h"

namespace octupole::python {
namespace {

py::dict Describe(const InnerFaces& faces) {
  using namespace py::literals;
  return py::dict("faces"_a = faces.count, "fitting_share"_a = faces.fitting_share, "followed"_a = faces.are_followed);
}

// With the keys of `octupole info --report`.
py::dict Info(const std::shared_ptr<TetMesh>& mesh) {
  using namespace py::literals;
  const MeshSummary summary = Unlocked([&] { return SummarizeMesh(*mesh); });
  const MeshInspection& inspection = summary.inspection;
  py::list regions, shells;
  for (const auto& [tag, tets] : summary.tets_of_region) regions.append(py::dict("tag"_a = tag, "tets"_a = tets));
  for (const SurfaceComponent& shell : summary.shells) {
    shells.append(py::dict("triangles"_a = shell.triangles, "euler_characteristic"_a = shell.euler_characteristic,
                           "genus"_a = shell.is_closed ? py::object(py::int_(shell.genus())) : py::none()));
  }
  std::vector<std::string> warnings = MeshWarnings(inspection);
  for (std::string& warning : InterfaceWarnings(summary.interfaces)) warnings.push_back(std::move(warning));
  return py::dict(
      "vertices"_a = summary.vertices, "edges"_a = summary.edges, "triangles"_a = summary.triangles,
      "tets"_a = inspection.tets,
      "bounding_box"_a = py::dict("min"_a = py::list(py::cast(Eigen::Vector3d(summary.bounding_box.min()))),
                                  "max"_a = py::list(py::cast(Eigen::Vector3d(summary.bounding_box.max())))),
      "regions"_a = regions, "components"_a = inspection.components,
      "boundary_triangles"_a = summary.boundary_triangles, "boundary_components"_a = shells,
      "features"_a =
          py::dict("marked_edges"_a = mesh->feature_edges.size(), "marked_points"_a = mesh->feature_points.size(),
                   "seams"_a = summary.seams, "sharp_edges"_a = summary.sharp_edges),
      "interfaces"_a = py::dict("faces"_a = summary.interfaces.triangles.size(),
                                "between_regions"_a = Describe(summary.interfaces.between_regions),
                                "tagged"_a = Describe(summary.interfaces.tagged)),
      "mean_ratio"_a = py::dict("min"_a = summary.least_mean_ratio, "mean"_a = summary.average_mean_ratio,
                                "max"_a = summary.largest_mean_ratio),
      "inverted_tets"_a = inspection.inverted_tets, "zero_volume_tets"_a = inspection.zero_volume_tets,
      "duplicate_tets"_a = inspection.duplicate_tets, "isolated_vertices"_a = inspection.isolated_vertices,
      "duplicate_vertices"_a = inspection.duplicate_vertices, "overfull_triangles"_a = inspection.overfull_triangles,
      "non_manifold_boundary_edges"_a = inspection.non_manifold_boundary_edges, "warnings"_a = warnings);
}

}  // namespace

void AddInfo(py::module_* module) {
  module->def("info", &Info, py::arg("mesh"), R"(info(mesh)
--

What a TetMesh holds and what is odd about it, as the dictionary that `octupole info --report` writes: counts, regions,
components, the boundary and its genus, features, interfaces, quality, and "warnings", a list of sentences.)");
}

}  // namespace octupole::python
