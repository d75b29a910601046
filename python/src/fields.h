#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "bindings.h"
#include "octupole/alignment/constraints.h"
#include "octupole/solvers/field_solver.h"
#include "progress.h"

namespace octupole::python {

/// A solution of either degree: what Python calls a GraphField, and the base of all fields.
struct AnyField {
  std::variant<Field<3>, Field<4>> field;

  const FrameSolution& solution() const {
    return std::visit([](const auto& f) -> const FrameSolution& { return f; }, field);
  }
  const std::vector<Alignment>& alignments() const {
    return std::visit([](const auto& f) -> const std::vector<Alignment>& { return f.alignment.alignments; }, field);
  }
};

struct SolveArguments {
  int degree;
  std::string method;
  double feature_angle;
  std::uint32_t seed;
  int starts;
  int threads;
  std::string solver;
  std::optional<int> max_iterations;
  // What only some of those who solve have, as it is for the others.
  /// None, a TetField, or an array of frames or of coefficients.
  py::object start = py::none();
  std::string boundary = "aligned";
  std::string weights = "uniform";
  /// Whether surfaces inside the mesh align the field; if nothing is said, the library decides.
  std::optional<bool> follow_regions = std::nullopt;
  std::vector<Constraint> constraints = {};
};

/// All of the arguments but the start. \throw std::invalid_argument for unknown names.
template <int kDegree>
FieldOptions<kDegree> OptionsFrom(const SolveArguments& arguments, Progress* progress);

/// \throw std::runtime_error saying why the solver failed, if it did.
template <int kDegree>
void CheckUsable(const Field<kDegree>& field) {
  if (field.IsUsable()) return;
  throw std::runtime_error("the solver failed: " +
                           (field.ceres_summary ? field.ceres_summary->message : "the energy is not finite"));
}

/// Calls `solve` with the degree, 3 or 4, as a type. \throw std::invalid_argument for another degree.
template <typename Function>
auto OfDegree(int degree, const Function& solve) {
  if (degree == 3) return solve(std::integral_constant<int, 3>());
  if (degree == 4) return solve(std::integral_constant<int, 4>());
  throw std::invalid_argument("degree: 3 or 4 expected, not " + std::to_string(degree));
}

}  // namespace octupole::python
