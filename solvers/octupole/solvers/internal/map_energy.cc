#include "octupole/solvers/internal/map_energy.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "octupole/maps/foldover_energy.h"

namespace octupole::internal {
namespace {

constexpr std::size_t kGrain = 4096;

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

MapEnergy::MapEnergy(const TetMesh& mesh, const CombedFrames& combed, const MapCut& cut, const MapUnknowns& unknowns,
                     double size, std::vector<bool> is_left_out, Workers* workers)
    : num_unknowns_(unknowns.num_unknowns), workers_(workers), unknowns_(unknowns) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (is_left_out[t]) continue;
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = mesh.points[mesh.tets[t][i + 1]] - mesh.points[mesh.tets[t][0]];
    Tet tet;
    tet.nodes = cut.nodes[t];
    tet.weight = std::abs(edges.determinant());
    volume += tet.weight;
    tet.gradients = size * edges.inverse();  // row i is the gradient of corner i + 1
    tet.frame = combed.frames[t].transpose();
    tet.jacobian.setZero();
    tet.cofactors.setZero();
    tet.direct = tet.mixed = tet.cofactor = 0;
    tets_.push_back(tet);
    numbers_.push_back(t);
  }
  for (Tet& tet : tets_) tet.weight *= static_cast<double>(tets_.size()) / volume;
  determinants_.assign(mesh.tets.size(), 1);
  u_.resize(3 * static_cast<std::size_t>(cut.num_nodes));
  node_forces_.resize(u_.size());
  forces_.resize(12 * tets_.size());
  corners_begin_.assign(cut.num_nodes + 1, 0);
  for (const Tet& tet : tets_) {
    for (const int n : tet.nodes) ++corners_begin_[n + 1];
  }
  for (int n = 0; n < cut.num_nodes; ++n) corners_begin_[n + 1] += corners_begin_[n];
  corners_.resize(4 * tets_.size());
  std::vector<std::size_t> next(corners_begin_.begin(), corners_begin_.end() - 1);
  for (std::size_t t = 0; t < tets_.size(); ++t) {
    for (int i = 0; i < 4; ++i) corners_[next[tets_[t].nodes[i]]++] = static_cast<int>(4 * t) + i;
  }
  rows_begin_.assign(num_unknowns_ + 1, 0);
  for (const MapUnknowns::Term& term : unknowns.terms) ++rows_begin_[term.unknown + 1];
  for (std::size_t j = 0; j < num_unknowns_; ++j) rows_begin_[j + 1] += rows_begin_[j];
  rows_.resize(unknowns.terms.size());
  next.assign(rows_begin_.begin(), rows_begin_.end() - 1);
  for (std::size_t row = 0; row + 1 < unknowns.begin.size(); ++row) {
    for (std::size_t i = unknowns.begin[row]; i < unknowns.begin[row + 1]; ++i) {
      rows_[next[unknowns.terms[i].unknown]++] = {static_cast<int>(row), unknowns.terms[i].factor};
    }
  }
  is_held_.assign(num_unknowns_, false);
}

void MapEnergy::SetParameters(const Vector& y) {
  workers_->ForEachRange(u_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      double sum = 0;
      for (std::size_t i = unknowns_.begin[row]; i < unknowns_.begin[row + 1]; ++i) {
        sum += unknowns_.terms[i].factor * y[unknowns_.terms[i].unknown];
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
  workers_->ForEachRange(corners_begin_.size() - 1, kGrain, [&](std::size_t begin, std::size_t end) {
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
  workers_->ForEachRange(num_unknowns_, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      double sum = 0;
      for (std::size_t i = rows_begin_[j]; i < rows_begin_[j + 1]; ++i) {
        sum += rows_[i].factor * node_forces_[rows_[i].unknown];
      }
      (*result)[j] = is_held_[j] ? 0 : sum;
    }
  });
}

const std::vector<double>& MapEnergy::Determinants(const Vector& y) {
  SetParameters(y);
  workers_->ForEachRange(tets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) determinants_[numbers_[t]] = JacobianOf(tets_[t]).determinant();
  });
  return determinants_;
}

double MapEnergy::LeastDeterminant(const Vector& y) {
  const auto& determinants = Determinants(y);
  return *std::min_element(determinants.begin(), determinants.end());
}

double MapEnergy::EvaluateFrames(const Vector& y, Vector* gradient) {
  SetParameters(y);
  const double energy = workers_->Sum(tets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) {
      Tet& tet = tets_[t];
      const Eigen::Matrix3d rest = JacobianOf(tet) - tet.frame;
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

double MapEnergy::EvaluateFoldovers(const Vector& y, double epsilon, Vector* gradient) {
  SetParameters(y);
  const double energy = workers_->Sum(tets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
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
  SetParameters(p);
  workers_->ForEachRange(tets_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
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

const Vector& MapEnergy::Diagonal() {
  diagonal_.assign(num_unknowns_, 0);
  // An unknown may drive several parameters of a tetrahedron; the sum over their pairs is what counts.
  struct Driven {
    int unknown;
    int corner;
    int axis;
    double factor;
  };
  std::vector<Driven> driven;
  for (const Tet& tet : tets_) {
    Eigen::Matrix<double, 4, 3> g;
    g.bottomRows<3>() = tet.gradients;
    g.row(0) = -tet.gradients.colwise().sum();
    const Eigen::Matrix<double, 3, 4> along = tet.jacobian * g.transpose(), volume = tet.cofactors * g.transpose();
    driven.clear();
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t row = 3 * static_cast<std::size_t>(tet.nodes[i]) + k;
        for (std::size_t j = unknowns_.begin[row]; j < unknowns_.begin[row + 1]; ++j) {
          driven.push_back({unknowns_.terms[j].unknown, i, k, unknowns_.terms[j].factor});
        }
      }
    }
    for (const Driven& a : driven) {
      for (const Driven& b : driven) {
        if (a.unknown != b.unknown) continue;
        double entry = tet.mixed * (along(a.axis, a.corner) * volume(b.axis, b.corner) +
                                    volume(a.axis, a.corner) * along(b.axis, b.corner)) +
                       tet.cofactor * volume(a.axis, a.corner) * volume(b.axis, b.corner);
        if (a.axis == b.axis) entry += tet.direct * g.row(a.corner).dot(g.row(b.corner));
        diagonal_[a.unknown] += a.factor * b.factor * entry;
      }
    }
  }
  return diagonal_;
}

int SolveByConjugateGradients(MapEnergy* energy, const Vector& right, double tolerance, int max_iterations, Vector* x) {
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
  int iteration = 0;
  for (; iteration < max_iterations && norm > target; ++iteration) {
    energy->Multiply(direction, &product);
    const double curvature = Dot(direction, product);
    if (!(curvature > 0)) break;
    const double step = norm / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      (*x)[i] += step * direction[i];
      residual[i] -= step * product[i];
    }
    const double previous = norm;
    norm = precondition();
    for (std::size_t i = 0; i < n; ++i) direction[i] = preconditioned[i] + norm / previous * direction[i];
  }
  return iteration;
}

}  // namespace octupole::internal
