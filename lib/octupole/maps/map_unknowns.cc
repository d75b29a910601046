#include "octupole/maps/map_unknowns.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

// A linear combination of variables, sparse, in ascending order. Factors are small integers and halves, so doubles hold
// them exactly.
using Combination = std::vector<std::pair<int, double>>;

constexpr double kZero = 1e-9;

// a + factor * b.
Combination Add(const Combination& a, double factor, const Combination& b) {
  Combination sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin(), j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first)) {
      sum.push_back(*i++);
    } else if (i == a.end() || j->first < i->first) {
      sum.emplace_back(j->first, factor * j->second);
      ++j;
    } else {
      if (const double x = i->second + factor * j->second; std::abs(x) > kZero) sum.emplace_back(i->first, x);
      ++i;
      ++j;
    }
  }
  return sum;
}

// Sets of scalars, each of which is its root's value times a sign, plus a combination of shifts.
class JoinedScalars {
 public:
  explicit JoinedScalars(int size) : parent_(size), sign_(size, 1), shift_(size), rank_(size, 0) {
    for (int i = 0; i < size; ++i) parent_[i] = i;
  }

  struct Value {
    int root;
    int sign;
    Combination shift;
  };

  Value Find(int x) {
    path_.clear();
    while (parent_[x] != x) {
      path_.push_back(x);
      x = parent_[x];
    }
    // From the one next to the root back: each then hangs on the root.
    for (std::size_t i = path_.size(); i-- > 0;) {
      const int p = path_[i], above = parent_[p];
      if (above == x) continue;
      if (!shift_[above].empty()) shift_[p] = Add(shift_[p], sign_[p], shift_[above]);
      sign_[p] = static_cast<signed char>(sign_[p] * sign_[above]);
      parent_[p] = x;
    }
    if (path_.empty()) return {x, 1, {}};
    return {x, sign_[path_[0]], shift_[path_[0]]};
  }

  /// Asks for x = sign * y + shift. What is left of it where they are joined already is an equation, combination = 0,
  /// of shifts and of twice the root, which is variable `root + first_root`.
  Combination Join(int x, int sign, int y, const Combination& shift, int first_root) {
    const Value a = Find(x), b = Find(y);
    // a.sign A + a.shift = sign (b.sign B + b.shift) + shift
    const Combination rest = Add(Add(shift, sign, b.shift), -1, a.shift);
    if (a.root == b.root) {
      const int factor = sign * b.sign - a.sign;
      Combination equation = rest;
      if (factor != 0) equation.emplace_back(a.root + first_root, factor);
      return equation;
    }
    if (rank_[a.root] < rank_[b.root]) {
      Hang(a.root, a.sign * sign * b.sign, b.root, Add({}, a.sign, rest));
    } else {
      // B = sign b.sign (a.sign A - rest)
      Hang(b.root, a.sign * sign * b.sign, a.root, Add({}, -sign * b.sign, rest));
    }
    return {};
  }

 private:
  void Hang(int root, int sign, int onto, Combination shift) {
    parent_[root] = onto;
    sign_[root] = static_cast<signed char>(sign);
    shift_[root] = std::move(shift);
    if (rank_[root] == rank_[onto]) ++rank_[onto];
  }

  std::vector<int> parent_;
  std::vector<signed char> sign_;
  std::vector<Combination> shift_;
  std::vector<signed char> rank_;
  std::vector<int> path_;
};

// Homogeneous equations, solved one by one for a variable each.
class Equations {
 public:
  void Add(const Combination& equation) {
    std::map<int, double> rest(equation.begin(), equation.end());
    // Those solved for may stand in the solutions of later ones, so until none is left.
    for (bool is_open = true; is_open;) {
      is_open = false;
      for (const auto& [variable, factor] : std::map<int, double>(rest)) {
        const auto solved = solutions_.find(variable);
        if (solved == solutions_.end()) continue;
        is_open = true;
        const double present = rest[variable];
        rest.erase(variable);
        for (const auto& [other, part] : solved->second) AddTo(&rest, other, present * part);
      }
    }
    if (rest.empty()) return;
    DivideByCommonFactor(&rest);
    auto pivot = rest.begin();
    for (auto i = rest.begin(); i != rest.end(); ++i) {
      if (std::abs(i->second) < std::abs(pivot->second) - kZero) pivot = i;
    }
    Combination solution;
    for (const auto& [variable, factor] : rest) {
      if (variable != pivot->first) solution.emplace_back(variable, -factor / pivot->second);
    }
    solutions_[pivot->first] = std::move(solution);
  }

  bool IsSolved(int variable) const { return solutions_.count(variable) > 0; }

  /// In terms of variables that are free.
  const Combination& Solution(int variable) {
    Combination& solution = solutions_.at(variable);
    const bool is_open =
        std::any_of(solution.begin(), solution.end(), [&](const auto& t) { return IsSolved(t.first); });
    if (is_open) {
      std::map<int, double> sum;
      for (const auto& [other, factor] : Combination(solution)) {
        if (!IsSolved(other)) {
          AddTo(&sum, other, factor);
          continue;
        }
        for (const auto& [free, part] : Solution(other)) AddTo(&sum, free, factor * part);
      }
      solution.assign(sum.begin(), sum.end());
    }
    return solution;
  }

 private:
  static void AddTo(std::map<int, double>* sum, int variable, double factor) {
    const auto place = sum->emplace(variable, 0).first;
    place->second += factor;
    if (std::abs(place->second) < kZero) sum->erase(place);
  }

  // So that 2 x - 2 y = 0 becomes x - y = 0, of whose factors both will do as a pivot.
  static void DivideByCommonFactor(std::map<int, double>* equation) {
    long long common = 0;
    for (const auto& [variable, factor] : *equation) {
      const double twice = 2 * factor;
      if (std::abs(twice - std::round(twice)) > kZero) return;
      common = std::gcd(common, std::llround(std::abs(twice)));
    }
    for (auto& [variable, factor] : *equation) factor *= 2. / static_cast<double>(common);
  }

  std::map<int, Combination> solutions_;
};

// Along which a feature edge holds two parameters constant: the other axes of a tetrahedron at the edge.
struct HeldEdge {
  int tet;
  std::array<int, 2> vertices;
  std::array<int, 2> axes;
};

std::vector<HeldEdge> FindHeldEdges(const TetMesh& mesh, const CombedFrames& combed, const EdgeRings& rings) {
  std::vector<HeldEdge> held;
  for (const auto& [a, b] : mesh.feature_edges) {
    const std::array<int, 2> edge = {std::min(a, b), std::max(a, b)};
    const auto place = std::lower_bound(rings.vertices.begin(), rings.vertices.end(), edge);
    if (place == rings.vertices.end() || *place != edge) continue;
    const int tet = rings.steps[rings.begin[place - rings.vertices.begin()]].tet;
    const Eigen::Vector3d along = combed.frames[tet].transpose() * (mesh.points[b] - mesh.points[a]);
    int axis;
    constexpr double kCosine30 = 0.866;
    if (along.cwiseAbs().maxCoeff(&axis) < kCosine30 * along.norm()) continue;
    held.push_back({tet, {a, b}, {(axis + 1) % 3, (axis + 2) % 3}});
  }
  return held;
}

class Eliminator {
 public:
  Eliminator(const MapCut& cut) : first_root_(3 * cut.num_patches), scalars_(3 * cut.num_nodes) {}

  void JoinSheets(const MapCut& cut, const BoundarySheets& sheets) {
    for (const BoundarySheets::Face& face : sheets.faces) {
      if (face.is_released) continue;
      const int a = (face.corner + 1) % 4;
      for (const int b : {(face.corner + 2) % 4, (face.corner + 3) % 4}) {
        Join(3 * cut.nodes[face.tet][b] + face.axis, 1, 3 * cut.nodes[face.tet][a] + face.axis, {});
      }
    }
  }

  void JoinFeatures(const TetMesh& mesh, const MapCut& cut, const std::vector<HeldEdge>& held) {
    for (const HeldEdge& edge : held) {
      const std::array<int, 4>& tet = mesh.tets[edge.tet];
      const int a = cut.nodes[edge.tet][CornerOf(tet, edge.vertices[0])];
      const int b = cut.nodes[edge.tet][CornerOf(tet, edge.vertices[1])];
      for (const int k : edge.axes) Join(3 * b + k, 1, 3 * a + k, {});
    }
  }

  void JoinSeams(const TetMesh& mesh, const CombedFrames& combed, const MapCut& cut) {
    for (const MapCut::Face& face : cut.faces) {
      const OctahedralRotation inverse = combed.match(face.tet, face.corner).Inverse();
      const int t = combed.neighbours[face.tet][face.corner];
      for (int i = 0; i < 4; ++i) {
        if (i == face.corner) continue;
        const int from = cut.nodes[face.tet][i], to = cut.nodes[t][CornerOf(mesh.tets[t], mesh.tets[face.tet][i])];
        for (int k = 0; k < 3; ++k) {
          Join(3 * to + k, inverse.sign[k], 3 * from + inverse.axis[k], {{3 * face.patch + k, 1.}});
        }
      }
    }
  }

  MapUnknowns Finish(int num_rows) {
    SolveEquations();
    MapUnknowns unknowns;
    unknowns.begin.reserve(num_rows + 1);
    unknowns.terms.reserve(num_rows);
    for (int row = 0; row < num_rows; ++row) {
      unknowns.begin.push_back(unknowns.terms.size());
      const JoinedScalars::Value value = scalars_.Find(row);
      Combination sum = Expand({{value.root + first_root_, value.sign}});
      if (!value.shift.empty()) sum = ::octupole::Add(sum, 1, Expand(value.shift));
      for (const auto& [variable, factor] : sum) unknowns.terms.push_back({Number(variable), factor});
    }
    unknowns.begin.push_back(unknowns.terms.size());
    // Shifts that no row needs are of no concern.
    unknowns.num_unknowns = static_cast<int>(number_.size());
    unknowns.is_integer.assign(number_.size(), false);
    return unknowns;
  }

  /// Marks what a shift of the cut depends on.
  void MarkShifts(MapUnknowns* unknowns) {
    for (int d = 0; d < first_root_; ++d) {
      for (const auto& [variable, factor] : Expand({{d, 1.}})) {
        if (const auto number = number_.find(variable); number != number_.end()) {
          unknowns->is_integer[number->second] = true;
          unknowns->num_fractional += std::abs(factor - std::round(factor)) > kZero;
        }
      }
    }
  }

 private:
  void Join(int x, int sign, int y, const Combination& shift) {
    const Combination equation = scalars_.Join(x, sign, y, shift, first_root_);
    if (!equation.empty()) left_.push_back(equation);
  }

  // Equations that were left on the way name roots of then, which may have been joined to others since.
  void SolveEquations() {
    for (const Combination& equation : left_) {
      Combination sum;
      for (const auto& [variable, factor] : equation) {
        if (variable < first_root_) {
          sum = ::octupole::Add(sum, factor, {{variable, 1.}});
          continue;
        }
        const JoinedScalars::Value value = scalars_.Find(variable - first_root_);
        sum = ::octupole::Add(sum, factor, {{value.root + first_root_, value.sign}});
        sum = ::octupole::Add(sum, factor, value.shift);
      }
      equations_.Add(sum);
    }
  }

  Combination Expand(const Combination& combination) {
    Combination sum;
    for (const auto& [variable, factor] : combination) {
      if (equations_.IsSolved(variable)) {
        sum = ::octupole::Add(sum, factor, equations_.Solution(variable));
      } else {
        sum = ::octupole::Add(sum, factor, {{variable, 1.}});
      }
    }
    return sum;
  }

  int Number(int variable) { return number_.emplace(variable, static_cast<int>(number_.size())).first->second; }

  int first_root_;
  JoinedScalars scalars_;
  std::vector<Combination> left_;
  Equations equations_;
  std::map<int, int> number_;
};

}  // namespace

std::vector<double> MapUnknowns::Parameters(const std::vector<double>& y) const {
  std::vector<double> u(begin.size() - 1, 0);
  for (std::size_t row = 0; row < u.size(); ++row) {
    for (std::size_t i = begin[row]; i < begin[row + 1]; ++i) u[row] += terms[i].factor * y[terms[i].unknown];
  }
  return u;
}

MapUnknowns EliminateConstraints(const TetMesh& mesh, const CombedFrames& combed, const MapCut& cut,
                                 const BoundarySheets& sheets, const EdgeRings& rings,
                                 const std::vector<SingularEdge>& singular_edges) {
  Eliminator eliminator(cut);
  const std::vector<HeldEdge> held = FindHeldEdges(mesh, combed, rings);
  eliminator.JoinSheets(cut, sheets);
  eliminator.JoinFeatures(mesh, cut, held);
  eliminator.JoinSeams(mesh, combed, cut);
  MapUnknowns unknowns = eliminator.Finish(3 * cut.num_nodes);
  eliminator.MarkShifts(&unknowns);
  const auto mark = [&](int node, int axis) {
    const std::size_t row = 3 * static_cast<std::size_t>(node) + axis;
    for (std::size_t i = unknowns.begin[row]; i < unknowns.begin[row + 1]; ++i) {
      const auto& [unknown, factor] = unknowns.terms[i];
      unknowns.is_integer[unknown] = true;
      unknowns.num_fractional += std::abs(factor - std::round(factor)) > kZero;
    }
  };
  for (const BoundarySheets::Face& face : sheets.faces) {
    if (!face.is_released) mark(cut.nodes[face.tet][(face.corner + 1) % 4], face.axis);
  }
  for (const HeldEdge& edge : held) {
    const int node = cut.nodes[edge.tet][CornerOf(mesh.tets[edge.tet], edge.vertices[0])];
    for (const int k : edge.axes) mark(node, k);
  }
  for (const SingularEdge& edge : singular_edges) {
    // The parameters that the turn changes.
    const OctahedralRotation turn = TurnAround(combed, rings, edge.ring);
    const int tet = rings.steps[rings.begin[edge.ring]].tet;
    for (int k = 0; k < 3; ++k) {
      if (turn.axis[k] == k && turn.sign[k] == 1) continue;
      for (const int v : edge.vertices) mark(cut.nodes[tet][CornerOf(mesh.tets[tet], v)], k);
    }
  }
  return unknowns;
}

std::vector<int> FindCollapsedTets(const TetMesh& mesh, const MapCut& cut, const MapUnknowns& unknowns) {
  // A polynomial that is not zero everywhere is not zero at random, so two tries are plenty.
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<int> suspects(mesh.tets.size());
  for (std::size_t t = 0; t < suspects.size(); ++t) suspects[t] = static_cast<int>(t);
  for (int trial = 0; trial < 2; ++trial) {
    std::vector<double> y(unknowns.num_unknowns);
    for (double& value : y) value = uniform(generator);
    const std::vector<double> u = unknowns.Parameters(y);
    const auto at = [&](int t, int i) { return Eigen::Map<const Eigen::Vector3d>(&u[3 * cut.nodes[t][i]]); };
    suspects.erase(std::remove_if(suspects.begin(), suspects.end(),
                                  [&](int t) {
                                    const Eigen::Vector3d a = at(t, 1) - at(t, 0), b = at(t, 2) - at(t, 0),
                                                          c = at(t, 3) - at(t, 0);
                                    return std::abs(a.cross(b).dot(c)) > 1e-12 * a.norm() * b.norm() * c.norm();
                                  }),
                   suspects.end());
  }
  return suspects;
}

}  // namespace octupole
