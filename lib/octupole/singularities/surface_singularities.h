#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace octupole {

/// A connected part of a surface: triangles that are joined by edges which exactly two of them have.
struct SurfaceComponent {
  std::size_t triangles = 0;
  /// Vertices - edges + triangles. A vertex at which the component touches itself counts once for each fan around it.
  int euler_characteristic = 0;
  /// Whether every edge has a triangle on both sides.
  bool is_closed = true;
  /// The number of its handles, where it is closed.
  int genus() const { return (2 - euler_characteristic) / 2; }
  /// Whether at every vertex an axis of the frame is within a degree of the MeanNormal.
  bool is_normal = true;
  /// Four times the sum of the indices of its triangles; where the component is closed, four times the Euler
  /// characteristic, whatever the frames.
  int quarter_index_sum = 0;
};

/// The cross field that frames leave on a triangle surface.
struct SurfaceSingularities {
  /// Four times the index of each triangle: 0, but for singular points; 1 where a curve of valence 3 ends, -1 for 5.
  std::vector<int> quarter_indices;
  /// The component of each triangle.
  std::vector<int> component_of;
  std::vector<SurfaceComponent> components;
};

/// The singular points of the cross field that frames leave on a surface, whatever its shape and sharp edges.
///
/// All is measured within the surface (Ray, Vallet, Li, Levy, N-symmetry direction field design, 2008; the connection
/// as in Knoeppel, Crane, Pinkall, Schroeder, Globally optimal direction fields, 2013): directions at a vertex are
/// angles in the fan of triangles around it, scaled to 2 pi where it is closed. The cross at a vertex is given by the
/// direction in the fan that is nearest to one of the six directions of the frame's axes: a tangent where the surface
/// is smooth, the edge itself where the frame follows a sharp one. With t the angle by which it turns along an edge,
/// taken between -45 and 45 degrees, the index of a triangle is the sum of its three t and of its scaled corner angles,
/// less pi, over 2 pi: a multiple of 1/4. Over a closed surface the t cancel, and the scaled angles sum to the Euler
/// characteristic.
///
/// Triangles may have either orientation. An edge of one triangle, or of more than two, bounds the surface. The corners
/// of an open fan keep their angles. Vertices of no triangle do not count.
///
/// \param frames one rotation per point, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per point and all vertices of triangles are points.
SurfaceSingularities FindSurfaceSingularities(const std::vector<Eigen::Vector3d>& points,
                                              const std::vector<std::array<int, 3>>& triangles,
                                              const std::vector<Eigen::Matrix3d>& frames);

/// The quarter_indices of FindSurfaceSingularities.
std::vector<int> QuarterIndices(const std::vector<Eigen::Vector3d>& points,
                                const std::vector<std::array<int, 3>>& triangles,
                                const std::vector<Eigen::Matrix3d>& frames);

/// A singular point of a surface, in the middle of its triangle.
struct SingularPoint {
  Eigen::Vector3d point;
  /// Four times its index, not 0.
  int quarter_index = 0;
};

/// The singular points that QuarterIndices tell of.
/// \throw std::invalid_argument unless there is one index per triangle.
std::vector<SingularPoint> SingularPoints(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles,
                                          const std::vector<int>& quarter_indices);

}  // namespace octupole
