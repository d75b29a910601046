#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "octupole/map_solvers/internal/map_system.h"
#include "octupole/maps/map_domain.h"
#include "octupole/minimization/workers.h"

namespace octupole::internal {

/// Energies of a part of a seamless map as functions of its unknowns, with products of their Hessians: a sum over
/// tetrahedra of functions of the Jacobian J = grad u * H, weighted by volume, 1 on average.
class MapEnergy {
 public:
  /// \param system outlives it.
  MapEnergy(const MapDomain& domain, const MapSystem& system, double size, Workers* workers);

  std::size_t num_unknowns() const { return num_unknowns_; }
  std::size_t num_tets() const { return tets_.size(); }

  /// The determinants of the Jacobians of the system's tetrahedra, 1 where volumes are kept.
  const std::vector<double>& Determinants(const Vector& x);

  /// What EvaluateFrames draws the Jacobians to: by default the frames, F^T. In the order of the domain's tetrahedra.
  void SetTargets(const std::vector<Eigen::Matrix3d>& jacobians);

  /// Sum of weight |J - target|^2.
  double EvaluateFrames(const Vector& x, Vector* gradient);

  /// Sum of weight times FoldoverEnergy; the gradient may be null.
  double EvaluateFoldovers(const Vector& x, double epsilon, Vector* gradient);

  /// With the Hessian of the last evaluation that had a gradient.
  void Multiply(const Vector& p, Vector* product);
  const Vector& Diagonal();
  /// The Hessian itself, its lower triangle.
  Eigen::SparseMatrix<double> Assemble() const;

 private:
  struct Tet {
    std::array<int, 4> nodes;
    double weight;
    /// Times H, of the hat functions of corners 1, 2 and 3; that of corner 0 is minus their sum.
    Eigen::Matrix3d gradients;
    Eigen::Matrix3d target;
    /// Hessian of the energy by J: direct I + mixed (J C^T + C J^T) + cofactor C C^T, with C the cofactors.
    Eigen::Matrix3d jacobian;
    Eigen::Matrix3d cofactors;
    double direct, mixed, cofactor;
  };

  // u = A x, plus the offset unless it is a direction.
  void SetParameters(const Vector& x, bool is_direction);
  Eigen::Matrix3d JacobianOf(const Tet& tet) const;
  void PutForces(std::size_t t, const Eigen::Matrix3d& by_jacobian);
  void GatherForces(Vector* result);
  // Calls `use` with pairs of unknowns that a tetrahedron couples, as far as they are wanted, and the Hessian's entry.
  template <typename IsWanted, typename Use>
  void ForEachEntry(const Tet& tet, const IsWanted& is_wanted, const Use& use) const;

  std::size_t num_unknowns_;
  Workers* workers_;
  const MapSystem& system_;
  std::vector<Tet> tets_;
  std::vector<double> u_;
  std::vector<double> forces_;  // 12 per tet
  std::vector<double> node_forces_;
  std::vector<std::size_t> corners_begin_;  // of each node
  std::vector<int> corners_;
  std::vector<std::size_t> rows_begin_;  // of each unknown
  std::vector<MapUnknowns::Term> rows_;
  std::vector<double> determinants_;
  Vector diagonal_;
};

/// After an iteration: by how much x H x / 2 - right x has fallen, and the residual; false ends.
using GoesOn = std::function<bool(double gain, const Vector& residual)>;

/// Solves with the Hessian H of `energy` for x, from x, by conjugate gradients preconditioned by the diagonal, until
/// the residual is below `tolerance` of the right-hand side.
void SolveByConjugateGradients(MapEnergy* energy, const Vector& right, double tolerance, int max_iterations, Vector* x,
                               const GoesOn& goes_on = nullptr);

}  // namespace octupole::internal
