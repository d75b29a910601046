// Maps that are written and read again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "octupole/io/map_reader.h"
#include "octupole/io/map_writer.h"
#include "octupole/mesh/box_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

using testing::HasSubstr;

TEST(ReadHexEx, ReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const TetMesh mesh = MakeBoxMesh({2, 1, 1}, {1, 0.3, 0.7});
  CornerParameters parameters(mesh.tets.size());
  for (std::size_t t = 0; t < parameters.size(); ++t) {
    for (int i = 0; i < 4; ++i) parameters[t][i] = Eigen::Vector3d(0.1, 1e-17, 3) * static_cast<double>(4 * t + i);
  }
  WriteHexEx(folder / "a.hexex", mesh, parameters);
  const MeshMap map = ReadHexEx(folder / "a.hexex");
  EXPECT_EQ(map.mesh.points, mesh.points);
  EXPECT_EQ(map.mesh.tets, mesh.tets);
  EXPECT_EQ(map.parameters, parameters);
}

TEST(ReadHexEx, NamesFileLineAndCause) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    WriteText(folder / "a.hexex", text);
    return MessageOf<std::runtime_error>([&] { ReadHexEx(folder / "a.hexex"); });
  };
  const std::string points = "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", zeros = " 0 0 0 0 0 0 0 0 0 0 0 0\n";
  EXPECT_THAT(message("-1\n"), HasSubstr("a.hexex:1: "));
  EXPECT_THAT(message(points + "1\n0 1 2 4" + zeros), HasSubstr("a.hexex:7: vertex index 4 is out of range 0..3"));
  EXPECT_THAT(message(points + "1\n0 1 2 2" + zeros), HasSubstr("a.hexex:7: a tetrahedron has vertex 2 twice"));
  EXPECT_THAT(message(points + "1\n0 1 2 3 nan 0 0 0 0 0 0 0 0 0 0 0\n"), HasSubstr("a.hexex:7: "));
  EXPECT_THAT(message(points + "1\n0 1 2 3" + zeros + "0"), HasSubstr("more tetrahedra than announced"));
  EXPECT_THAT(message(points + "0\n"), HasSubstr("no tetrahedra"));
  EXPECT_THAT(message(points + "2\n0 1 2 3" + zeros), HasSubstr("a.hexex:"));
  EXPECT_THAT(MessageOf<std::runtime_error>([&] { ReadHexEx(folder / "none.hexex"); }), HasSubstr("none.hexex"));
}

}  // namespace
}  // namespace octupole
