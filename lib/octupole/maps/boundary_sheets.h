#pragma once

#include <array>
#include <vector>

#include "octupole/maps/combed_frames.h"
#include "octupole/mesh/edge_rings.h"
#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// The boundary, divided into the sheets that a map flattens: on each face the parameter of the axis nearest to the
/// normal is constant, and on a sheet all those are one. Faces are of one sheet across an edge at which the outward
/// axis goes on as it is.
struct BoundarySheets {
  struct Face {
    int tet;
    /// Opposite the face.
    int corner;
    /// The axis of the tetrahedron's frame that points outward, and its sign.
    int axis;
    int sign;
    int sheet;
  };
  struct Sheet {
    double area = 0;
    /// Its parameters are not held constant.
    bool is_released = false;
  };
  /// An edge where two sheets of one parameter meet at less than a straight angle: it and all between them would be
  /// squeezed flat.
  struct Wedge {
    std::array<int, 2> vertices;
    double angle_deg;
    int released_sheet;
  };

  std::vector<Face> faces;
  std::vector<Sheet> sheets;
  std::vector<Wedge> wedges;
};

/// Finds the sheets, and releases at each wedge, from the sharpest to the bluntest, the sheet of the smaller area,
/// unless one of the two is released already.
/// \param mesh satisfies CheckTetMesh(), all its tetrahedra of positive volume.
BoundarySheets FindBoundarySheets(const TetMesh& mesh, const MatchedFrames& matched, const EdgeRings& rings);

}  // namespace octupole
