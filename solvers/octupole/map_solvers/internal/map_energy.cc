#include "octupole/map_solvers/internal/map_energy.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "octupole/maps/foldover_energy.h"

namespace octupole::internal {
namespace {

constexpr std::size_t kTetGrain = 4096;

double Dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Eigen::Matrix3d Cofactors(const Eigen::Matrix3d& j) {
  Eigen::Matrix3d c;
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    for (int l = 0; l < 3; ++l) {
      const int p = (l + 1) % 3, q = (l + 2) % 3;
      c(k, l) = j(a, p) * j(b, q) - j(a, q) * j(b, p);
    }
  }
  return c;
}

double Inner(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

MapEnergy::MapEnergy(const MapDomain& domain, const MapSystem& system, double size, Workers* workers)
    : num_unknowns_(system.num_unknowns()), workers_(workers), system_(system) {
  double volume = 0;
  tets_.reserve(system.tets.size());
  for (std::size_t i = 0; i < system.tets.size(); ++i) {
    const int t = system.tets[i];
    const auto point = [&](int corner) -> const Eigen::Vector3d& {
      return domain.mesh.points[domain.mesh.tets[t][corner]];
    };
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = point(k + 1) - point(0);
    Tet tet;
    tet.nodes = system.nodes[i];
    tet.weight = std::abs(edges.determinant());
    volume += tet.weight;
    tet.gradients = size * edges.inverse();  // row i is the gradient of corner i + 1
    tet.target = domain.combed.frames[t].transpose();
    tet.jacobian.setZero();
    tet.cofactors.setZero();
    tet.direct = tet.mixed = tet.cofactor = 0;
    tets_.push_back(tet);
  }
  for (Tet& tet : tets_) tet.weight *= static_cast<double>(tets_.size()) / volume;
  determinants_.resize(tets_.size());
  u_.resize(3 * system.num_nodes);
  node_forces_.resize(u_.size());
  forces_.resize(12 * tets_.size());
  corners_begin_.assign(system.num_nodes + 1, 0);
  for (const Tet& tet : tets_) {
    for (const int n : tet.nodes) ++corners_begin_[n + 1];
  }
  for (std::size_t n = 0; n < system.num_nodes; ++n) corners_begin_[n + 1] += corners_begin_[n];
  corners_.resize(4 * tets_.size());
  std::vector<std::size_t> next(corners_begin_.begin(), corners_begin_.end() - 1);
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    for (int i = 0; i < 4; ++i) corners_[next[tets_[t].nodes[i]]++] = static_cast<int>(4 * t) + i;
  }
  rows_begin_.assign(num_unknowns_ + 1, 0);
  for (const MapUnknowns::Term& term : system.terms) ++rows_begin_[term.unknown + 1];
  for (std::size_t j = 0; j < num_unknowns_; ++j) rows_begin_[j + 1] += rows_begin_[j];
  rows_.resize(system.terms.size());
  next.assign(rows_begin_.begin(), rows_begin_.end() - 1);
  for (std::size_t row = 0; row + 1 < system.begin.size(); ++row) {
    for (std::size_t i = system.begin[row]; i < system.begin[row + 1]; ++i) {
      rows_[next[system.terms[i].unknown]++] = {static_cast<int>(row), system.terms[i].factor};
    }
  }
}

void MapEnergy::SetTargets(const std::vector<Eigen::Matrix3d>& jacobians) {
  for (std::size_t t = 0; t < tets_.size(); ++t) tets_[t].target = jacobians[system_.tets[t]];
}

void MapEnergy::SetParameters(const Vector& x, bool is_direction) {
  workers_->ForEachRange(u_.size(), kTetGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      double sum = is_direction ? 0 : system_.offset[row];
      for (std::size_t i = system_.begin[row]; i < system_.begin[row + 1]; ++i) {
        sum += system_.terms[i].factor * x[system_.terms[i].unknown];
      }
      u_[row] = sum;
    }
  });
}

Eigen::Matrix3d MapEnergy::JacobianOf(const Tet& tet) const {
  const Eigen::Map<const Eigen::Vector3d> origin(&u_[3 * static_cast<std::size_t>(tet.nodes[0])]);
  Eigen::Matrix3d edges;
  for (int i = 0; i < 3; ++i) {
    edges.col(i) = Eigen::Map<const Eigen::Vector3d>(&u_[3 * static_cast<std::size_t>(tet.nodes[i + 1])]) - origin;
  }
  return edges * tet.gradients;
}

void MapEnergy::PutForces(std::size_t t, const Eigen::Matrix3d& by_jacobian) {
  Eigen::Map<Eigen::Matrix<double, 3, 4>> forces(&forces_[12 * t]);
  forces.rightCols<3>().noalias() = by_jacobian * tets_[t].gradients.transpose();
  forces.col(0) = -(forces.col(1) + forces.col(2) + forces.col(3));
}

void MapEnergy::GatherForces(Vector* result) {
  workers_->ForEachRange(corners_begin_.size() - 1, kTetGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = corners_begin_[n]; i < corners_begin_[n + 1]; ++i) {
        sum += Eigen::Map<const Eigen::Vector3d>(&forces_[3 * static_cast<std::size_t>(corners_[i])]);
      }
      Eigen::Map<Eigen::Vector3d> force(&node_forces_[3 * n]);
      force = sum;
    }
  });
  result->resize(num_unknowns_);
  workers_->ForEachRange(num_unknowns_, kTetGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      double sum = 0;
      for (std::size_t i = rows_begin_[j]; i < rows_begin_[j + 1]; ++i) {
        sum += rows_[i].factor * node_forces_[rows_[i].unknown];
      }
      (*result)[j] = sum;
    }
  });
}

const std::vector<double>& MapEnergy::Determinants(const Vector& x) {
  SetParameters(x, false);
  workers_->ForEachRange(tets_.size(), kTetGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) determinants_[t] = JacobianOf(tets_[t]).determinant();
  });
  return determinants_;
}

double MapEnergy::EvaluateFrames(const Vector& x, Vector* gradient) {
  SetParameters(x, false);
  const double energy = workers_->Sum(tets_.size(), kTetGrain, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      Tet& tet = tets_[t];
      const Eigen::Matrix3d rest = JacobianOf(tet) - tet.target;
      sum += tet.weight * rest.squaredNorm();
      tet.direct = 2 * tet.weight;
      tet.mixed = tet.cofactor = 0;
      tet.jacobian.setZero();
      tet.cofactors.setZero();
      PutForces(t, 2 * tet.weight * rest);
    }
    return sum;
  });
  GatherForces(gradient);
  return energy;
}

double MapEnergy::EvaluateFoldovers(const Vector& x, double epsilon, Vector* gradient) {
  SetParameters(x, false);
  const double energy = workers_->Sum(tets_.size(), kTetGrain, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      Tet& tet = tets_[t];
      const Eigen::Matrix3d jacobian = JacobianOf(tet);
      const FoldoverEnergy e = EvaluateFoldoverEnergy(jacobian.squaredNorm(), jacobian.determinant(), epsilon);
      sum += tet.weight * e.energy;
      if (gradient == nullptr) continue;
      tet.jacobian = jacobian;
      tet.cofactors = Cofactors(jacobian);
      tet.direct = 2 * tet.weight * e.by_norm;
      tet.mixed = 2 * tet.weight * e.by_norm_det;
      tet.cofactor = tet.weight * e.by_det_det;
      PutForces(t, tet.direct * jacobian + tet.weight * e.by_det * tet.cofactors);
    }
    return sum;
  });
  if (gradient != nullptr) GatherForces(gradient);
  return energy;
}

void MapEnergy::Multiply(const Vector& p, Vector* product) {
  SetParameters(p, true);
  workers_->ForEachRange(tets_.size(), kTetGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Tet& tet = tets_[t];
      const Eigen::Matrix3d change = JacobianOf(tet);
      if (tet.mixed == 0 && tet.cofactor == 0) {
        PutForces(t, tet.direct * change);
        continue;
      }
      const double along = Inner(tet.jacobian, change), volume = Inner(tet.cofactors, change);
      PutForces(t, tet.direct * change + tet.mixed * volume * tet.jacobian +
                       (tet.mixed * along + tet.cofactor * volume) * tet.cofactors);
    }
  });
  GatherForces(product);
}

template <typename IsWanted, typename Use>
void MapEnergy::ForEachEntry(const Tet& tet, const IsWanted& is_wanted, const Use& use) const {
  struct Driven {
    int unknown;
    int corner;
    int axis;
    double factor;
  };
  // A corner has few terms, but it may have some from shifts.
  thread_local std::vector<Driven> driven;
  driven.clear();
  Eigen::Matrix<double, 4, 3> g;
  g.bottomRows<3>() = tet.gradients;
  g.row(0) = -tet.gradients.colwise().sum();
  const Eigen::Matrix4d dots = g * g.transpose();
  const Eigen::Matrix<double, 3, 4> along = tet.jacobian * g.transpose(), volume = tet.cofactors * g.transpose();
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t row = 3 * static_cast<std::size_t>(tet.nodes[i]) + k;
      for (std::size_t j = system_.begin[row]; j < system_.begin[row + 1]; ++j) {
        driven.push_back({system_.terms[j].unknown, i, k, system_.terms[j].factor});
      }
    }
  }
  for (const Driven& a : driven) {
    for (const Driven& b : driven) {
      if (!is_wanted(a.unknown, b.unknown)) continue;
      double entry = tet.mixed * (along(a.axis, a.corner) * volume(b.axis, b.corner) +
                                  volume(a.axis, a.corner) * along(b.axis, b.corner)) +
                     tet.cofactor * volume(a.axis, a.corner) * volume(b.axis, b.corner);
      if (a.axis == b.axis) entry += tet.direct * dots(a.corner, b.corner);
      use(a.unknown, b.unknown, a.factor * b.factor * entry);
    }
  }
}

const Vector& MapEnergy::Diagonal() {
  diagonal_.assign(num_unknowns_, 0);
  for (const Tet& tet : tets_) {
    // An unknown may drive several parameters of a tetrahedron; the sum over their pairs is what counts.
    ForEachEntry(
        tet, [](int a, int b) { return a == b; }, [&](int a, int, double entry) { diagonal_[a] += entry; });
  }
  return diagonal_;
}

Eigen::SparseMatrix<double> MapEnergy::Assemble() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * tets_.size());
  for (const Tet& tet : tets_) {
    ForEachEntry(
        tet, [](int a, int b) { return a >= b; },
        [&](int a, int b, double entry) { entries.emplace_back(a, b, entry); });
  }
  const auto n = static_cast<Eigen::Index>(num_unknowns_);
  Eigen::SparseMatrix<double> hessian(n, n);
  hessian.setFromTriplets(entries.begin(), entries.end());
  return hessian;
}

void SolveByConjugateGradients(MapEnergy* energy, const Vector& right, double tolerance, int max_iterations, Vector* x,
                               const GoesOn& goes_on) {
  const std::size_t n = right.size();
  const Vector& diagonal = energy->Diagonal();
  Vector inverse(n), residual(n), preconditioned(n), direction(n), product(n);
  for (std::size_t i = 0; i < n; ++i) inverse[i] = diagonal[i] > 0 ? 1 / diagonal[i] : 0;
  energy->Multiply(*x, &product);
  for (std::size_t i = 0; i < n; ++i) residual[i] = right[i] - product[i];
  const auto precondition = [&] {
    for (std::size_t i = 0; i < n; ++i) preconditioned[i] = inverse[i] * residual[i];
    return Dot(residual, preconditioned);
  };
  // The norm that the preconditioner makes comparable over unknowns of all sizes.
  double target = 0;
  for (std::size_t i = 0; i < n; ++i) target += inverse[i] * right[i] * right[i];
  target *= tolerance * tolerance;
  double norm = precondition();
  direction = preconditioned;
  for (int iteration = 0; iteration < max_iterations && norm > target; ++iteration) {
    energy->Multiply(direction, &product);
    const double curvature = Dot(direction, product);
    if (!(curvature > 0)) break;
    const double step = norm / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      (*x)[i] += step * direction[i];
      residual[i] -= step * product[i];
    }
    if (goes_on && !goes_on(step * norm / 2, residual)) return;
    const double previous = norm;
    norm = precondition();
    for (std::size_t i = 0; i < n; ++i) direction[i] = preconditioned[i] + norm / previous * direction[i];
  }
}

}  // namespace octupole::internal
