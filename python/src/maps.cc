#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "octupole/io/map_writer.h"
#include "octupole/map_solvers/seamless_map.h"
#include "octupole/maps/map_obstacles.h"
#include "octupole/maps/map_quality.h"
#include "progress.h"

namespace octupole::python {

template <>
struct ElementLayout<std::array<Eigen::Vector3d, 4>> {
  using Scalar = double;
  static std::vector<py::ssize_t> shape() { return {4, 3}; }
  static std::vector<py::ssize_t> strides() { return {sizeof(Eigen::Vector3d), sizeof(double)}; }
};

namespace {

std::shared_ptr<SeamlessMap> SolveMap(const std::shared_ptr<TetMesh>& mesh, const py::object& frames,
                                      std::optional<double> size, bool integer, int max_iterations, int threads,
                                      const std::shared_ptr<SeamlessMap>& start, const py::object& callback) {
  const std::vector<Eigen::Matrix3d> rotations = FramesFrom(frames, "frames");
  Progress progress(callback);
  MapOptions options;
  if (size) {
    if (!(*size > 0)) throw std::invalid_argument("size: " + std::to_string(*size) + " is not positive");
    options.size = *size;
  }
  options.integer = integer;
  options.max_iterations = max_iterations;
  options.num_threads = threads;
  if (start) options.start = MeshMap{start->domain.mesh, start->parameters};
  options.callback = &progress;
  auto map = Unlocked([&] { return std::make_shared<SeamlessMap>(SolveSeamlessMap(*mesh, rotations, options)); });
  progress.ThrowError();
  return map;
}

py::dict Quality(const SeamlessMap& map) {
  using namespace py::literals;
  const MapQuality quality = Unlocked([&] { return MeasureMap(map.domain.mesh, map.parameters, map.size); });
  return py::dict("flipped"_a = quality.flipped, "flipped_volume"_a = quality.flipped_volume,
                  "parameter_volume"_a = quality.parameter_volume, "stretch_5"_a = quality.stretch_5,
                  "stretch_95"_a = quality.stretch_95);
}

std::vector<std::string> Obstacles(const SeamlessMap& map) {
  std::vector<std::string> lines;
  for (const MapObstacle& obstacle : FindObstacles(map.domain, map.flipped, map.parameters))
    lines.push_back(obstacle.Describe());
  return lines;
}

void WriteMap(const SeamlessMap& map, const std::filesystem::path& path) {
  WithFile([&] {
    if (path.extension() == ".hexex") {
      WriteHexEx(path, map.domain.mesh, map.parameters);
    } else if (path.extension() == ".vtu") {
      WriteMapVtu(path, map.domain.mesh, map.domain.cut, map.parameters);
    } else {
      throw std::invalid_argument(path.string() + ": the name of a map ends in .hexex or .vtu");
    }
  });
}

}  // namespace

void AddMaps(py::module_* module) {
  py::class_<SeamlessMap, std::shared_ptr<SeamlessMap>>(*module, "SeamlessMap",
                                                        "Three parameters for each corner of each tet of a mesh.")
      .def_property_readonly(
          "mesh",
          [](const std::shared_ptr<SeamlessMap>& map) { return std::shared_ptr<TetMesh>(map, &map->domain.mesh); },
          "TetMesh: the one given, with some tets split where they had to be")
      .def_property_readonly(
          "parameters", [](const py::object& self) { return ViewOf(self.cast<const SeamlessMap&>().parameters, self); },
          "(m, 4, 3) float64, in units of size: of tet t and its corner i the three parameters")
      .def_readonly("size", &SeamlessMap::size, "the length that one unit of a parameter stands for")
      .def_property_readonly(
          "flipped", [](const py::object& self) { return ViewOf(self.cast<const SeamlessMap&>().flipped, self); },
          "(k,) int32: tets that the map turns over or flattens")
      .def_property_readonly(
          "is_valid", [](const SeamlessMap& map) { return map.flipped.empty(); }, "whether there are none of them")
      .def_readonly("is_integer_grid", &SeamlessMap::is_integer_grid,
                    "whether all is whole, too, and the boundary held everywhere")
      .def("quality", &Quality, R"(quality(self)
--

A dictionary: "flipped" tets and "flipped_volume", their share; "parameter_volume", the number of hexahedra that an integer map
stands for; "stretch_5" and "stretch_95", percentiles of the lengths on the map over those asked for.)")
      .def("obstacles", &Obstacles, R"(obstacles(self)
--

A list of sentences about what stands in the way of the map, the largest of each kind first.)")
      .def("write", &WriteMap, py::arg("path"), R"(write(self, path)
--

Writes a .hexex file, for libHexEx, or a .vtu file. Raises OSError if it cannot be written.)")
      .def("__repr__", [](const SeamlessMap& map) {
        return "<octupole.SeamlessMap: " + std::to_string(map.parameters.size()) + " tets, " +
               std::to_string(map.flipped.size()) + " flipped>";
      });
  module->def(
      "seamless_map", &SolveMap, py::arg("mesh"), py::arg("frames"), py::kw_only(), py::arg("size") = py::none(),
      py::arg("integer") = false, py::arg("max_iterations") = 200, py::arg("threads") = 1,
      py::arg("start") = py::none(), py::arg("callback") = py::none(),
      R"(seamless_map(mesh, frames, *, size=None, integer=False, max_iterations=200, threads=1, start=None, callback=None)
--

A seamless map that follows a frame field: parameters whose gradients are the frames' axes over `size`, that go on across
every inner face up to a rotation of the cube and a shift, and of which one is constant on each face of the boundary.

mesh: a TetMesh.
frames: (n, 3, 3), one rotation per point with the axes as columns, such as the frames of solve().
size: the edge length of hexahedra; None for twice the mean edge length of the mesh.
integer: an integer-grid map, rounded greedily; see docs/maps.md for how often that succeeds.
max_iterations: of the search for a map that turns no tet over.
start: an earlier map of the mesh to begin with, whatever its size.
callback: as of solve(); the energy is that of the least squares first, then the foldover-free one.

Ctrl-C raises KeyboardInterrupt. Raises ValueError naming what is wrong.)");
}

}  // namespace octupole::python
