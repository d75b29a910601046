#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "octupole/maps/combed_frames.h"
#include "octupole/maps/map_cut.h"
#include "octupole/maps/map_unknowns.h"
#include "octupole/mesh/tet_mesh.h"
#include "octupole/solvers/workers.h"

namespace octupole::internal {

using Vector = std::vector<double>;

/// Energies of a seamless map as functions of its unknowns y, with products of their Hessians, never assembled: a sum
/// over tetrahedra of functions of the Jacobian J = grad u * H, weighted by volume, 1 on average.
class MapEnergy {
 public:
  /// \param is_left_out tetrahedra that do not count.
  MapEnergy(const TetMesh& mesh, const CombedFrames& combed, const MapCut& cut, const MapUnknowns& unknowns,
            double size, std::vector<bool> is_left_out, Workers* workers);

  std::size_t num_unknowns() const { return num_unknowns_; }

  /// Unknowns that are held where they are: gradients and products are zero there.
  void Hold(std::vector<bool> is_held) { is_held_ = std::move(is_held); }

  /// The determinants of the Jacobians, 1 where volumes are kept; of those left out 1, too.
  const std::vector<double>& Determinants(const Vector& y);
  double LeastDeterminant(const Vector& y);

  /// Sum of weight |J - F^T|^2, F the frame.
  double EvaluateFrames(const Vector& y, Vector* gradient);

  /// Sum of weight times FoldoverEnergy; the gradient may be null.
  double EvaluateFoldovers(const Vector& y, double epsilon, Vector* gradient);

  /// With the Hessian of the last evaluation that had a gradient.
  void Multiply(const Vector& p, Vector* product);
  const Vector& Diagonal();

 private:
  struct Tet {
    std::array<int, 4> nodes;
    double weight;
    /// Times H, of the hat functions of corners 1, 2 and 3; that of corner 0 is minus their sum.
    Eigen::Matrix3d gradients;
    Eigen::Matrix3d frame;
    /// Hessian of the energy by J: direct I + mixed (J C^T + C J^T) + cofactor C C^T, with C the cofactors.
    Eigen::Matrix3d jacobian;
    Eigen::Matrix3d cofactors;
    double direct, mixed, cofactor;
  };

  void SetParameters(const Vector& y);
  Eigen::Matrix3d JacobianOf(const Tet& tet) const;
  void PutForces(std::size_t t, const Eigen::Matrix3d& by_jacobian);
  void GatherForces(Vector* result);

  std::size_t num_unknowns_;
  Workers* workers_;
  const MapUnknowns& unknowns_;
  std::vector<Tet> tets_;
  std::vector<std::size_t> numbers_;  // of the tets in the mesh
  std::vector<double> u_;
  std::vector<double> forces_;  // 12 per tet
  std::vector<double> node_forces_;
  std::vector<std::size_t> corners_begin_;  // of each node
  std::vector<int> corners_;
  std::vector<std::size_t> rows_begin_;  // of each unknown
  std::vector<MapUnknowns::Term> rows_;
  std::vector<double> determinants_;
  std::vector<bool> is_held_;
  Vector diagonal_;
};

/// Solves with the Hessian of `energy` for x, from x, by conjugate gradients preconditioned by the diagonal, until the
/// residual is below `tolerance` of the right-hand side. Returns the number of iterations.
int SolveByConjugateGradients(MapEnergy* energy, const Vector& right, double tolerance, int max_iterations, Vector* x);

}  // namespace octupole::internal
