#include "octupole/mesh/seams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Edge = std::array<int, 2>;

int GridIndex(int i, int j, int k) { return i + 3 * (j + 3 * k); }

// A box whose sides are surfaces of their own, but the tops of its two halves two of them.
TetMesh TaggedBox() {
  TetMesh mesh = MakeBoxMesh({2, 2, 2}, {2, 2, 2});
  for (const auto& triangle : BoundaryTriangles(mesh)) {
    const Eigen::Vector3d sum =
        mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]] - Eigen::Vector3d::Constant(3);
    int tag = 0;
    const double distance = sum.cwiseAbs().maxCoeff(&tag);
    tag = 2 * tag + (sum[tag] > 0);
    EXPECT_NEAR(distance, 3, 1e-12);
    if (tag == 5 && sum[0] > 0) tag = 6;
    // Whatever the order of vertices.
    mesh.surface_triangles.push_back({triangle[2], triangle[0], triangle[1]});
    mesh.surface_tags.push_back(tag);
  }
  return mesh;
}

std::vector<Edge> Seams(const TetMesh& mesh, double angle = 40) {
  return FindSeams(mesh, BoundaryTriangles(mesh), angle);
}

TEST(FindSeams, FindsSmoothMarkedEdgesWithinOneSurface) {
  TetMesh mesh = TaggedBox();
  const Edge in_bottom = {GridIndex(1, 0, 0), GridIndex(1, 1, 0)},
             between_tops = {GridIndex(1, 0, 2), GridIndex(1, 1, 2)}, sharp = {GridIndex(0, 0, 0), GridIndex(1, 0, 0)},
             inside = {GridIndex(1, 1, 1), GridIndex(1, 1, 2)};
  EXPECT_THAT(Seams(mesh), IsEmpty()) << "nothing is marked";
  mesh.feature_edges = {{in_bottom[1], in_bottom[0]}, between_tops, sharp, inside};
  EXPECT_THAT(Seams(mesh), ElementsAre(in_bottom));

  TetMesh all_one = mesh;
  std::fill(all_one.surface_tags.begin(), all_one.surface_tags.end(), -5);
  EXPECT_THAT(Seams(all_one), ElementsAre(in_bottom, between_tops));
  EXPECT_THAT(Seams(all_one, 91), ElementsAre(sharp, in_bottom, between_tops));

  TetMesh untagged = mesh;
  untagged.surface_triangles.clear();
  untagged.surface_tags.clear();
  EXPECT_THAT(Seams(untagged), IsEmpty());
  // One side without a tag.
  for (std::size_t t = 0; t < mesh.surface_triangles.size(); ++t) {
    const auto& triangle = mesh.surface_triangles[t];
    if (std::count(triangle.begin(), triangle.end(), in_bottom[0]) == 0) continue;
    if (std::count(triangle.begin(), triangle.end(), in_bottom[1]) == 0) continue;
    mesh.surface_triangles.erase(mesh.surface_triangles.begin() + static_cast<std::ptrdiff_t>(t));
    mesh.surface_tags.erase(mesh.surface_tags.begin() + static_cast<std::ptrdiff_t>(t));
    break;
  }
  EXPECT_THAT(Seams(mesh), IsEmpty());
}

}  // namespace
}  // namespace octupole
