#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace octupole::python {

namespace py = pybind11;

void AddMathematics(py::module_* module);
void AddMeshes(py::module_* module);
void AddFields(py::module_* module);
void AddInfo(py::module_* module);
void AddMaps(py::module_* module);

/// Calls what reads or writes a file, without Python's lock. What is wrong with the file becomes an OSError.
template <typename Function>
auto WithFile(Function&& function) {
  try {
    const py::gil_scoped_release unlocked;
    return std::forward<Function>(function)();
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
  throw py::error_already_set();
}

/// Calls what computes for long, without Python's lock.
template <typename Function>
auto Unlocked(Function&& function) {
  const py::gil_scoped_release unlocked;
  return std::forward<Function>(function)();
}

}  // namespace octupole::python
