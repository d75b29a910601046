#include "octupole/io/cross_field_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "test_files.h"

namespace octupole {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A square of two triangles, which were one face.
const TriangleMesh kSquare = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
const std::vector<Eigen::Matrix3d> kCrosses(4, Eigen::Matrix3d::Identity());
const std::vector<Alignment> kAlignments(4);

TEST(QuarterIndicesOfFaces, AreSums) {
  EXPECT_THAT(QuarterIndicesOfFaces({0, 0, 1, 3}, {1, -2, 4, 3}), ElementsAre(-1, 4, 0, 3));
  EXPECT_THAT(QuarterIndicesOfFaces({}, {}), IsEmpty());
}

// What the arrays hold, surface_command_test.cc sees through meshio.
TEST(WriteCrossField, WritesTrianglesAndArrays) {
  const TemporaryFolder folder;
  WriteCrossField(folder / "a.vtu", kSquare, {0, 0}, kCrosses, kAlignments, {1});
  const std::string text = ReadText(folder / "a.vtu");
  EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos) << text.substr(0, 300);
  for (const char* name : {"tangent_u", "tangent_v", "normal", "alignment", "face", "quarter_index"}) {
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
}

TEST(WriteCrossField, WantsOneOfEach) {
  const TemporaryFolder folder;
  const auto path = folder / "a.vtu";
  EXPECT_THROW(WriteCrossField(path, kSquare, {0, 0}, {}, kAlignments, {1}), std::invalid_argument);
  EXPECT_THROW(WriteCrossField(path, kSquare, {0, 0}, kCrosses, {}, {1}), std::invalid_argument);
  EXPECT_THROW(WriteCrossField(path, kSquare, {0}, kCrosses, kAlignments, {1}), std::invalid_argument);
  EXPECT_THROW(WriteCrossField(path, kSquare, {0, 1}, kCrosses, kAlignments, {1}), std::invalid_argument);
  EXPECT_THROW(WriteCrossField(path, kSquare, {-1, 0}, kCrosses, kAlignments, {1}), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace octupole
