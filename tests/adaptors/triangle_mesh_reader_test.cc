#include "octupole/adaptors/triangle_mesh_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "test_files.h"

namespace octupole {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using Triangle = std::array<int, 3>;

constexpr const char* kStl =
    "solid part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n"
    " endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 1 0 0\n   vertex 1 1 0\n   vertex 0 1 0\n  endloop\n"
    " endfacet\nendsolid part\n";

class ReadTriangleMeshTest : public testing::Test {
 protected:
  TriangleMesh Read(const std::string& name, const std::string& text) {
    WriteText(folder_ / name, text);
    warnings_.clear();
    return ReadTriangleMesh(folder_ / name, &warnings_, &faces_);
  }

  // What is wrong, without the path.
  std::string Problem(const std::string& name, const std::string& text) {
    const std::string message = MessageOf<std::runtime_error>([&] { Read(name, text); });
    const std::string file = (folder_ / name).string() + ":";
    EXPECT_THAT(message, StartsWith(file));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.size() < file.size() ? message : message.substr(file.size());
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
  std::vector<int> faces_;
};

// OpenMesh would read floats, and nothing of what they cannot hold.
TEST_F(ReadTriangleMeshTest, KeepsAllDigitsOfAnObj) {
  const TriangleMesh mesh =
      Read("a.obj", "v 1000000.123456789 0 0\nv 1000001.123456789 1e-60 0\nv 0 1e60 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.points[0].x(), 1000000.123456789);
  EXPECT_EQ(mesh.points[1], Vector3d(1000001.123456789, 1e-60, 0));
  EXPECT_EQ(mesh.points[2].y(), 1e60);
}

TEST_F(ReadTriangleMeshTest, CutsThePolygonsOfAnObj) {
  const TriangleMesh mesh = Read(
      "a.obj",
      "# a comment\nmtllib /dev/zero\no part\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\n  v 1 1 0 # here, too\nvt 0 0\nvn 0 0 1\n"
      "v 0 1 2.5e0\ng left\nusemtl no\nf 1/1/1 2//1 3 4/1\nf -4 -3 -2\n");
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[3], Vector3d(0, 1, 2.5));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], (Triangle{0, 1, 2}));
  EXPECT_THAT(faces_, ElementsAre(0, 0, 1));
}

TEST_F(ReadTriangleMeshTest, ReadsTheOtherFormats) {
  const std::string coordinates = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(Read("a.off", "OFF\n3 1 0\n" + coordinates + "3 0 1 2\n").triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(Read("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                       coordinates + "3 0 1 2\n")
                  .triangles,
              ElementsAre(Triangle{0, 1, 2}));
  const TriangleMesh text = Read("a.STL", kStl);
  EXPECT_EQ(text.points.size(), 4u);
  EXPECT_THAT(text.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
  EXPECT_THAT(warnings_, IsEmpty());

  std::string binary(80, ' ');
  const auto append = [&binary](const auto& value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    binary.append(bytes, sizeof(value));
  };
  append(std::uint32_t{1});
  for (const float x : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) append(static_cast<float>(x));
  append(std::uint16_t{0});
  EXPECT_THAT(Read("binary.stl", binary).triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(Problem("cut.stl", binary.substr(0, 100)), HasSubstr("STL file"));
}

TEST_F(ReadTriangleMeshTest, NamesTheLineOfWhatIsWrongInAnObj) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(Problem("a.obj", points + "f\n"), "4: a face without vertices");
  EXPECT_EQ(Problem("a.obj", points + "f # 1 2 3\n"), "4: a face without vertices");
  EXPECT_EQ(Problem("a.obj", points + "f 1 2 /3\n"), "4: a face has '' where a vertex was expected");
  EXPECT_EQ(Problem("a.obj", points + "f 1 2 x\n"), "4: a face has 'x' where a vertex was expected");
  EXPECT_EQ(Problem("a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\n"), "2: a vertex has less than three coordinates");
  EXPECT_THAT(Problem("a.obj", "v 0 0 0\nv 1 zero 0\n"), StartsWith("2: 'zero' where a coordinate was expected"));
  EXPECT_THAT(Problem("a.obj", "v 0 0 nan\n"), StartsWith("1: "));
  EXPECT_THAT(Problem("a.obj", points + "f 1 2 4\n"), EndsWith("face 1 has a vertex that is not there"));
  EXPECT_THAT(Problem("a.obj", points + "f 0 1 2\n"), EndsWith("face 1 has a vertex that is not there"));
  EXPECT_THAT(Problem("a.obj", points + "f 1 2 -4\n"), EndsWith("face 1 has a vertex that is not there"));
  EXPECT_EQ(Problem("a.obj", points), " no faces");
}

TEST_F(ReadTriangleMeshTest, NamesTheLineOfWhatIsWrongInThePlyHeader) {
  const std::string start = "ply\nformat ascii 1.0\n";
  EXPECT_EQ(Problem("a.ply", start + "comment x\nproperty float x\n"), "4: a property of no element");
  EXPECT_THAT(Problem("a.ply", start + "elephant vertex 3\n"), StartsWith("3: 'elephant' where a keyword"));
  EXPECT_EQ(Problem("a.ply", start + "element vertex 3\nproperty real x\n"), "4: 'real' is no type of PLY");
  EXPECT_THAT(Problem("a.ply", start + "element vertex 300000000\n"), StartsWith("3: "));
  EXPECT_EQ(Problem("a.ply", start + "element face 1\nproperty list uchar float texcoord\n"),
            "4: a list of something else than corners of faces cannot be read");
  EXPECT_THAT(Problem("a.ply", start + "element vertex 3\n"), StartsWith("3: "));
  EXPECT_EQ(
      Read("info.ply", start + "obj_info element property\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
          .triangles.size(),
      1u);
}

TEST_F(ReadTriangleMeshTest, NoticesAnStlThatIsCutAnywhere) {
  const std::string text = kStl;
  // Behind the last word nothing is missing.
  const std::size_t end = text.rfind("endsolid") + std::string("endsolid").size();
  for (std::size_t length = 0; length < text.size(); ++length) {
    WriteText(folder_ / "cut.stl", text.substr(0, length));
    const std::string message = MessageOf<std::runtime_error>([&] { ReadTriangleMesh(folder_ / "cut.stl"); });
    EXPECT_EQ(message.empty(), length >= end) << length << message;
  }
  EXPECT_THAT(Problem("a.stl", text.substr(0, text.find(" facet", 20))), HasSubstr(":"));
  EXPECT_EQ(Read("two.stl", text + text).triangles.size(), 4u) << "two solids";
  EXPECT_THAT(Problem("one_line.stl",
                      "solid\nfacet normal 0 0 1\nouter loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0\nendloop\n"
                      "endfacet\nendsolid\n"),
              StartsWith("3: "));
}

TEST_F(ReadTriangleMeshTest, LeavesOutFacesOfLessThanThreeCornersAndSaysSo) {
  const TriangleMesh mesh = Read("a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n3 0 1 1\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THAT(faces_, ElementsAre(1));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("2 faces have a corner twice, or less than three corners: left out")));
}

}  // namespace
}  // namespace octupole
