#include "octupole/io/spherical_plot.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "test_files.h"

namespace octupole {
namespace {

struct Surface {
  std::vector<double> values;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

// The numbers of the array after the given mark.
std::vector<double> Numbers(const std::string& text, const std::string& mark) {
  const std::size_t begin = text.find('>', text.find(mark)) + 1;
  std::istringstream stream(text.substr(begin, text.find('<', begin) - begin));
  return {std::istream_iterator<double>(stream), {}};
}

Surface ReadSurface(const std::filesystem::path& path) {
  const std::string text = ReadText(path);
  Surface surface;
  surface.values = Numbers(text, "Name=\"value\"");
  const std::vector<double> coordinates = Numbers(text, "NumberOfComponents=\"3\"");
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) surface.points.emplace_back(&coordinates[i]);
  const std::vector<double> corners = Numbers(text, "Name=\"connectivity\"");
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    surface.triangles.push_back(
        {static_cast<int>(corners[i]), static_cast<int>(corners[i + 1]), static_cast<int>(corners[i + 2])});
  }
  return surface;
}

TEST(WriteSphericalPlot, PutsEachPointAtTheMagnitudeOfItsValue) {
  const TemporaryFolder folder;
  Hexadecapole h = Hexadecapole::Unit(4);
  h[0] = -0.5;
  WriteSphericalPlot<4>(folder / "plot.vtp", h, 20);
  const Surface surface = ReadSurface(folder / "plot.vtp");
  ASSERT_EQ(surface.points.size(), 2u + 19 * 40);
  ASSERT_EQ(surface.values.size(), surface.points.size());
  int num_negative = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double radius = surface.points[i].norm();
    EXPECT_NEAR(radius, std::abs(surface.values[i]), 1e-8);
    if (radius < 1e-3) continue;
    EXPECT_NEAR(h.dot(EvaluateBasis<4>(surface.points[i] / radius)), surface.values[i], 1e-5);
    num_negative += surface.values[i] < 0;
  }
  EXPECT_GT(num_negative, 100);
}

// Every edge belongs to two triangles; the triangles are seen from outside.
TEST(WriteSphericalPlot, IsAClosedSurface) {
  const TemporaryFolder folder;
  WriteSphericalPlot<3>(folder / "plot.vtp", Octupole::Unit(3), 10);
  const Surface surface = ReadSurface(folder / "plot.vtp");
  EXPECT_EQ(surface.triangles.size(), 2 * surface.points.size() - 4);
  std::map<std::pair<int, int>, int> edges;
  double volume = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    volume += surface.points[a].dot(surface.points[b].cross(surface.points[c])) / 6;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      ++edges[{std::min(from, to), std::max(from, to)}];
      EXPECT_TRUE(from != to);
    }
  }
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
  EXPECT_GT(volume, 0);
}

TEST(WriteSphericalPlot, RefusesBadInput) {
  const TemporaryFolder folder;
  const Octupole nan = Octupole::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(WriteSphericalPlot<3>(folder / "plot.vtp", nan, 10), std::invalid_argument);
  EXPECT_THROW(WriteSphericalPlot<3>(folder / "plot.vtp", Octupole::Unit(0), 2), std::invalid_argument);
  EXPECT_THROW(WriteSphericalPlot<3>(folder / "missing" / "plot.vtp", Octupole::Unit(0), 10), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "plot.vtp"));
}

}  // namespace
}  // namespace octupole
