#include "octupole/field/tet_frames.h"

#include <stdexcept>
#include <string>

#include "octupole/frames/frame.h"

namespace octupole {
namespace {

// The longest sum of +-a over four octupoles; since only the frame matters, the first keeps its sign. For unit vectors
// it is not shorter than 2, the root mean square over all signs.
Octupole LongestSum(const std::array<Octupole, 4>& a) {
  Octupole longest = Octupole::Zero();
  for (int signs = 0; signs < 8; ++signs) {
    Octupole sum = a[0];
    for (int i = 0; i < 3; ++i) {
      if (signs >> i & 1) {
        sum -= a[i + 1];
      } else {
        sum += a[i + 1];
      }
    }
    if (sum.squaredNorm() > longest.squaredNorm()) longest = sum;
  }
  return longest;
}

}  // namespace

std::vector<Eigen::Matrix3d> TetFrames(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames) {
  if (frames.size() != mesh.points.size()) {
    throw std::invalid_argument("TetFrames: " + std::to_string(frames.size()) + " frames for " +
                                std::to_string(mesh.points.size()) + " points");
  }
  std::vector<Octupole> octupoles;
  octupoles.reserve(frames.size());
  for (const Eigen::Matrix3d& frame : frames) octupoles.push_back(HarmonicFromFrame<3>(frame));
  std::vector<Eigen::Matrix3d> result;
  result.reserve(mesh.tets.size());
  for (const auto& [a, b, c, d] : mesh.tets) {
    result.push_back(NearestFrame<3>(LongestSum({octupoles[a], octupoles[b], octupoles[c], octupoles[d]})));
  }
  return result;
}

}  // namespace octupole
