#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

/// Frames at points, one each.
struct FieldSamples {
  std::vector<Eigen::Matrix3d> frames;
  /// 1 where a tetrahedron contains the point; 0 outside, where the frame is that of the nearest boundary point.
  std::vector<std::uint8_t> is_inside;
};

/// The field anywhere: at any point the frame nearest to the barycentric mean of the unit harmonics of degree 4 of
/// the frames around it, at the corners of the tetrahedron that contains the point, or outside at those of the
/// boundary triangle that is nearest to it. Continuous but where that mean is equally near to several frames, as at
/// singular curves, and at the vertices the frames given. Degree 4, since octupoles have signs that would have to be
/// matched first.
///
/// Tetrahedra may be inverted; flat ones contain nothing. Finds its way by trees of boxes in logarithmic time.
class FieldSampler {
 public:
  /// \param frames one rotation per point, its columns the axes.
  /// \throw std::invalid_argument when the mesh has no tetrahedra or else fails CheckTetMesh, there is not one frame
  /// per point, or one of them is no rotation.
  FieldSampler(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames);
  ~FieldSampler();

  /// Any number of threads may sample at once.
  /// \throw std::invalid_argument naming the first point that is not finite.
  FieldSamples Sample(const std::vector<Eigen::Vector3d>& points) const;

 private:
  struct Trees;
  std::unique_ptr<const Trees> trees_;
};

/// The frames of a field on one mesh at the points of another: the same ones, vertex by vertex, where both have the
/// same points, else those of a FieldSampler. For a start from an earlier field.
/// \throw std::invalid_argument as FieldSampler.
std::vector<Eigen::Matrix3d> TransferFrames(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                                            const std::vector<Eigen::Vector3d>& points);

}  // namespace octupole
