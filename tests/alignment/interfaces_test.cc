// Which faces inside a mesh are interfaces, and how they align the field.

#include "octupole/alignment/interfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "ball_in_box_mesh.h"
#include "fan_mesh.h"
#include "octupole/alignment/boundary_alignment.h"
#include "octupole/mesh/internal/sorted_simplices.h"
#include "octupole/mesh/mesh_topology.h"

namespace octupole {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Interfaces Find(const TetMesh& mesh, RegionUse use = RegionUse::kAutomatic) {
  return FindInterfaces(mesh, BoundaryTriangles(mesh), use);
}

double AngleBetweenLines(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / EIGEN_PI;
}

// The parts of a partition: tets belong to the nearest of some seeds, steps being counted from face to face.
std::vector<int> Parts(const TetMesh& mesh, int num_parts) {
  std::map<std::array<int, 3>, std::vector<int>> tets_at;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    std::array<int, 4> tet = mesh.tets[t];
    std::sort(tet.begin(), tet.end());
    for (const auto& [i, j, k] : internal::kTetFaces) tets_at[{tet[i], tet[j], tet[k]}].push_back(t);
  }
  std::vector<std::vector<int>> neighbours(mesh.tets.size());
  for (const auto& [face, tets] : tets_at) {
    if (tets.size() < 2) continue;
    neighbours[tets[0]].push_back(tets[1]);
    neighbours[tets[1]].push_back(tets[0]);
  }
  std::vector<int> part(mesh.tets.size(), -1);
  std::deque<int> open;
  std::mt19937 generator(7);
  for (int i = 0; i < num_parts; ++i) {
    const int t = static_cast<int>(generator() % mesh.tets.size());
    part[t] = i;
    open.push_back(t);
  }
  for (; !open.empty(); open.pop_front()) {
    for (const int t : neighbours[open.front()]) {
      if (part[t] != -1) continue;
      part[t] = part[open.front()];
      open.push_back(t);
    }
  }
  return part;
}

TEST(FindInterfaces, FindsTheSphereAroundABallAndOrientsIt) {
  const TetMesh mesh = MakeBallInBoxMesh(8);
  const Interfaces interfaces = Find(mesh);
  EXPECT_EQ(interfaces.num_regions, 2u);
  EXPECT_EQ(interfaces.triangles.size(), 6u * 4u * 4u * 2u);
  EXPECT_EQ(interfaces.between_regions.count, interfaces.triangles.size());
  EXPECT_EQ(interfaces.between_regions.fitting_share, 1);
  EXPECT_TRUE(interfaces.between_regions.are_followed);
  EXPECT_EQ(interfaces.tagged.count, 0u);
  EXPECT_THAT(InterfaceWarnings(interfaces), IsEmpty());
  int num_outward = 0;
  for (const auto& [a, b, c] : interfaces.triangles) {
    for (const int v : {a, b, c}) EXPECT_NEAR(mesh.points[v].norm(), 0.5, 1e-12);
    const Vector3d area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    num_outward += area.dot(mesh.points[a]) > 0;
  }
  EXPECT_TRUE(num_outward == 0 || num_outward == 192) << num_outward;
  EXPECT_THAT(Find(mesh, RegionUse::kIgnore).triangles, IsEmpty());
}

TEST(FindInterfaces, TakesPartsOfAPartitionAndNumbersOfTetsForNoMaterials) {
  TetMesh mesh = MakeBallInBoxMesh(8);
  mesh.regions = Parts(mesh, 8);
  const Interfaces parts = Find(mesh);
  EXPECT_EQ(parts.num_regions, 8u);
  EXPECT_THAT(parts.triangles, IsEmpty());
  EXPECT_LT(parts.between_regions.fitting_share, 0.4);
  for (std::size_t t = 0; t < mesh.regions.size(); ++t) mesh.regions[t] = static_cast<int>(t);
  const Interfaces numbers = Find(mesh);
  EXPECT_THAT(numbers.triangles, IsEmpty());
  EXPECT_LT(numbers.between_regions.fitting_share, 0.1);
  const std::size_t num_inner = MeshTriangles(mesh).size() - BoundaryTriangles(mesh).size();
  EXPECT_EQ(numbers.between_regions.count, num_inner);
  EXPECT_THAT(InterfaceWarnings(numbers),
              ElementsAre(HasSubstr("between the 3072 regions are taken for no interfaces")));

  const Interfaces all = Find(mesh, RegionUse::kFollow);
  EXPECT_EQ(all.triangles.size(), num_inner);
  EXPECT_THAT(InterfaceWarnings(all), IsEmpty());
}

TEST(FindInterfaces, TakesTaggedTrianglesInsideButNotAListOfAllFaces) {
  TetMesh mesh = MakeBallInBoxMesh(8);
  const auto sphere = Find(mesh).triangles;
  for (std::size_t t = 0; t < mesh.regions.size(); ++t) mesh.regions[t] = static_cast<int>(t);
  // The sphere, whatever the order of its vertices, the boundary, which is none, and what is no face at all.
  for (const auto& [a, b, c] : sphere) mesh.surface_triangles.push_back({c, a, b});
  for (const auto& triangle : BoundaryTriangles(mesh)) mesh.surface_triangles.push_back(triangle);
  mesh.surface_triangles.push_back({0, 400, 728});
  mesh.surface_tags.assign(mesh.surface_triangles.size(), 3);
  const Interfaces interfaces = Find(mesh);
  EXPECT_EQ(interfaces.triangles, sphere);
  EXPECT_FALSE(interfaces.between_regions.are_followed);
  EXPECT_TRUE(interfaces.tagged.are_followed);

  mesh.regions.clear();
  mesh.surface_triangles = MeshTriangles(mesh);
  mesh.surface_tags.assign(mesh.surface_triangles.size(), 0);
  EXPECT_THAT(Find(mesh).triangles, IsEmpty());
  EXPECT_THAT(InterfaceWarnings(Find(mesh)), ElementsAre(HasSubstr("tagged triangles inside are taken for no")));
}

// The interface's normals by areas of faces found anew, and the sphere's.
TEST(AlignToBoundary, AlignsTheInterfaceOfABallAndABox) {
  const TetMesh mesh = MakeBallInBoxMesh(12);
  const BoundaryAlignment alignment = AlignToBoundary(mesh);
  const BoundaryAlignment boundary = AlignToBoundary(mesh, {40, RegionUse::kIgnore});
  // Of the ball's tets, the faces that only one of them has.
  std::map<std::array<int, 3>, int> tets_at;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.regions[t] != 2) continue;
    std::array<int, 4> tet = mesh.tets[t];
    std::sort(tet.begin(), tet.end());
    for (const auto& [i, j, k] : internal::kTetFaces) ++tets_at[{tet[i], tet[j], tet[k]}];
  }
  std::vector<Vector3d> normals(mesh.points.size(), Vector3d::Zero());
  for (const auto& [face, count] : tets_at) {
    if (count != 1) continue;
    for (int i = 0; i < 3; ++i) {
      const Vector3d& p = mesh.points[face[i]];
      const Vector3d a = mesh.points[face[(i + 1) % 3]] - p, b = mesh.points[face[(i + 2) % 3]] - p;
      const Vector3d normal = a.cross(b).normalized();
      const double angle = std::acos(a.dot(b) / a.norm() / b.norm());
      normals[face[i]] += (normal.dot(p) > 0 ? angle : -angle) * normal;
    }
  }
  std::size_t num_on_sphere = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (normals[v].isZero(0)) {
      EXPECT_EQ(alignment.alignments[v].kind(), boundary.alignments[v].kind()) << v;
      continue;
    }
    ++num_on_sphere;
    EXPECT_EQ(boundary.alignments[v].kind(), AlignmentKind::kFree);
    ASSERT_EQ(alignment.alignments[v].kind(), AlignmentKind::kAxis) << v;
    const Vector3d axis = alignment.alignments[v].frame().col(2);
    EXPECT_LT(AngleBetweenLines(axis, normals[v]), 1e-6);
    EXPECT_LT(AngleBetweenLines(axis, mesh.points[v]), 3);
  }
  EXPECT_EQ(num_on_sphere, 6u * 6u * 6u + 2u);
  EXPECT_EQ(alignment.interface_vertices.num_normals, num_on_sphere);
  EXPECT_EQ(alignment.interface_vertices.num_frames, 0u);
  EXPECT_EQ(alignment.num_normals, boundary.num_normals + num_on_sphere);
}

// Sheets at 120 degrees: no frame meets the three normals, so that the line alone is an axis.
TEST(AlignToBoundary, AlignsThreeMaterialsMeetingAlongALine) {
  const TetMesh mesh = MakeFanMesh({1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}, 6);
  const BoundaryAlignment alignment = AlignToBoundary(mesh);
  EXPECT_EQ(alignment.interfaces.triangles.size(), 3u * 6u * 2u);
  for (int v = 1; v < 6; ++v) {
    ASSERT_EQ(alignment.alignments[v].kind(), AlignmentKind::kAxis) << v;
    EXPECT_LT(AngleBetweenLines(alignment.alignments[v].frame().col(2), Vector3d::UnitZ()), 1e-6);
  }
  // The same with the rim's edges marked, and the line's not.
  TetMesh marked = mesh;
  for (int i = 0; i < 12; ++i) marked.feature_edges.push_back({7 * (i + 1), 7 * ((i + 1) % 12 + 1)});
  const BoundaryAlignment with_marks = AlignToBoundary(marked);
  EXPECT_TRUE(with_marks.has_marked_features);
  for (int v = 1; v < 6; ++v) {
    ASSERT_EQ(with_marks.alignments[v].kind(), AlignmentKind::kAxis) << v;
    EXPECT_LT(AngleBetweenLines(with_marks.alignments[v].frame().col(2), Vector3d::UnitZ()), 1e-6);
  }
}

// Two planes that cross at a right angle, and one that ends at another, fix the frame, the planes' own.
TEST(AlignToBoundary, PrescribesFramesWhereInterfacesMeetAtRightAngles) {
  for (const std::vector<int>& regions :
       {std::vector<int>{1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}, std::vector<int>{1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 3, 3}}) {
    const BoundaryAlignment alignment = AlignToBoundary(MakeFanMesh(regions, 6));
    for (int v = 0; v <= 6; ++v) {
      ASSERT_EQ(alignment.alignments[v].kind(), AlignmentKind::kFrame) << v;
      const Matrix3d frame = alignment.alignments[v].frame();
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(frame.cwiseAbs().row(i).maxCoeff(), 1, 1e-9) << v;
    }
  }
}

// A sheet that ends inside: normals within, frames along its rim.
TEST(AlignToBoundary, FollowsATaggedSheetToItsRim) {
  TetMesh mesh = MakeBoxMesh({4, 4, 4}, {4, 4, 4});
  const auto at = [](int i, int j, int k) { return i + 5 * (j + 5 * k); };
  for (int i = 1; i < 3; ++i) {
    for (int j = 1; j < 3; ++j) {
      mesh.surface_triangles.push_back({at(i, j, 2), at(i + 1, j, 2), at(i + 1, j + 1, 2)});
      mesh.surface_triangles.push_back({at(i, j, 2), at(i + 1, j + 1, 2), at(i, j + 1, 2)});
    }
  }
  mesh.surface_tags.assign(8, 1);
  const BoundaryAlignment alignment = AlignToBoundary(mesh);
  ASSERT_EQ(alignment.interfaces.triangles.size(), 8u);
  EXPECT_EQ(alignment.interface_vertices.num_normals, 1u);
  EXPECT_EQ(alignment.interface_vertices.num_frames, 8u);
  EXPECT_EQ(alignment.alignments[at(2, 2, 2)].kind(), AlignmentKind::kAxis);
  EXPECT_NEAR(std::abs(alignment.alignments[at(2, 2, 2)].frame()(2, 2)), 1, 1e-12);
}

}  // namespace
}  // namespace octupole
