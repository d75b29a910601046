#include "octupole/io/singularity_writer.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;

// What the cells are, field_command_test.cc sees through meshio.
TEST(WriteSingularities, WritesLinesAndVertices) {
  const TemporaryFolder folder;
  SingularCurves curves;
  curves.curves.push_back({TurnType::kQuarter, 3, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 2, 1, {}});
  curves.nodes.push_back({{2, 0, 0}, 4});
  const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<int, 3>> surface = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}};
  WriteSingularities(folder / "a.vtu", curves, points, surface, {0, -1, 1});
  const std::string text = ReadText(folder / "a.vtu");
  // Two segments, a node, two points of the surface.
  EXPECT_NE(text.find("NumberOfPoints=\"6\" NumberOfCells=\"5\""), std::string::npos) << text.substr(0, 300);
  for (const char* name : {"type", "valence", "curve", "num_ends", "quarter_index"}) {
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
  EXPECT_NO_THROW(WriteSingularities(folder / "empty.vtu", {}, {}, {}, {}));
}

TEST(WriteSingularities, WantsOneIndexPerTriangle) {
  const TemporaryFolder folder;
  EXPECT_THROW(WriteSingularities(folder / "a.vtu", {}, {{0, 0, 0}}, {{0, 0, 0}}, {}), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
}

}  // namespace
}  // namespace octupole
