#include "octupole/readers/internal/vtk_cells.h"

#include <algorithm>
#include <utility>

namespace octupole::internal {
namespace {

/// VTK's numbers of the cells that are read. Corners come first in those of higher order.
enum VtkType {
  kVertex = 1,
  kPolyVertex = 2,
  kLine = 3,
  kPolyLine = 4,
  kTriangle = 5,
  kTet = 10,
  kQuadraticLine = 21,
  kQuadraticTriangle = 22,
  kQuadraticTet = 24,
  kBiquadraticTriangle = 34,
  kCubicLine = 35,
  kLagrangeLine = 68,
  kLagrangeTriangle = 69,
  kLagrangeTet = 71,
  kBezierLine = 75,
  kBezierTriangle = 76,
  kBezierTet = 78
};

/// The plural of cells that are left out.
const char* OtherCells(int type) {
  switch (type) {
    case kTriangle:
    case 6:  // a strip
    case kQuadraticTriangle:
    case kBiquadraticTriangle:
    case kLagrangeTriangle:
    case kBezierTriangle:
      return kTriangles;
    case 8:
    case 9:
    case 23:
    case 28:
    case 30:
    case 70:
    case 77:
      return kQuadrilaterals;
    case 11:
    case 12:
    case 25:
    case 29:
    case 33:
    case 72:
    case 79:
      return kHexahedra;
    case 13:
    case 26:
    case 31:
    case 32:
    case 73:
    case 80:
      return kPrisms;
    case 14:
    case 27:
    case 37:
    case 74:
    case 81:
      return kPyramids;
    case 15:
    case 16:
    case 41:
    case 42:
      return kPolyhedra;
    default:
      return "cells of other types";
  }
}

bool IsTet(int type) { return type == kTet || type == kQuadraticTet || type == kLagrangeTet || type == kBezierTet; }

}  // namespace

void AddVtkCells(const VtkCells& cells, std::size_t first_point,
                 const std::function<void(std::int64_t entry, const std::string& message)>& fail, ParsedMesh* result) {
  TetMesh& mesh = result->mesh;
  const auto num_points = static_cast<std::int64_t>(mesh.points.size() - first_point);
  const auto index_of = [&](std::int64_t entry) {
    const std::int64_t index = cells.connectivity[entry];
    if (index < 0 || index >= num_points) {
      fail(entry, "vertex index " + std::to_string(index) + " is out of range 0.." + std::to_string(num_points - 1));
    }
    return static_cast<int>(first_point + index);
  };
  const std::size_t num_tets = std::count_if(cells.types.begin(), cells.types.end(), IsTet);
  mesh.tets.reserve(num_tets);
  if (!cells.regions.empty()) mesh.regions.reserve(num_tets);
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < cells.types.size(); begin = cells.ends[c++]) {
    const std::int64_t size = cells.ends[c] - begin;
    const int type = cells.types[c];
    const auto check_size = [&](const char* kind, std::int64_t least, std::int64_t most) {
      if (size < least || size > most) {
        fail(begin,
             std::string(kind) + " of " + std::to_string(size) + " vertices instead of " + std::to_string(least));
      }
    };
    switch (type) {
      case kTet:
      case kQuadraticTet:
      case kLagrangeTet:
      case kBezierTet: {
        const bool is_of_any_order = type == kLagrangeTet || type == kBezierTet;
        const int least = type == kQuadraticTet ? 10 : 4;
        check_size("a tetrahedron", least, is_of_any_order ? size : least);
        std::array<int, 4> tet;
        for (int i = 0; i < 4; ++i) {
          tet[i] = index_of(begin + i);
          for (int j = 0; j < i; ++j) {
            if (tet[i] == tet[j]) {
              fail(begin + i, "a tetrahedron has vertex " + std::to_string(cells.connectivity[begin + i]) + " twice");
            }
          }
        }
        mesh.tets.push_back(tet);
        if (size == 10) {
          for (int i = 0; i < 6; ++i) {
            const auto [a, b] = kVtkMidEdges[i];
            mesh.mid_edge_nodes.push_back({index_of(begin + 4 + i), tet[a], tet[b]});
          }
        } else {
          result->curved_tets += size > 4;
        }
        if (!cells.regions.empty()) {
          mesh.regions.push_back(cells.regions[c]);
        }
        break;
      }
      case kTriangle:
      case kQuadraticTriangle:
      case kBiquadraticTriangle:
      case kLagrangeTriangle:
      case kBezierTriangle:
        ++result->other_cells[kTriangles];
        check_size("a triangle", 3, type == kTriangle ? 3 : size);
        // Without a tag it marks nothing.
        if (!cells.regions.empty()) {
          mesh.surface_triangles.push_back({index_of(begin), index_of(begin + 1), index_of(begin + 2)});
          mesh.surface_tags.push_back(cells.regions[c]);
        }
        break;
      case kVertex:
      case kPolyVertex:
        for (std::int64_t i = begin; i < cells.ends[c]; ++i) {
          mesh.feature_points.push_back(index_of(i));
        }
        break;
      case kLine:
      case kPolyLine:
        check_size("a line", 2, type == kLine ? 2 : size);
        for (std::int64_t i = begin; i + 1 < cells.ends[c]; ++i) {
          mesh.feature_edges.push_back({index_of(i), index_of(i + 1)});
        }
        break;
      case kQuadraticLine:
      case kCubicLine:
      case kLagrangeLine:
      case kBezierLine:
        check_size("a line", 2, size);
        mesh.feature_edges.push_back({index_of(begin), index_of(begin + 1)});
        break;
      default: {
        const char* kind = OtherCells(type);
        ++result->other_cells[kind];
        if (const int num_corners = NumVolumeCorners(kind); num_corners > 0 && cells.with_other_volumes) {
          check_size(kind, num_corners, size);
          std::array<int, 8>& corners = result->other_volumes.emplace_back();
          corners.fill(-1);
          for (int i = 0; i < num_corners; ++i) corners[i] = index_of(begin + i);
        }
      }
    }
  }
}

}  // namespace octupole::internal
