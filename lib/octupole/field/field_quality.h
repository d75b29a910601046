#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "octupole/field/field_graph.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/singularities/singular_triangles.h"

namespace octupole {

/// How far the axes are from the normals of a surface.
struct NormalErrors {
  /// Smooth vertices: those at which all normals of incident triangles are within 35 degrees of each other and no such
  /// triangle has zero area.
  std::size_t smooth_vertices = 0;
  /// Over these the angle in degrees between the angle-weighted normal and the nearest axis.
  double rms_deg = 0;
  double max_deg = 0;
};

/// \param frames one rotation per point, its columns the axes.
/// \param triangles neighbours oriented alike, such as BoundaryTriangles or those of Interfaces.
/// \param num_measured the points to be measured, the first: all, if not given.
/// \throw std::invalid_argument unless there is one frame per point.
NormalErrors MeasureNormals(const std::vector<Eigen::Vector3d>& points,
                            const std::vector<std::array<int, 3>>& triangles,
                            const std::vector<Eigen::Matrix3d>& frames,
                            std::optional<std::size_t> num_measured = std::nullopt);

/// What can be said of a field of frames on a tet mesh without knowing how it was computed. The same numbers for any
/// method and any degree, so fields can be compared by them.
struct FieldQuality {
  std::size_t edges = 0;
  /// Sum over the mesh's edges of FrameDifference<3> and FrameDifference<4>.
  double energy3 = 0;
  double energy4 = 0;
  /// The NormalErrors of the boundary.
  double boundary_rms_deg = 0;
  double boundary_max_deg = 0;
  std::size_t smooth_boundary_vertices = 0;
  /// Triangles that a singular curve crosses, see FindSingularTriangles: all, and those of each TurnType.
  std::size_t singular_triangles = 0;
  std::array<std::size_t, 5> singular_triangles_of_type = {};
};

/// \param frames one rotation per point, its columns the axes.
/// \throw std::invalid_argument unless there is one frame per point.
FieldQuality MeasureField(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames);

/// The same for a caller who has the singular triangles (FindSingularTriangles) and BoundaryTriangles already.
FieldQuality MeasureField(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames,
                          const std::vector<SingularTriangle>& singular_triangles,
                          const std::vector<std::array<int, 3>>& boundary_triangles);

/// The sum over edges of weight times FrameDifference<kDegree>. \param edges between indices into `frames`.
template <int kDegree>
double SmoothnessOfFrames(const std::vector<WeightedEdge>& edges, const std::vector<Eigen::Matrix3d>& frames);

/// The sum over the mesh's edges of EdgeWeights::kFiniteElement times FrameDifference<4>, in units of length:
/// comparable across meshes of one shape, but for the cores of singular curves, whose energy grows with the logarithm
/// of the resolution. \throw std::invalid_argument unless there is one frame per point.
double FiniteElementEnergy(const TetMesh& mesh, const std::vector<Eigen::Matrix3d>& frames);

/// How well the frame of each vertex fits its neighbours', the energy's density: the mean of FrameDifference<3> over
/// the edges at the vertex, 0 where there are none. \param edges pairs of indices into `frames`.
std::vector<double> MeanDifferences(const std::vector<std::array<int, 2>>& edges,
                                    const std::vector<Eigen::Matrix3d>& frames);

}  // namespace octupole
