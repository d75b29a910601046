#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "octupole/mesh/tet_mesh.h"

namespace octupole {

// Meshes and fields as matrices, the way libigl and NumPy hold them: one point, cell or frame per row.

/// A tet mesh from a matrix of points (n x 3) and one of tetrahedra (m x 4, indices from 0). Any expression of Eigen
/// with real numbers and with integers, of either storage order, will do: MatrixXd and MatrixXi, a Map, a Block.
///
/// The result satisfies CheckTetMesh().
/// \throw std::invalid_argument when a matrix has another number of columns, or as CheckTetMesh() does.
template <typename Points, typename Tets>
TetMesh TetMeshFromMatrices(const Eigen::MatrixBase<Points>& points, const Eigen::MatrixBase<Tets>& tets) {
  static_assert(std::numeric_limits<typename Tets::Scalar>::is_integer, "the tetrahedra are indices");
  const auto check = [](const char* what, Eigen::Index columns, Eigen::Index expected) {
    if (columns == expected) return;
    std::ostringstream message;
    message << "TetMeshFromMatrices: the matrix of " << what << " has " << columns << " columns, not " << expected;
    throw std::invalid_argument(message.str());
  };
  check("points", points.cols(), 3);
  check("tetrahedra", tets.cols(), 4);
  TetMesh mesh;
  mesh.points.resize(points.rows());
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    for (int k = 0; k < 3; ++k) mesh.points[v][k] = static_cast<double>(points(v, k));
  }
  mesh.tets.resize(tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int i = 0; i < 4; ++i) {
      // What does not fit into an int is out of range, and must not wrap around into it.
      const auto index = tets(t, i);
      mesh.tets[t][i] = static_cast<int>(index);
      if (static_cast<typename Tets::Scalar>(mesh.tets[t][i]) == index && (mesh.tets[t][i] < 0) == (index < 0))
        continue;
      std::ostringstream message;
      message << "TetMeshFromMatrices: tetrahedron " << t << " has the vertex index " << index;
      throw std::invalid_argument(message.str());
    }
  }
  CheckTetMesh(mesh);
  return mesh;
}

/// The same from plain arrays: x, y, z of one point after the other, and four indices of one tetrahedron after the
/// other.
template <typename Scalar, typename Index>
TetMesh TetMeshFromArrays(const Scalar* points, std::size_t num_points, const Index* tets, std::size_t num_tets) {
  using Points = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using Tets = Eigen::Matrix<Index, Eigen::Dynamic, 4, Eigen::RowMajor>;
  return TetMeshFromMatrices(Eigen::Map<const Points>(points, static_cast<Eigen::Index>(num_points), 3),
                             Eigen::Map<const Tets>(tets, static_cast<Eigen::Index>(num_tets), 4));
}

/// One row per frame: its axes x, y and z, one after the other (n x 9); `leftCols(3)` are the x axes.
inline Eigen::MatrixXd MatrixFromFrames(const std::vector<Eigen::Matrix3d>& frames) {
  Eigen::MatrixXd rows(frames.size(), 9);
  for (std::size_t v = 0; v < frames.size(); ++v) rows.row(v) = frames[v].reshaped().transpose();
  return rows;
}

}  // namespace octupole
