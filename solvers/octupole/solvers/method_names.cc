#include "octupole/solvers/method_names.h"

#include <map>
#include <stdexcept>

namespace octupole {
namespace {

const std::map<std::string, FieldMethod> kMethods = {{"penalty", FieldMethod::kPenalty},
                                                     {"ray-sokolov", FieldMethod::kRaySokolov},
                                                     {"huang", FieldMethod::kHuang},
                                                     {"mbo", FieldMethod::kMbo}};
const std::map<std::string, std::optional<SolverPreset>> kSolvers = {{"fast", std::nullopt},
                                                                     {"cholesky", SolverPreset::kSparseCholesky},
                                                                     {"cgnr", SolverPreset::kConjugateGradients},
                                                                     {"lbfgs", SolverPreset::kLbfgs}};
const std::map<std::string, OpenBoundary> kBoundaries = {{"aligned", OpenBoundary::kAligned},
                                                         {"free", OpenBoundary::kFree}};
const std::map<std::string, EdgeWeights> kEdgeWeights = {{"uniform", EdgeWeights::kUniform},
                                                         {"fem", EdgeWeights::kFiniteElement}};

template <typename Value>
Value ValueOf(const char* what, const std::map<std::string, Value>& values, const std::string& name) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::string names;
  for (const auto& [known, value] : values) names += (names.empty() ? "" : ", ") + known;
  throw std::invalid_argument(std::string(what) + ": '" + name + "' is none of " + names);
}

}  // namespace

FieldMethod FieldMethodOf(const std::string& name) { return ValueOf("method", kMethods, name); }

std::string NameOf(FieldMethod method) {
  for (const auto& [name, value] : kMethods) {
    if (value == method) return name;
  }
  return "";
}

std::optional<SolverPreset> SolverPresetOf(const std::string& name) { return ValueOf("solver", kSolvers, name); }

OpenBoundary OpenBoundaryOf(const std::string& name) { return ValueOf("boundary", kBoundaries, name); }

EdgeWeights EdgeWeightsOf(const std::string& name) { return ValueOf("weights", kEdgeWeights, name); }

}  // namespace octupole
