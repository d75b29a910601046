#pragma once

#include <Eigen/Core>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Gives each mid-edge node of a second-order mesh the mean of the frames at the ends of its edge: the frame nearest to
/// the mean of their unit harmonics of degree 4. This mean is never zero, since the cosine between two such harmonics
/// is at least -13/27. All other frames stay as they are.
/// \param mesh satisfies CheckTetMesh().
/// \throw std::invalid_argument unless there is one frame per point.
void SetMidEdgeFrames(const TetMesh& mesh, std::vector<Eigen::Matrix3d>* frames);

}  // namespace octupole
