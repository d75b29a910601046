#include "octupole/mesh/box_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "octupole/mesh/mesh_topology.h"
#include "test_files.h"

namespace octupole {
namespace {

TEST(MakeBoxMesh, FillsTheBoxWithEqualPositiveTets) {
  const TetMesh mesh = MakeBoxMesh({2, 3, 5}, {1.0, 6.0, 2.5});
  CheckTetMesh(mesh);
  ASSERT_EQ(mesh.points.size(), 3 * 4 * 6);
  ASSERT_EQ(mesh.tets.size(), 6 * 2 * 3 * 5);
  EXPECT_TRUE(mesh.regions.empty());
  // A cell has the volume 1/2 * 2 * 1/2 and six tetrahedra.
  for (const double volume : SixfoldVolumes(mesh)) {
    EXPECT_NEAR(volume, 0.5, 1e-14);
  }
}

TEST(MakeBoxMesh, NumbersTheGridAsDocumented) {
  const TetMesh mesh = MakeBoxMesh({2, 3, 5}, {1.0, 6.0, 2.5});
  EXPECT_EQ(mesh.points[1 + 3 * (2 + 4 * 4)], Eigen::Vector3d(0.5, 4.0, 2.0));
  EXPECT_EQ(mesh.points.back(), Eigen::Vector3d(1.0, 6.0, 2.5));
}

TEST(MakeBoxMesh, EveryTetOfACellHoldsItsDiagonal) {
  for (const std::array<int, 4>& tet : MakeBoxMesh({1, 1, 1}, {1, 1, 1}).tets) {
    EXPECT_EQ(std::count(tet.begin(), tet.end(), 0), 1);
    EXPECT_EQ(std::count(tet.begin(), tet.end(), 7), 1);
  }
}

TEST(MakeBoxMesh, IsConforming) {
  // Every triangle inside belongs to two tetrahedra, so only the grid's own surface is boundary.
  const TetMesh mesh = MakeBoxMesh({2, 3, 5}, {1.0, 1.0, 1.0});
  EXPECT_EQ(BoundaryTriangles(mesh).size(), 2 * 2 * (2 * 3 + 3 * 5 + 5 * 2));
}

TEST(MakeBoxMesh, RefusesBadArguments) {
  const auto message = [](const std::array<int, 3>& cells, const Eigen::Vector3d& size) {
    return MessageOf<std::invalid_argument>([&] { MakeBoxMesh(cells, size); });
  };
  EXPECT_EQ(message({1, 0, 1}, {1, 1, 1}), "MakeBoxMesh: 0 cells along y");
  EXPECT_EQ(message({1, 1, 1}, {1, 1, -2}), "MakeBoxMesh: the size along z is -2.000000");
  EXPECT_EQ(message({1, 1, 1}, {std::numeric_limits<double>::quiet_NaN(), 1, 1}),
            "MakeBoxMesh: the size along x is nan");
  EXPECT_EQ(message({2000, 2000, 2000}, {1, 1, 1}), "MakeBoxMesh: 2000 x 2000 x 2000 cells are too many");
}

}  // namespace
}  // namespace octupole
