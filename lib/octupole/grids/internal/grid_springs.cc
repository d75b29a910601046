#include "octupole/grids/internal/grid_springs.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace octupole::internal {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Place = std::array<int, 3>;

// The integral of the hat of an edge over a face that is not cut, see CellSprings.
constexpr double kHat = 1. / 8;
// Squared, in widths of the cell.
constexpr double kLongestSpring = 1.5;

Place PlaceOf(int number) { return {number % 3, number / 3 % 3, number / 9}; }
int NumberOf(const Place& p) { return LatticeNumber(p[0], p[1], p[2]); }
bool Has(std::uint32_t nodes, int number) { return (nodes >> number & 1) != 0; }
Vector3d PointOf(int number) {
  const Place p = PlaceOf(number);
  return Vector3d(p[0], p[1], p[2]) / 2;
}

// The integral of phi over a face of unit size, `side` 0 or 2 along `axis`, for the node of a number on it.
double FaceIntegral(std::uint32_t nodes, int axis, int side, int number) {
  Place centre = {1, 1, 1};
  centre[axis] = side;
  const Place place = PlaceOf(number);
  const int num_middles = static_cast<int>(std::count(place.begin(), place.end(), 1));
  if (Has(nodes, NumberOf(centre))) {
    constexpr std::array<double, 3> kOfParts = {1. / 16, 1. / 8, 1. / 4};
    return kOfParts[num_middles];
  }
  if (num_middles == 1) return kHat;
  double integral = 1. / 4;
  for (int along = 0; along < 3; ++along) {
    if (along == axis) continue;
    Place middle = place;
    middle[along] = 1;
    if (Has(nodes, NumberOf(middle))) integral -= kHat / 2;
  }
  return integral;
}

// Of the nodes of the given numbers, the integrals of phi times the inward normal.
VectorXd Pulls(std::uint32_t nodes, const std::vector<int>& numbers) {
  VectorXd pulls = VectorXd::Zero(3 * static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Place place = PlaceOf(numbers[i]);
    for (int axis = 0; axis < 3; ++axis) {
      if (place[axis] == 1) continue;
      pulls[3 * i + axis] = (1 - place[axis]) * FaceIntegral(nodes, axis, place[axis], numbers[i]);
    }
  }
  return pulls;
}

// The x >= 0 with the least |A x - b|.
VectorXd SolveNonNegative(const MatrixXd& a, const VectorXd& b) {
  constexpr double kZero = 1e-12;
  VectorXd x = VectorXd::Zero(a.cols());
  std::vector<Eigen::Index> passive;
  // Rounding could make it go round in circles.
  for (Eigen::Index round = 0; round < 10 * a.cols(); ++round) {
    VectorXd ascent = a.transpose() * (b - a * x);
    for (const Eigen::Index i : passive) ascent[i] = 0;
    Eigen::Index next;
    if (ascent.maxCoeff(&next) < kZero) break;
    passive.push_back(next);
    while (true) {
      MatrixXd columns(a.rows(), passive.size());
      for (std::size_t k = 0; k < passive.size(); ++k) columns.col(k) = a.col(passive[k]);
      const VectorXd solution = columns.colPivHouseholderQr().solve(b);
      if (solution.minCoeff() > 0) {
        for (std::size_t k = 0; k < passive.size(); ++k) x[passive[k]] = solution[k];
        break;
      }
      // As far towards it as all stay positive.
      double step = 1;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double here = x[passive[k]];
        if (solution[k] <= 0) step = std::min(step, here / (here - solution[k]));
      }
      for (std::size_t k = 0; k < passive.size(); ++k) x[passive[k]] += step * (solution[k] - x[passive[k]]);
      const auto is_zero = [&](Eigen::Index i) { return x[i] < kZero; };
      for (const Eigen::Index i : passive) {
        if (is_zero(i)) x[i] = 0;
      }
      passive.erase(std::remove_if(passive.begin(), passive.end(), is_zero), passive.end());
    }
  }
  return x;
}

// Whether the lattice has a point between two that is a node.
bool IsParted(std::uint32_t nodes, const Place& p, const Place& q) {
  Place middle;
  for (int axis = 0; axis < 3; ++axis) {
    if ((p[axis] + q[axis]) % 2 != 0) return false;
    middle[axis] = (p[axis] + q[axis]) / 2;
  }
  return Has(nodes, NumberOf(middle));
}

std::vector<Spring> FindSprings(std::uint32_t nodes) {
  std::vector<int> numbers;
  for (int number = 0; number < 27; ++number) {
    if (Has(nodes, number)) numbers.push_back(number);
  }
  std::vector<Spring> springs;
  std::vector<std::array<std::size_t, 2>> rows;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (std::size_t j = i + 1; j < numbers.size(); ++j) {
      const int a = numbers[i], b = numbers[j];
      if ((PointOf(b) - PointOf(a)).squaredNorm() > kLongestSpring || IsParted(nodes, PlaceOf(a), PlaceOf(b))) continue;
      springs.push_back({a, b, 0});
      rows.push_back({i, j});
    }
  }
  // Each spring as if its weight times its squared length were 1, so that short ones are not at a disadvantage.
  MatrixXd pull_of = MatrixXd::Zero(3 * numbers.size(), springs.size());
  std::vector<double> squared_lengths;
  for (std::size_t k = 0; k < springs.size(); ++k) {
    const Vector3d step = PointOf(springs[k].b) - PointOf(springs[k].a);
    squared_lengths.push_back(step.squaredNorm());
    pull_of.block<3, 1>(3 * rows[k][0], k) = step / step.squaredNorm();
    pull_of.block<3, 1>(3 * rows[k][1], k) = -step / step.squaredNorm();
  }
  const VectorXd pulls = Pulls(nodes, numbers);
  const VectorXd solution = SolveNonNegative(pull_of, pulls);
  if ((pull_of * solution - pulls).norm() > 1e-9) throw std::logic_error("FindSprings: no solution");
  for (std::size_t k = 0; k < springs.size(); ++k) springs[k].weight = solution[k] / squared_lengths[k];
  springs.erase(std::remove_if(springs.begin(), springs.end(), [](const Spring& s) { return s.weight == 0; }),
                springs.end());
  return springs;
}

// The ways to turn and mirror a cube: where each lattice point goes.
std::vector<std::array<int, 27>> Symmetries() {
  std::vector<std::array<int, 27>> symmetries;
  Place order = {0, 1, 2};
  do {
    for (int mirrored = 0; mirrored < 8; ++mirrored) {
      std::array<int, 27>& image = symmetries.emplace_back();
      for (int number = 0; number < 27; ++number) {
        const Place p = PlaceOf(number);
        Place q;
        for (int axis = 0; axis < 3; ++axis) {
          const int x = p[order[axis]];
          q[axis] = (mirrored >> axis & 1) != 0 ? 2 - x : x;
        }
        image[number] = NumberOf(q);
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return symmetries;
}

std::uint32_t ImageOf(std::uint32_t nodes, const std::array<int, 27>& symmetry) {
  std::uint32_t image = 0;
  for (int number = 0; number < 27; ++number) {
    if (Has(nodes, number)) image |= 1u << symmetry[number];
  }
  return image;
}

}  // namespace

const std::vector<Spring>& CellSprings::Of(std::uint32_t nodes) {
  const auto found = springs_of_.find(nodes);
  if (found != springs_of_.end()) return found->second;
  // Solved once for all cells that differ by a symmetry only.
  static const std::vector<std::array<int, 27>> symmetries = Symmetries();
  const auto least = std::min_element(symmetries.begin(), symmetries.end(), [&](const auto& s, const auto& t) {
    return ImageOf(nodes, s) < ImageOf(nodes, t);
  });
  const std::uint32_t image = ImageOf(nodes, *least);
  if (image == nodes) return springs_of_[nodes] = FindSprings(nodes);
  std::array<int, 27> back;
  for (int number = 0; number < 27; ++number) back[(*least)[number]] = number;
  std::vector<Spring> springs = Of(image);
  for (Spring& spring : springs) {
    spring.a = back[spring.a];
    spring.b = back[spring.b];
  }
  return springs_of_[nodes] = std::move(springs);
}

}  // namespace octupole::internal
