#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_arrays.h"
#include "octupole/mesh/mesh_inspection.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/mesh/triangle_mesh.h"
#include "octupole/readers/tet_mesh_reader.h"
#include "surface_mesh.h"
#ifdef OCTUPOLE_WITH_OPENMESH
#include "octupole/adaptors/triangle_mesh_reader.h"
#endif

namespace octupole::python {
namespace {

template <typename Index>
TetMesh TetsFrom(const Reals& points, const py::array& tets) {
  const Integers<Index> indices = Integers<Index>::ensure(tets);
  return Unlocked([&] { return TetMeshFromArrays(points.data(), points.shape(0), indices.data(), indices.shape(0)); });
}

template <typename Mesh>
void SetFeatures(const py::object& feature_edges, const py::object& feature_points, Mesh* mesh) {
  if (!feature_edges.is_none()) mesh->feature_edges = RowsFrom<2>(feature_edges, "feature_edges");
  if (!feature_points.is_none()) mesh->feature_points = ValuesFrom(feature_points, "feature_points");
}

std::shared_ptr<TetMesh> MakeTetMesh(const py::object& points, const py::object& tets, const py::object& regions,
                                     const py::object& feature_edges, const py::object& feature_points) {
  const Reals coordinates = RealsFrom(points, "points");
  CheckShape(coordinates, "points", {3}, /*is_list=*/true);
  const py::array indices = IntegersFrom(tets, "tets");
  if (indices.size() == 0) throw std::invalid_argument("tets: there are none");
  CheckShape(indices, "tets", {4}, /*is_list=*/true);
  const bool is_narrow = indices.dtype().kind() == 'i' && indices.itemsize() == 4;
  const bool is_unsigned = indices.dtype().kind() == 'u';
  auto mesh = std::make_shared<TetMesh>(is_narrow     ? TetsFrom<std::int32_t>(coordinates, indices)
                                        : is_unsigned ? TetsFrom<std::uint64_t>(coordinates, indices)
                                                      : TetsFrom<std::int64_t>(coordinates, indices));
  if (!regions.is_none()) mesh->regions = ValuesFrom(regions, "regions");
  SetFeatures(feature_edges, feature_points, mesh.get());
  // Points and tets have been checked already, which takes a while on millions.
  if (!mesh->regions.empty() || !mesh->feature_edges.empty() || !mesh->feature_points.empty()) CheckTetMesh(*mesh);
  return mesh;
}

// A mesh with other regions or features, and all else as it was.
std::shared_ptr<TetMesh> Replaced(const TetMesh& mesh, const py::object& regions, const py::object& feature_edges) {
  auto copy = std::make_shared<TetMesh>(mesh);
  if (!regions.is_none()) copy->regions = ValuesFrom(regions, "regions");
  SetFeatures(feature_edges, py::none(), copy.get());
  CheckTetMesh(*copy);
  return copy;
}

// Each triangle is a face.
void NumberFaces(SurfaceMesh* mesh) {
  mesh->faces.resize(mesh->triangles.size());
  std::iota(mesh->faces.begin(), mesh->faces.end(), 0);
}

std::shared_ptr<SurfaceMesh> MakeTriangleMesh(const py::object& points, const py::object& triangles,
                                              const py::object& feature_edges, const py::object& feature_points) {
  auto mesh = std::make_shared<SurfaceMesh>();
  mesh->points = PointsFrom(points, "points");
  mesh->triangles = RowsFrom<3>(triangles, "triangles");
  SetFeatures(feature_edges, feature_points, mesh.get());
  CheckTriangleMesh(*mesh);
  NumberFaces(mesh.get());
  return mesh;
}

std::shared_ptr<SurfaceMesh> BoundaryOf(const TetMesh& mesh) {
  auto surface = std::make_shared<SurfaceMesh>();
  static_cast<TriangleMesh&>(*surface) = Unlocked([&] { return BoundarySurface(mesh); });
  NumberFaces(surface.get());
  return surface;
}

std::shared_ptr<TetMesh> Read(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  auto mesh = WithFile([&] { return std::make_shared<TetMesh>(ReadTetMesh(path, &warnings)); });
  for (const std::string& warning : warnings) Warn(path.string() + ": " + warning, 1);
  return mesh;
}

#ifdef OCTUPOLE_WITH_OPENMESH
std::shared_ptr<SurfaceMesh> ReadSurface(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  auto mesh = std::make_shared<SurfaceMesh>();
  WithFile([&] { static_cast<TriangleMesh&>(*mesh) = ReadTriangleMesh(path, &warnings, &mesh->faces); });
  for (const std::string& warning : warnings) Warn(path.string() + ": " + warning, 1);
  return mesh;
}
#endif

// A property that views a member of a mesh.
template <typename Mesh, typename Base, typename Element>
auto View(std::vector<Element> Base::*member) {
  return py::cpp_function([member](const py::object& self) { return ViewOf(self.cast<const Mesh&>().*member, self); });
}

}  // namespace

void AddMeshes(py::module_* module) {
  py::class_<TetMesh, std::shared_ptr<TetMesh>>(
      *module, "TetMesh",
      R"(TetMesh(points, tets, *, regions=None, feature_edges=None, feature_points=None)
--

A tetrahedral mesh; what solve() is given as arrays, checked and copied once.

points: (n, 3) coordinates, in any unit of length.
tets: (m, 4) indices of points, from 0; either orientation.
regions: (m,) integers, the material of each tet.
feature_edges: (k, 2) pairs of points, edges of the mesh that the field is to follow. If there are any, no others are
    searched for.
feature_points: (k,) points that are marked as corners.
Its arrays are read-only views.
Raises ValueError naming the first value that is wrong, TypeError for arrays of another kind.)")
      .def(py::init(&MakeTetMesh), py::arg("points"), py::arg("tets"), py::kw_only(), py::arg("regions") = py::none(),
           py::arg("feature_edges") = py::none(), py::arg("feature_points") = py::none())
      .def_property_readonly("points", View<TetMesh>(&TetMesh::points), "(n, 3) float64: coordinates")
      .def_property_readonly("tets", View<TetMesh>(&TetMesh::tets), "(m, 4) int32: indices of points")
      .def_property_readonly("regions", View<TetMesh>(&TetMesh::regions), "(m,) int32, or (0,) where there are none")
      .def_property_readonly("feature_edges", View<TetMesh>(&TetMesh::feature_edges), "(k, 2) int32")
      .def_property_readonly("feature_points", View<TetMesh>(&TetMesh::feature_points), "(k,) int32")
      .def_property_readonly("surface_triangles", View<TetMesh>(&TetMesh::surface_triangles),
                             "(k, 3) int32: triangles that the file tags as parts of surfaces")
      .def_property_readonly("surface_tags", View<TetMesh>(&TetMesh::surface_tags), "(k,) int32: their tags")
      .def_property_readonly("mid_edge_nodes", View<TetMesh>(&TetMesh::mid_edge_nodes),
                             "(k, 3) int32: {v, a, b}, v being the node between a and b of second-order tets")
      .def("boundary_surface", &BoundaryOf, R"(boundary_surface(self)
--

Its boundary as a TriangleMesh on the same points, for solve_surface() or solve_grid().)")
      .def("_replaced", &Replaced, py::arg("regions"), py::arg("feature_edges"))
      .def("__repr__", [](const TetMesh& mesh) {
        return "<octupole.TetMesh: " + std::to_string(mesh.points.size()) + " points, " +
               std::to_string(mesh.tets.size()) + " tets>";
      });

  py::class_<SurfaceMesh, std::shared_ptr<SurfaceMesh>>(
      *module, "TriangleMesh",
      R"(TriangleMesh(points, triangles, *, feature_edges=None, feature_points=None)
--

A surface of triangles, open or closed; what solve_surface() is given as arrays.

points: (n, 3) coordinates.
triangles: (m, 3) indices of points, from 0; neighbours are expected to be oriented alike.
feature_edges, feature_points: as of TetMesh.
Raises ValueError naming the first value that is wrong, TypeError for arrays of another kind.)")
      .def(py::init(&MakeTriangleMesh), py::arg("points"), py::arg("triangles"), py::kw_only(),
           py::arg("feature_edges") = py::none(), py::arg("feature_points") = py::none())
      .def_property_readonly("points", View<SurfaceMesh>(&SurfaceMesh::points), "(n, 3) float64: coordinates")
      .def_property_readonly("triangles", View<SurfaceMesh>(&SurfaceMesh::triangles), "(m, 3) int32: indices of points")
      .def_property_readonly("feature_edges", View<SurfaceMesh>(&SurfaceMesh::feature_edges), "(k, 2) int32")
      .def_property_readonly("feature_points", View<SurfaceMesh>(&SurfaceMesh::feature_points), "(k,) int32")
      .def_property_readonly("faces", View<SurfaceMesh>(&SurfaceMesh::faces),
                             "(m,) int32: the polygon, of those in the file, that each triangle was cut from")
      .def("__repr__", [](const SurfaceMesh& mesh) {
        return "<octupole.TriangleMesh: " + std::to_string(mesh.points.size()) + " points, " +
               std::to_string(mesh.triangles.size()) + " triangles>";
      });

  module->def("read", &Read, py::arg("path"), R"(read(path)
--

The TetMesh of a file: Medit .mesh, Gmsh .msh, VTK .vtu and .vtk, TetGen .node or .ele, OpenVolumeMesh .ovm, .tet.
What is left out of the file is a UserWarning.

Raises OSError "path:line: what is wrong".)");
#ifdef OCTUPOLE_WITH_OPENMESH
  module->def("read_surface", &ReadSurface, py::arg("path"), R"(read_surface(path)
--

The TriangleMesh of an .obj, .off, .stl or .ply file. Polygons are cut into triangles. What is odd is a UserWarning.

Raises OSError saying what is wrong.)");
#endif
  module->def(
      "box_mesh",
      [](const std::array<int, 3>& cells, const std::array<double, 3>& size) {
        return Unlocked([&] {
          return std::make_shared<TetMesh>(MakeBoxMesh(cells, Eigen::Map<const Eigen::Vector3d>(size.data())));
        });
      },
      py::arg("cells"), py::arg("size") = std::array<double, 3>{1, 1, 1}, R"(box_mesh(cells, size=(1.0, 1.0, 1.0))
--

The TetMesh of the box [0, size]: a grid of cells along x, y and z, each cut into six tets.)");
}

}  // namespace octupole::python
