#include <string>

#include "bindings.h"
#include "fields.h"

// In place of grids.cc where the library is built without its component octupole::openvdb.
namespace octupole::python {
namespace {

struct GridField : AnyField {};
struct GridQuality {};

}  // namespace

void AddGrids(py::module_* module) {
  const char* missing = "solve_grid: this octupole was built without OpenVDB; build it with OCTUPOLE_WITH_OPENVDB=ON";
  py::class_<GridField, AnyField>(*module, "GridField", missing);
  py::class_<GridQuality>(*module, "GridQuality", missing);
  module->def("_solve_grid", [missing](const py::args& /*args*/, const py::kwargs& /*options*/) {
    PyErr_SetString(PyExc_NotImplementedError, missing);
    throw py::error_already_set();
  });
}

}  // namespace octupole::python
