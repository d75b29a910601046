#include "octupole/io/vtu_writer.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "octupole/mesh/box_mesh.h"
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
  const std::string text = vtu.substr(begin, vtu.find('<', begin) - begin);
  // The header, of 3 numbers and one per block, is encoded on its own.
  std::uint64_t num_blocks = 0;
  std::memcpy(&num_blocks, DecodeBase64(text.substr(0, 12)).data(), sizeof(num_blocks));
  std::vector<std::uint64_t> header(3 + num_blocks);
  const std::size_t header_length = (header.size() * sizeof(header[0]) + 2) / 3 * 4;
  std::memcpy(header.data(), DecodeBase64(text.substr(0, header_length)).data(), header.size() * sizeof(header[0]));
  const std::string blocks = DecodeBase64(text.substr(header_length));
  std::string bytes;
  std::size_t next = 0;
  for (std::size_t i = 0; i < num_blocks; ++i) {
    const bool is_partial = i + 1 == num_blocks && header[2] > 0;
    std::string block(is_partial ? header[2] : header[1], 0);
    uLongf size = block.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                         reinterpret_cast<const Bytef*>(blocks.data()) + next, header[3 + i]),
              Z_OK);
    EXPECT_EQ(size, block.size());
    bytes += block;
    next += header[3 + i];
  }
  EXPECT_EQ(next, blocks.size());
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
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
  EXPECT_NE(vtu.find("byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""),
            std::string::npos);
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

TEST(WriteVtu, WritesAnyNumberOfBytes) {
  // One double per vertex cell: no block, one that is not full, a full one of 256 KiB, and two.
  const TemporaryFolder folder;
  constexpr std::size_t kFull = (1 << 18) / sizeof(double);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kFull, kFull + 1}) {
    const std::vector<Eigen::Vector3d> point(1, {1, 2, 3});
    const std::vector<int> vertices(size, 0);
    std::vector<double> values(size);
    for (std::size_t i = 0; i < size; ++i) values[i] = 1 / (1. + static_cast<double>(i));
    WriteVtu(folder / "a.vtu", point, {{VtuCellType::kVertex, vertices.data(), size}}, {}, {{"x", 1, values.data()}});
    EXPECT_EQ(ReadArray<double>(ReadText(folder / "a.vtu"), R"(type="Float64" Name="x")"), values);
  }
}

TEST(WriteVtu, TakesSeveralKindsOfCells) {
  const TemporaryFolder folder;
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<int> lines = {0, 1, 1, 2}, vertices = {2}, triangles = {0, 1, 2};
  const std::vector<std::int32_t> numbers = {7, 8, 9, 10};
  WriteVtu(folder / "a.vtu", points,
           {{VtuCellType::kLine, lines.data(), 2},
            {VtuCellType::kVertex, vertices.data(), 1},
            {VtuCellType::kTriangle, triangles.data(), 1}},
           {}, {{"number", 1, numbers.data()}});
  const std::string vtu = ReadText(folder / "a.vtu");
  EXPECT_NE(vtu.find("<Piece NumberOfPoints=\"3\" NumberOfCells=\"4\">"), std::string::npos);
  EXPECT_EQ(ReadArray<std::int32_t>(vtu, R"(type="Int32" Name="connectivity")"),
            (std::vector<std::int32_t>{0, 1, 1, 2, 2, 0, 1, 2}));
  EXPECT_EQ(ReadArray<std::int64_t>(vtu, R"(type="Int64" Name="offsets")"), (std::vector<std::int64_t>{2, 4, 5, 8}));
  EXPECT_EQ(ReadArray<std::uint8_t>(vtu, R"(type="UInt8" Name="types")"), (std::vector<std::uint8_t>{3, 3, 1, 5}));
  EXPECT_EQ(ReadArray<std::int32_t>(vtu, R"(type="Int32" Name="number")"), numbers);
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
  const int vertices[] = {0, 1, 8, 2};
  EXPECT_EQ(MessageOf<std::invalid_argument>([&] {
              WriteVtu("unused.vtu", mesh.points, {{VtuCellType::kLine, vertices, 2}}, {}, {});
            }),
            "WriteVtu: cell 1 has the point 8, out of range 0..7");
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
