#pragma once

#include <array>
#include <set>
#include <vector>

#include "octupole/maps/combed_frames.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The boundary and the interfaces inside, divided into the sheets that a map flattens: on each face the parameter of
/// the axis nearest to the normal is constant, and on a sheet all those are one. Faces are of one sheet across an edge
/// at which the outward axis goes on as it is.
struct BoundarySheets {
  struct Face {
    /// Of an interface, one of the two.
    int tet;
    /// Opposite the face.
    int corner;
    /// The axis of the tetrahedron's frame that points outward, and its sign.
    int axis;
    int sign;
    int sheet;
    /// No parameter is held constant on it: its sheet is released, or one of its vertices.
    bool is_released;
  };
  struct Sheet {
    double area = 0;
    /// No parameter is held constant on it, because of a wedge.
    bool is_released = false;
  };
  /// An edge where two sheets of one parameter meet at less than a straight angle: it and all between them would be
  /// squeezed flat.
  struct Wedge {
    std::array<int, 2> vertices;
    double angle_deg;
    int released_sheet;
  };
  /// A corner of less than a right angle in a sheet, whose two creases run along one parameter, so that it has angle 0
  /// in the map, which squeezes the sheet there. Such is the tip of a rib whose slope is of one sheet with the plate.
  struct FlatCorner {
    int vertex;
    double angle_deg;
    /// From the vertex on along the bend where the sheet beyond its one crease goes on into that beyond the other.
    std::vector<int> bend;
  };

  std::vector<Face> faces;
  std::vector<Sheet> sheets;
  std::vector<Wedge> wedges;
  std::vector<FlatCorner> flat_corners;
  /// Edges at which the outward axes of the two sides differ, neither of which is released.
  std::vector<std::array<int, 2>> creases;
};

/// Finds the sheets, and releases at each wedge, from the sharpest to the bluntest, the sheet of the smaller area,
/// unless one of the two is released already. Faces at released vertices are sheets of their own.
/// \param mesh satisfies CheckTetMesh(), all its tetrahedra of positive volume.
/// \param is_interface of the face opposite each corner, whether it is one inside; the same on both of its sides.
/// \param released_vertices whose faces hold no parameter constant.
BoundarySheets FindBoundarySheets(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings,
                                  const std::vector<std::array<bool, 4>>& is_interface,
                                  const std::set<int>& released_vertices);

}  // namespace octupole
