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
void AddGrids(py::module_* module);
void AddInfo(py::module_* module);
void AddMaps(py::module_* module);

/// One of Python's warnings, or an exception where the user has made it one.
/// \param stack_level 1 where the user calls what is compiled, 2 where octupole/__init__.py does.
inline void Warn(const std::string& text, int stack_level) {
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), stack_level) != 0) throw py::error_already_set();
}

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
