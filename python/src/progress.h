#pragma once

#include <ceres/iteration_callback.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>

namespace octupole::python {

namespace py = pybind11;

/// What a solver without Python's lock asks of Python at each iteration: whether Ctrl-C was pressed, now and then, and
/// the caller's callback(iteration, energy, seconds), which stops the solver, and those that follow, by returning
/// something true.
class Progress final : public ceres::IterationCallback {
 public:
  explicit Progress(py::object callback) : callback_(std::move(callback)), is_silent_(callback_.is_none()) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (is_stopped_) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    const auto now = std::chrono::steady_clock::now();
    if (is_silent_ && now - last_look_ < kInterval) return ceres::SOLVER_CONTINUE;
    last_look_ = now;
    const py::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (is_silent_) return ceres::SOLVER_CONTINUE;
      is_stopped_ = py::bool_(callback_(summary.iteration, 2 * summary.cost, summary.cumulative_time_in_seconds));
      return is_stopped_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    } catch (...) {
      error_ = std::current_exception();
      return ceres::SOLVER_ABORT;
    }
  }

  /// Throws, with Python's lock, what stopped the solver.
  void ThrowError() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr std::chrono::milliseconds kInterval{50};

  py::object callback_;
  bool is_silent_;
  bool is_stopped_ = false;
  std::chrono::steady_clock::time_point last_look_ = std::chrono::steady_clock::now();
  std::exception_ptr error_;
};

}  // namespace octupole::python
