#include "octupole/mesh/mesh_arrays.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "test_files.h"

namespace octupole {
namespace {

Eigen::MatrixXd Points() { return (Eigen::MatrixXd(5, 3) << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 1, 1, 1).finished(); }
Eigen::MatrixXi Tets() { return (Eigen::MatrixXi(2, 4) << 0, 1, 2, 3, 1, 2, 3, 4).finished(); }

void ExpectTheMesh(const TetMesh& mesh) {
  EXPECT_EQ(mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}}));
  EXPECT_EQ(mesh.tets, (std::vector<std::array<int, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_TRUE(mesh.regions.empty());
}

TEST(TetMeshFromMatrices, TakesEitherStorageOrderAnyScalarAndBlocks) {
  ExpectTheMesh(TetMeshFromMatrices(Points(), Tets()));
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> points = Points().cast<float>();
  const Eigen::Matrix<std::int64_t, Eigen::Dynamic, 4, Eigen::RowMajor> tets = Tets().cast<std::int64_t>();
  ExpectTheMesh(TetMeshFromMatrices(points, tets));
  ExpectTheMesh(TetMeshFromMatrices(points, Tets().cast<std::uint32_t>()));
  Eigen::MatrixXd wide(6, 7);
  wide.block(1, 2, 5, 3) = Points();
  ExpectTheMesh(TetMeshFromMatrices(wide.block(1, 2, 5, 3), Tets().replicate(1, 1)));
}

TEST(TetMeshFromMatrices, RefusesWhatIsNoMesh) {
  const auto message_of = [](const auto& points, const auto& tets) {
    return MessageOf<std::invalid_argument>([&] { TetMeshFromMatrices(points, tets); });
  };
  EXPECT_EQ(message_of(Points().transpose().eval(), Tets()),
            "TetMeshFromMatrices: the matrix of points has 5 columns, not 3");
  EXPECT_EQ(message_of(Points(), Tets().leftCols(3).eval()),
            "TetMeshFromMatrices: the matrix of tetrahedra has 3 columns, not 4");
  EXPECT_NE(message_of(Points(), (Tets().array() + 1).matrix().eval()).find("vertex index 5"), std::string::npos);
  // Wrapped around to 32 bits, this would be vertex 0.
  Eigen::Matrix<std::int64_t, Eigen::Dynamic, 4> large = Tets().cast<std::int64_t>();
  large(1, 2) = std::int64_t{1} << 32;
  EXPECT_EQ(message_of(Points(), large), "TetMeshFromMatrices: tetrahedron 1 has the vertex index 4294967296");
  const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 4> minus_one = (Tets().array() - 1).matrix().cast<std::uint32_t>();
  EXPECT_NE(message_of(Points(), minus_one).find("4294967295"), std::string::npos);
  Eigen::MatrixXd points = Points();
  points(4, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(points, Tets()).find("point 4"), std::string::npos);
}

TEST(TetMeshFromArrays, ReadsPointAfterPoint) {
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 1, 1, 1};
  const std::size_t tets[] = {0, 1, 2, 3, 1, 2, 3, 4};
  ExpectTheMesh(TetMeshFromArrays(points, 5, tets, 2));
  EXPECT_THROW(TetMeshFromArrays(points, 4, tets, 2), std::invalid_argument);
}

TEST(MatrixFromFrames, HasTheAxesOfAFramePerRow) {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::MatrixXd rows = MatrixFromFrames({Eigen::Matrix3d::Identity(), turned});
  ASSERT_EQ(rows.rows(), 2);
  ASSERT_EQ(rows.cols(), 9);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rows.block(1, 3 * k, 1, 3).transpose(), turned.col(k));
}

}  // namespace
}  // namespace octupole
