#include "octupole/vtu_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "octupole/box_mesh.h"
#include "test_files.h"

namespace octupole {
namespace {

std::string DecodeBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0);
  std::string bytes;
  unsigned bits = 0;
  int num_bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    num_bits += 6;
    if (num_bits >= 8) {
      num_bits -= 8;
      bytes += static_cast<char>(bits >> num_bits & 255);
    }
  }
  return bytes;
}

/// The numbers of the DataArray whose start tag has all these attributes.
template <typename T>
std::vector<T> ReadArray(const std::string& vtu, const std::string& attributes) {
  const std::size_t tag = vtu.find("<DataArray " + attributes + " format=\"binary\">");
  if (tag == std::string::npos) {
    ADD_FAILURE() << "no array " << attributes;
    return {};
  }
  const std::size_t begin = vtu.find('>', tag) + 1;
  const std::string bytes = DecodeBase64(vtu.substr(begin, vtu.find('<', begin) - begin));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof(size));
  EXPECT_EQ(size + sizeof(size), bytes.size());
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + sizeof(size), size);
  return values;
}

TEST(WriteVtu, KeepsEveryBit) {
  const TemporaryFolder folder;
  TetMesh mesh = MakeBoxMesh({1, 2, 1}, {1.0 / 3.0, 1.0, 1.0});
  const std::size_t num_points = mesh.points.size();
  mesh.points[0].x() = -0.0;
  mesh.points[1].x() = std::numeric_limits<double>::denorm_min();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.regions.push_back(static_cast<int>(t) - 3);
  }
  std::vector<double> vectors(3 * num_points);
  std::vector<std::int32_t> flags(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    vectors[3 * i + 1] = 0.1 * static_cast<double>(i);
    flags[i] = 1 - static_cast<int>(i);
  }
  WriteVtu(folder / "a.vtu", mesh, {{"frame_x", 3, vectors.data()}, {"a<\"&", 1, flags.data()}});

  const std::string vtu = ReadText(folder / "a.vtu");
  EXPECT_NE(vtu.find("byte_order=\"LittleEndian\" header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(vtu.find("<Piece NumberOfPoints=\"12\" NumberOfCells=\"12\">"), std::string::npos);
  const auto points = ReadArray<double>(vtu, R"(type="Float64" Name="Points" NumberOfComponents="3")");
  ASSERT_EQ(points.size(), 3 * num_points);
  EXPECT_EQ(std::memcmp(points.data(), mesh.points.data(), points.size() * sizeof(double)), 0);
  const auto connectivity = ReadArray<std::int32_t>(vtu, R"(type="Int32" Name="connectivity")");
  ASSERT_EQ(connectivity.size(), 4 * mesh.tets.size());
  const auto offsets = ReadArray<std::int64_t>(vtu, R"(type="Int64" Name="offsets")");
  ASSERT_EQ(offsets.size(), mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    EXPECT_EQ(offsets[t], static_cast<std::int64_t>(4 * t + 4));
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(connectivity[4 * t + i], mesh.tets[t][i]);
    }
  }
  EXPECT_EQ(ReadArray<std::uint8_t>(vtu, R"(type="UInt8" Name="types")"),
            std::vector<std::uint8_t>(mesh.tets.size(), 10));
  EXPECT_EQ(ReadArray<double>(vtu, R"(type="Float64" Name="frame_x" NumberOfComponents="3")"), vectors);
  EXPECT_EQ(ReadArray<std::int32_t>(vtu, R"(type="Int32" Name="a&lt;&quot;&amp;")"), flags);
  EXPECT_EQ(ReadArray<int>(vtu, R"(type="Int32" Name="region")"), mesh.regions);
}

TEST(WriteVtu, PadsAnyNumberOfBytes) {
  // The cell types take one byte each, so these meshes end base64 in all three ways.
  const TemporaryFolder folder;
  TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  for (const std::size_t num_tets : {6, 5, 4}) {
    mesh.tets.resize(num_tets);
    WriteVtu(folder / "a.vtu", mesh, {});
    EXPECT_EQ(ReadArray<std::uint8_t>(ReadText(folder / "a.vtu"), R"(type="UInt8" Name="types")").size(), num_tets);
  }
}

TEST(WriteVtu, LeavesOutRegionsIfThereAreNone) {
  const TemporaryFolder folder;
  WriteVtu(folder / "a.vtu", MakeBoxMesh({1, 1, 1}, {1, 1, 1}), {});
  EXPECT_EQ(ReadText(folder / "a.vtu").find("region"), std::string::npos);
}

TEST(WriteVtu, WritesNumbersAlikeInAnyLocale) {
  const TemporaryFolder folder;
  const TetMesh mesh = MakeBoxMesh({10, 10, 10}, {1, 1, 1});
  WriteVtu(folder / "a.vtu", mesh, {});
  const ScopedCommaLocale locale;
  WriteVtu(folder / "b.vtu", mesh, {});
  EXPECT_EQ(ReadText(folder / "a.vtu"), ReadText(folder / "b.vtu"));
}

TEST(WriteVtu, RefusesBadArrays) {
  const TetMesh mesh = MakeBoxMesh({1, 1, 1}, {1, 1, 1});
  const double value = 0.0;
  const auto message = [&](const VtuArray& array) {
    return MessageOf<std::invalid_argument>([&] { WriteVtu("unused.vtu", mesh, {array}); });
  };
  EXPECT_EQ(message({"", 1, &value}), "WriteVtu: point array 0 has no name");
  EXPECT_EQ(message({"a", 0, &value}), "WriteVtu: point array 'a' has 0 components");
  EXPECT_EQ(message({"a", 1, static_cast<const double*>(nullptr)}), "WriteVtu: point array 'a' has no values");
}

TEST(WriteVtu, NamesThePathThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "missing/a.vtu";
  EXPECT_EQ(MessageOf<std::runtime_error>([&] {
              WriteVtu(path, MakeBoxMesh({1, 1, 1}, {1, 1, 1}), {});
            }),
            path.string() + ": cannot be written: No such file or directory");
}

}  // namespace
}  // namespace octupole
