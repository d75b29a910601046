#include "bindings.h"
#include "octupole/version.h"

PYBIND11_MODULE(_core, module) {
  pybind11::options options;
  options.disable_function_signatures();  // docstrings begin with one that inspect.signature understands
  module.doc() = "What is compiled of octupole; import octupole instead.";
  module.attr("__version__") = octupole::kVersion;
  octupole::python::AddMathematics(&module);
  octupole::python::AddMeshes(&module);
  octupole::python::AddFields(&module);
  octupole::python::AddGrids(&module);
  octupole::python::AddInfo(&module);
  octupole::python::AddMaps(&module);
}
