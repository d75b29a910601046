#include "octupole/map_solvers/internal/map_system.h"

#include <Eigen/Core>
#include <algorithm>

namespace octupole::internal {

Vector MapSystem::Part(const Vector& y) const {
  Vector x(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) x[i] = y[free[i]];
  return x;
}

void MapSystem::PutPart(const Vector& x, Vector* y) const {
  for (std::size_t i = 0; i < free.size(); ++i) (*y)[free[i]] = x[i];
}

MapSystem MakeMapSystem(const MapDomain& domain, const Vector& y, const std::vector<bool>& is_free) {
  const MapUnknowns& unknowns = domain.unknowns;
  MapSystem system;
  std::vector<int> number(y.size(), -1);
  for (std::size_t j = 0; j < y.size(); ++j) {
    if (!is_free[j]) continue;
    number[j] = static_cast<int>(system.free.size());
    system.free.push_back(static_cast<int>(j));
  }
  const auto is_node_free = [&](int node) {
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    return std::any_of(unknowns.terms.begin() + static_cast<std::ptrdiff_t>(unknowns.begin[row]),
                       unknowns.terms.begin() + static_cast<std::ptrdiff_t>(unknowns.begin[row + 3]),
                       [&](const auto& term) { return number[term.unknown] >= 0; });
  };
  std::vector<int> node_number(domain.cut.num_nodes, -1);
  std::vector<int> old_nodes;
  for (std::size_t t = 0; t < domain.mesh.tets.size(); ++t) {
    const std::array<int, 4>& corners = domain.cut.nodes[t];
    if (std::none_of(corners.begin(), corners.end(), is_node_free)) continue;
    if (std::binary_search(domain.collapsed.begin(), domain.collapsed.end(), static_cast<int>(t))) continue;
    system.tets.push_back(static_cast<int>(t));
    std::array<int, 4>& nodes = system.nodes.emplace_back();
    for (int i = 0; i < 4; ++i) {
      int& n = node_number[corners[i]];
      if (n < 0) {
        n = static_cast<int>(old_nodes.size());
        old_nodes.push_back(corners[i]);
      }
      nodes[i] = n;
    }
  }
  system.num_nodes = old_nodes.size();
  system.begin.reserve(3 * old_nodes.size() + 1);
  system.offset.assign(3 * old_nodes.size(), 0);
  for (std::size_t n = 0; n < old_nodes.size(); ++n) {
    for (int k = 0; k < 3; ++k) {
      system.begin.push_back(system.terms.size());
      const std::size_t row = 3 * static_cast<std::size_t>(old_nodes[n]) + k;
      for (std::size_t i = unknowns.begin[row]; i < unknowns.begin[row + 1]; ++i) {
        const auto& [unknown, factor] = unknowns.terms[i];
        if (number[unknown] >= 0) {
          system.terms.push_back({number[unknown], factor});
        } else {
          system.offset[3 * n + k] += factor * y[unknown];
        }
      }
    }
  }
  system.begin.push_back(system.terms.size());
  return system;
}

std::vector<bool> FindUnknownsAround(const MapDomain& domain, const std::vector<int>& tets, int num_rings) {
  std::vector<bool> is_near(domain.mesh.points.size(), false);
  for (const int t : tets) {
    for (const int v : domain.mesh.tets[t]) is_near[v] = true;
  }
  for (int ring = 0; ring < num_rings; ++ring) {
    const std::vector<bool> was_near = is_near;
    for (const auto& tet : domain.mesh.tets) {
      if (std::none_of(tet.begin(), tet.end(), [&](int v) { return was_near[v]; })) continue;
      for (const int v : tet) is_near[v] = true;
    }
  }
  std::vector<bool> is_free(domain.unknowns.num_unknowns, true);
  for (std::size_t t = 0; t < domain.mesh.tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      if (is_near[domain.mesh.tets[t][i]]) continue;
      const std::size_t row = 3 * static_cast<std::size_t>(domain.cut.nodes[t][i]);
      for (std::size_t j = domain.unknowns.begin[row]; j < domain.unknowns.begin[row + 3]; ++j) {
        is_free[domain.unknowns.terms[j].unknown] = false;
      }
    }
  }
  return is_free;
}

CornerParameters ParametersAtCorners(const MapDomain& domain, const Vector& y) {
  const std::vector<double> u = domain.unknowns.Parameters(y);
  CornerParameters parameters(domain.mesh.tets.size());
  for (std::size_t t = 0; t < parameters.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      parameters[t][i] = Eigen::Map<const Eigen::Vector3d>(&u[3 * static_cast<std::size_t>(domain.cut.nodes[t][i])]);
    }
  }
  return parameters;
}

}  // namespace octupole::internal
