#include "octupole/singularities/singular_triangles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "random_inputs.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Frames that wander through the mesh, smoothly enough to have certified tets and roughly enough to have singular
// triangles, with axes named at random.
std::vector<Matrix3d> WanderingFrames(const TetMesh& mesh, double roughness) {
  std::mt19937 generator(1);
  const Vector3d x = RandomDirection(&generator), y = RandomDirection(&generator), z = RandomDirection(&generator);
  std::vector<Matrix3d> frames;
  for (const Vector3d& p : mesh.points) {
    frames.push_back(Eigen::AngleAxisd(roughness * std::sin(9 * p.x() + 2 * p.y()), x) *
                     Eigen::AngleAxisd(roughness * std::sin(8 * p.y() + 3 * p.z()), y) *
                     Eigen::AngleAxisd(roughness * std::sin(7 * p.z() + 4 * p.x()), z) *
                     OctahedralGroup()[generator() % 24].matrix());
  }
  return frames;
}

// By the definition: every triangle, by the full match.
TEST(FindSingularTriangles, FindsAllOfThem) {
  const TetMesh mesh = MakeBoxMesh({9, 9, 9}, {1, 1, 1});
  for (const double roughness : {.5, 1., 2.}) {
    const auto frames = WanderingFrames(mesh, roughness);
    const auto singular = FindSingularTriangles(mesh, frames);
    auto next = singular.begin();
    for (const auto& vertices : MeshTriangles(mesh)) {
      const auto& [a, b, c] = vertices;
      const TurnType type = TypeOf(Holonomy(frames[a], frames[b], frames[c]));
      if (type == TurnType::kNone) continue;
      ASSERT_NE(next, singular.end());
      EXPECT_EQ(next->vertices, vertices);
      EXPECT_EQ(next->type, type);
      ++next;
    }
    EXPECT_EQ(next, singular.end());
    EXPECT_TRUE(roughness < 1 || singular.size() > 100) << singular.size();
  }
}

TEST(FindSingularTriangles, KnowsTheTetsOfEach) {
  const TetMesh mesh = MakeBoxMesh({5, 5, 5}, {1, 1, 1});
  const auto singular = FindSingularTriangles(mesh, WanderingFrames(mesh, 2));
  EXPECT_GT(singular.size(), 100u);
  for (const SingularTriangle& triangle : singular) {
    std::vector<int> tets;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto has = [&](int v) { return std::count(mesh.tets[t].begin(), mesh.tets[t].end(), v) == 1; };
      if (std::all_of(triangle.vertices.begin(), triangle.vertices.end(), has)) tets.push_back(static_cast<int>(t));
    }
    EXPECT_EQ(triangle.tets, tets);
  }
}

// Matches of shared edges agree, so no tet has a single singular face, and the odd ones come in pairs.
TEST(FindSingularTriangles, LeavesNoTetWithASingleOne) {
  const TetMesh mesh = MakeBoxMesh({8, 8, 8}, {1, 1, 1});
  std::map<int, std::vector<TurnType>> types_at;
  std::mt19937 generator(3);
  // Quarters of a right angle, so that many matches are ties but for rounding.
  std::vector<Matrix3d> frames;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    frames.push_back(Eigen::AngleAxisd(EIGEN_PI / 8 * (generator() % 4), Vector3d::Unit(generator() % 3)).matrix());
  }
  for (const SingularTriangle& triangle : FindSingularTriangles(mesh, frames)) {
    for (const int tet : triangle.tets) types_at[tet].push_back(triangle.type);
  }
  EXPECT_GT(types_at.size(), 1000u);
  for (const auto& [tet, types] : types_at) {
    EXPECT_NE(types.size(), 1u) << tet;
    const auto is_odd = [](TurnType t) { return t == TurnType::kQuarter || t == TurnType::kDiagonalHalf; };
    EXPECT_EQ(std::count_if(types.begin(), types.end(), is_odd) % 2, 0) << tet;
  }
}

TEST(FindSingularTriangles, WantsOneFramePerPoint) {
  EXPECT_THROW(FindSingularTriangles(MakeBoxMesh({1, 1, 1}, {1, 1, 1}), std::vector<Matrix3d>(7)),
               std::invalid_argument);
}

}  // namespace
}  // namespace octupole
