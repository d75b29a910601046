#include "octupole/mesh/edge_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/mesh/tet_neighbours.h"

namespace octupole {
namespace {

TEST(TetNeighbours, AreMutualAndMissingOnTheBoundaryOnly) {
  const TetMesh mesh = MakeBoxMesh({3, 2, 2}, {3, 2, 2});
  const auto neighbours = TetNeighbours(mesh);
  std::size_t num_boundary = 0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    for (int i = 0; i < 4; ++i) {
      const int s = neighbours[t][i];
      num_boundary += s < 0;
      if (s < 0) continue;
      EXPECT_EQ(std::count(neighbours[s].begin(), neighbours[s].end(), t), 1);
      for (int k = 0; k < 4; ++k) {
        const bool is_shared = std::count(mesh.tets[s].begin(), mesh.tets[s].end(), mesh.tets[t][k]) == 1;
        EXPECT_EQ(is_shared, k != i);
      }
    }
  }
  EXPECT_EQ(num_boundary, BoundaryTriangles(mesh).size());
}

TEST(TetNeighbours, RefusesATriangleOfThreeTets) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  EXPECT_THROW(TetNeighbours(mesh), std::invalid_argument);
}

// Around the edge by the right hand, each tetrahedron once, through faces that contain the edge.
TEST(EdgeRings, GoAroundByTheRightHand) {
  const TetMesh mesh = MakeBoxMesh({3, 3, 3}, {3, 3, 3});
  const auto neighbours = TetNeighbours(mesh);
  const EdgeRings rings = FindEdgeRings(mesh, neighbours);
  EXPECT_EQ(rings.size(), MeshEdges(mesh).size());
  EXPECT_EQ(rings.steps.size(), 6 * mesh.tets.size());
  int num_closed = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Eigen::Vector3d &a = mesh.points[rings.vertices[r][0]], &b = mesh.points[rings.vertices[r][1]];
    std::set<int> tets;
    for (std::size_t i = rings.begin[r]; i < rings.begin[r + 1]; ++i) {
      const EdgeRings::Step& step = rings.steps[i];
      tets.insert(step.tet);
      const Eigen::Vector3d from = mesh.points[mesh.tets[step.tet][step.out]] - a,
                            to = mesh.points[mesh.tets[step.tet][step.in]] - a;
      EXPECT_GT((b - a).dot(from.cross(to)), 0);
      const bool is_last = i + 1 == rings.begin[r + 1];
      const int next = is_last ? rings.is_closed[r] ? rings.steps[rings.begin[r]].tet : -1 : rings.steps[i + 1].tet;
      EXPECT_EQ(neighbours[step.tet][step.out], next);
    }
    EXPECT_EQ(tets.size(), rings.begin[r + 1] - rings.begin[r]);
    num_closed += rings.is_closed[r];
  }
  const auto boundary = BoundaryTriangles(mesh);
  EXPECT_EQ(rings.size() - num_closed, boundary.size() * 3 / 2);
}

}  // namespace
}  // namespace octupole
