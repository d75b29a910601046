#include "octupole/field/cross_field.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "octupole/frames/frame.h"
#include "octupole/mesh/box_mesh.h"
#include "octupole/mesh/surface_corners.h"
#include "random_inputs.h"

namespace octupole {
namespace {

TEST(CrossField, PutsTheAxisNearestToTheNormalLast) {
  const TriangleMesh surface = BoundarySurface(MakeBoxMesh({2, 2, 2}, {1, 2, 3}));
  std::mt19937 generator(1);
  std::vector<Eigen::Matrix3d> frames;
  for (std::size_t v = 0; v < surface.points.size(); ++v) frames.push_back(RandomFrame(&generator));
  const std::vector<Eigen::Matrix3d> crosses = CrossField(surface, frames);
  const std::vector<Eigen::Vector3d> normals = VertexNormals(surface.points, surface.triangles);
  ASSERT_EQ(crosses.size(), frames.size());
  for (std::size_t v = 0; v < frames.size(); ++v) {
    EXPECT_LT(FrameDifference<3>(frames[v], crosses[v]), 1e-12) << "still the same frame";
    EXPECT_NEAR(crosses[v].determinant(), 1, 1e-12);
    if (normals[v].isZero(0)) {
      EXPECT_EQ(crosses[v], frames[v]);
    } else {
      // The nearest of three orthogonal axes.
      EXPECT_GE(crosses[v].col(2).dot(normals[v]), 1 / std::sqrt(3.) - 1e-12);
      EXPECT_EQ(crosses[v].col(2).dot(normals[v]), (frames[v].transpose() * normals[v]).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_THROW(CrossField(surface, {}), std::invalid_argument);
}

}  // namespace
}  // namespace octupole
