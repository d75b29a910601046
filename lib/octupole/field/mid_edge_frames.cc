#include "octupole/field/mid_edge_frames.h"

#include <array>
#include <stdexcept>
#include <string>

#include "octupole/frames/frame.h"

namespace octupole {

void SetMidEdgeFrames(const TetMesh& mesh, std::vector<Eigen::Matrix3d>* frames) {
  if (frames->size() != mesh.points.size()) {
    throw std::invalid_argument("SetMidEdgeFrames: " + std::to_string(frames->size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  for (const auto& [node, a, b] : mesh.mid_edge_nodes) {
    (*frames)[node] = NearestFrame<4>(HarmonicFromFrame<4>((*frames)[a]) + HarmonicFromFrame<4>((*frames)[b]));
  }
}

}  // namespace octupole
