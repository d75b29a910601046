#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace octupole::internal {

/// The checks that meshes of all cells have in common. What they throw begins with the name of the caller.
class MeshChecker {
 public:
  MeshChecker(std::string caller, const std::vector<Eigen::Vector3d>& points)
      : caller_(std::move(caller)), num_points_(static_cast<int>(points.size())) {
    for (int v = 0; v < num_points_; ++v) {
      for (const double x : points[v]) {
        if (!std::isfinite(x)) Fail("point " + std::to_string(v) + " has the coordinate " + std::to_string(x));
      }
    }
  }

  [[noreturn]] void Fail(const std::string& message) const { throw std::invalid_argument(caller_ + ": " + message); }

  void CheckIndex(const char* kind, std::size_t number, int index) const {
    if (index < 0 || index >= num_points_) FailAtIndex(kind, number, index);
  }

  /// That the vertices of each cell are in range and different.
  template <std::size_t kSize>
  void CheckCells(const char* kind, const std::vector<std::array<int, kSize>>& cells) const {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::array<int, kSize>& cell = cells[c];
      for (std::size_t i = 0; i < kSize; ++i) {
        CheckIndex(kind, c, cell[i]);
        for (std::size_t j = 0; j < i; ++j) {
          if (cell[i] == cell[j]) FailAtTwin(kind, c, cell[i]);
        }
      }
    }
  }

  void CheckFeatures(const std::vector<std::array<int, 2>>& edges, const std::vector<int>& points) const {
    CheckCells("feature edge", edges);
    for (std::size_t i = 0; i < points.size(); ++i) CheckIndex("feature point", i, points[i]);
  }

 private:
  // Apart from the check, which millions of cells want inlined.
  [[noreturn]] void FailAtIndex(const char* kind, std::size_t number, int index) const {
    Fail(kind + (" " + std::to_string(number)) + " has the vertex index " + std::to_string(index) +
         ", out of range 0.." + std::to_string(num_points_ - 1));
  }

  [[noreturn]] void FailAtTwin(const char* kind, std::size_t number, int index) const {
    Fail(kind + (" " + std::to_string(number)) + " has vertex " + std::to_string(index) + " twice");
  }

  std::string caller_;
  int num_points_;
};

}  // namespace octupole::internal
