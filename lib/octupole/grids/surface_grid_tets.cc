#include "octupole/grids/surface_grid_tets.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "octupole/frames/frame.h"
#include "octupole/harmonics/harmonics.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Triangle = std::array<int, 3>;

// As in octahedral_group.cc: 3 - sin(45 deg)^2, with a margin for rounding.
constexpr double kWithin22Point5Degrees = 2.5001;

// Corners of a cell by their coordinates: x + 2 y + 4 z of a corner in VTK's order, which is its own inverse.
constexpr std::array<int, 8> kOrder = {0, 1, 3, 2, 4, 5, 7, 6};

class CellCutter {
 public:
  CellCutter(const SurfaceGrid& grid, const std::vector<Matrix3d>& frames) : grid_(grid), frames_(frames) {
    for (const HangingNode& hanging : grid.hanging_nodes) middle_of_[KeyOf(hanging.ends)] = hanging.node;
    number_of_.assign(grid.points.size(), -1);
  }

  void Add(const std::array<int, 8>& cell, bool only_if_singular) {
    std::array<int, 8> corners;
    for (int c = 0; c < 8; ++c) corners[c] = cell[kOrder[c]];
    triangles_.clear();
    const bool has_hanging_nodes = CutFaces(corners);
    if (only_if_singular) {
      bool is_regular = std::all_of(corners.begin(), corners.end(), [&](int v) { return IsNear(corners[0], v); });
      for (const Triangle& triangle : triangles_) {
        for (const int v : triangle) is_regular = is_regular && IsNear(corners[0], v);
      }
      if (is_regular) return;
    }
    if (has_hanging_nodes) {
      AddCone(corners);
    } else {
      AddKuhnTets(corners);
    }
  }

  GridTets result() && { return std::move(result_); }

 private:
  static std::uint64_t KeyOf(const std::array<int, 2>& ends) {
    return static_cast<std::uint64_t>(ends[0]) << 32 | static_cast<std::uint32_t>(ends[1]);
  }

  // The hanging node between two, the first that of lesser coordinates, or -1.
  int Middle(int a, int b) const {
    const auto found = middle_of_.find(KeyOf({a, b}));
    return found == middle_of_.end() ? -1 : found->second;
  }

  bool IsNear(int v, int w) const {
    return SumOfFourthPowers(frames_[v].transpose() * frames_[w]) > kWithin22Point5Degrees;
  }

  // Cuts the faces of a cell into triangles, unless it has no hanging nodes.
  bool CutFaces(const std::array<int, 8>& corners) {
    if (middle_of_.empty()) return false;
    bool found = false;
    for (int axis = 0; axis < 3 && !found; ++axis) {
      const int along = 1 << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      for (const int begin : {0, u, v, u + v}) found = found || Middle(corners[begin], corners[begin + along]) >= 0;
    }
    // A face with a node in its middle has some in the middle of its edges, too.
    if (!found) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const int along = 1 << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      for (const int side : {0, along}) {
        CutFace({corners[side], corners[side + u], corners[side + v], corners[side + u + v]});
      }
    }
    return true;
  }

  // A face with the corners (0, 0), (1, 0), (0, 1), (1, 1), along the diagonal from the first to the last, as in Kuhn's
  // tets.
  void CutFace(const std::array<int, 4>& face) {
    const auto& [low, u, v, high] = face;
    const int centre = Middle(low, high);
    if (centre >= 0) {
      const int low_u = Middle(low, u), low_v = Middle(low, v), u_high = Middle(u, high), v_high = Middle(v, high);
      for (const std::array<int, 4>& part : {std::array<int, 4>{low, low_u, low_v, centre},
                                             {low_u, u, centre, u_high},
                                             {low_v, centre, v, v_high},
                                             {centre, u_high, v_high, high}}) {
        triangles_.push_back({part[0], part[1], part[3]});
        triangles_.push_back({part[0], part[2], part[3]});
      }
      return;
    }
    for (const int corner : {u, v}) CutHalfFace(low, corner, high);
  }

  // A triangle with a right angle at its second corner, whose legs may have nodes in the middle.
  void CutHalfFace(int low, int corner, int high) {
    const int first = Middle(low, corner), second = Middle(corner, high);
    if (first < 0 && second < 0) {
      triangles_.push_back({low, corner, high});
    } else if (second < 0) {
      triangles_.push_back({low, first, high});
      triangles_.push_back({first, corner, high});
    } else if (first < 0) {
      triangles_.push_back({low, corner, second});
      triangles_.push_back({low, second, high});
    } else {
      triangles_.push_back({first, corner, second});
      triangles_.push_back({low, first, second});
      triangles_.push_back({low, second, high});
    }
  }

  int NumberOf(int node) {
    int& number = number_of_[node];
    if (number < 0) number = AddPoint(grid_.points[node], frames_[node]);
    return number;
  }

  int AddPoint(const Eigen::Vector3d& point, const Matrix3d& frame) {
    result_.mesh.points.push_back(point);
    result_.frames.push_back(frame);
    return static_cast<int>(result_.frames.size()) - 1;
  }

  void AddKuhnTets(const std::array<int, 8>& corners) {
    for (int first = 0; first < 3; ++first) {
      for (const int second : {(first + 1) % 3, (first + 2) % 3}) {
        const int b = 1 << first, c = b + (1 << second);
        result_.mesh.tets.push_back(
            {NumberOf(corners[0]), NumberOf(corners[b]), NumberOf(corners[c]), NumberOf(corners[7])});
      }
    }
  }

  void AddCone(const std::array<int, 8>& corners) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    Hexadecapole mean = Hexadecapole::Zero();
    for (const int v : corners) {
      middle += grid_.points[v] / 8;
      mean += HarmonicFromFrame<4>(frames_[v]);
    }
    const int apex = AddPoint(middle, mean.isZero(0) ? frames_[corners[0]] : NearestFrame<4>(mean));
    for (const auto& [a, b, c] : triangles_) {
      result_.mesh.tets.push_back({NumberOf(a), NumberOf(b), NumberOf(c), apex});
    }
  }

  const SurfaceGrid& grid_;
  const std::vector<Matrix3d>& frames_;
  /// Hanging nodes by the two nodes that they lie between.
  std::unordered_map<std::uint64_t, int> middle_of_;
  /// Of each node among the points of the result, or -1.
  std::vector<int> number_of_;
  /// Of the cell at hand.
  std::vector<Triangle> triangles_;
  GridTets result_;
};

GridTets CutCells(const char* caller, const SurfaceGrid& grid, const std::vector<Matrix3d>& frames,
                  bool only_if_singular) {
  if (frames.size() != grid.points.size()) {
    throw std::invalid_argument(std::string(caller) + ": " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(grid.points.size()) + " nodes");
  }
  CellCutter cutter(grid, frames);
  for (const std::array<int, 8>& cell : grid.cells) cutter.Add(cell, only_if_singular);
  return std::move(cutter).result();
}

}  // namespace

GridTets TetsAtSingularities(const SurfaceGrid& grid, const std::vector<Matrix3d>& frames) {
  return CutCells("TetsAtSingularities", grid, frames, true);
}

GridTets TetsOfGrid(const SurfaceGrid& grid, const std::vector<Matrix3d>& frames) {
  return CutCells("TetsOfGrid", grid, frames, false);
}

}  // namespace octupole
