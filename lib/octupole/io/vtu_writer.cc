#include "octupole/io/vtu_writer.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "octupole/io/atomic_file.h"

namespace octupole {
namespace {

std::string Base64Of(const unsigned char* bytes, std::size_t size) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text(4 * ((size + 2) / 3), '=');
  char* next = text.data();
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t num_bytes = std::min<std::size_t>(3, size - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < num_bytes ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k <= num_bytes; ++k) next[k] = kDigits[bits >> (18 - 6 * k) & 63];
    next += 4;
  }
  return text;
}

// In pieces, so that the text of a large array never is in memory as a whole.
void WriteBase64(std::ostream& out, const void* data, std::size_t size) {
  constexpr std::size_t kPiece = 3 << 14;
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; i += kPiece) out << Base64Of(bytes + i, std::min(kPiece, size - i));
}

std::string XmlEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

// The number of points of a cell.
std::size_t SizeOf(VtuCellType type) {
  switch (type) {
    case VtuCellType::kVertex:
      return 1;
    case VtuCellType::kLine:
      return 2;
    case VtuCellType::kTriangle:
      return 3;
    case VtuCellType::kTet:
      return 4;
    case VtuCellType::kHexahedron:
      break;
  }
  return 8;
}

std::size_t CountCells(const std::vector<VtuCells>& cells) {
  std::size_t count = 0;
  for (const VtuCells& block : cells) count += block.count;
  return count;
}

// Appends a zlib stream to `compressed`. Run lengths and Huffman codes find most of what there is to find in
// coordinates and indices, at several times the speed of zlib's search for repetitions.
void Compress(int level, const Bytef* data, std::size_t size, std::vector<Bytef>* compressed) {
  z_stream stream = {};
  constexpr int kLargestWindow = 15, kDefaultMemory = 8;
  if (deflateInit2(&stream, level, Z_DEFLATED, kLargestWindow, kDefaultMemory, Z_RLE) != Z_OK) {
    throw std::bad_alloc();
  }
  const std::size_t begin = compressed->size();
  compressed->resize(begin + deflateBound(&stream, size));
  stream.next_in = const_cast<Bytef*>(data);  // zlib 1.2 declares what it only reads as mutable
  stream.avail_in = static_cast<uInt>(size);
  stream.next_out = compressed->data() + begin;
  stream.avail_out = static_cast<uInt>(compressed->size() - begin);
  deflate(&stream, Z_FINISH);
  compressed->resize(begin + stream.total_out);
  deflateEnd(&stream);
}

// Writes a DataArray element. Its data are the number of blocks, their size and that of the last one if it is smaller,
// their compressed sizes; then the blocks.
void WriteArray(std::ostream& out, std::string_view type, const std::string& name, int components, const void* data,
                std::uint64_t num_bytes) {
  constexpr std::uint64_t kBlockSize = 1 << 18;
  std::vector<std::uint64_t> header = {(num_bytes + kBlockSize - 1) / kBlockSize, kBlockSize, num_bytes % kBlockSize};
  std::vector<Bytef> blocks;
  int level = Z_BEST_SPEED;
  for (std::uint64_t begin = 0; begin < num_bytes; begin += kBlockSize) {
    const std::uint64_t size = std::min(kBlockSize, num_bytes - begin), previous_size = blocks.size();
    Compress(level, static_cast<const Bytef*>(data) + begin, size, &blocks);
    header.push_back(blocks.size() - previous_size);
    // Most doubles hardly shrink, and so will those that follow.
    if (header.back() > size / 5 * 4) level = Z_NO_COMPRESSION;
  }
  out << "<DataArray type=\"" << type << "\" Name=\"" << XmlEscaped(name) << '"';
  if (components > 1) {  // meshio makes a matrix of one column of an explicit 1
    out << " NumberOfComponents=\"" << components << '"';
  }
  out << " format=\"binary\">";
  WriteBase64(out, header.data(), header.size() * sizeof(header[0]));
  WriteBase64(out, blocks.data(), blocks.size());
  out << "</DataArray>\n";
}

void WriteArray(std::ostream& out, const VtuArray& array, std::size_t count) {
  const std::uint64_t num_values = count * array.components;
  if (const auto* doubles = std::get_if<const double*>(&array.values)) {
    WriteArray(out, "Float64", array.name, array.components, *doubles, num_values * sizeof(double));
  } else {
    WriteArray(out, "Int32", array.name, array.components, std::get<const std::int32_t*>(array.values),
               num_values * sizeof(std::int32_t));
  }
}

template <typename Number>
void WriteArray(std::ostream& out, std::string_view type, const std::string& name, const std::vector<Number>& values) {
  WriteArray(out, type, name, 1, values.data(), values.size() * sizeof(Number));
}

void WriteConnectivity(std::ostream& out, const std::vector<VtuCells>& cells) {
  constexpr const char* kType = "Int32";
  constexpr const char* kName = "connectivity";
  if (cells.size() == 1) {  // as they are, for they may be many
    const std::size_t count = SizeOf(cells[0].type) * cells[0].count;
    WriteArray(out, kType, kName, 1, cells[0].vertices, count * sizeof(std::int32_t));
    return;
  }
  std::vector<std::int32_t> all;
  for (const VtuCells& block : cells) {
    all.insert(all.end(), block.vertices, block.vertices + SizeOf(block.type) * block.count);
  }
  WriteArray(out, kType, kName, all);
}

void WriteCells(std::ostream& out, const std::vector<VtuCells>& cells, std::size_t num_cells) {
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  offsets.reserve(num_cells);
  types.reserve(num_cells);
  for (const VtuCells& block : cells) {
    const auto size = static_cast<std::int64_t>(SizeOf(block.type));
    for (std::size_t c = 0; c < block.count; ++c) offsets.push_back((offsets.empty() ? 0 : offsets.back()) + size);
    types.insert(types.end(), block.count, static_cast<std::uint8_t>(block.type));
  }
  out << "<Cells>\n";
  WriteConnectivity(out, cells);
  WriteArray(out, "Int64", "offsets", offsets);
  WriteArray(out, "UInt8", "types", types);
  out << "</Cells>\n";
}

void WriteContent(std::ostream& out, const std::vector<Eigen::Vector3d>& points, const std::vector<VtuCells>& cells,
                  const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double) && sizeof(int) == 4);
  const std::uint16_t one = 1;
  std::uint8_t low_byte;
  std::memcpy(&low_byte, &one, 1);
  const std::size_t num_cells = CountCells(cells);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (low_byte == 1 ? "LittleEndian" : "BigEndian")
      << "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
      << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << points.size() << "\" NumberOfCells=\"" << num_cells
      << "\">\n<Points>\n";
  WriteArray(out, "Float64", "Points", 3, points.data(), points.size() * sizeof(Eigen::Vector3d));
  out << "</Points>\n";
  WriteCells(out, cells, num_cells);
  out << "<PointData>\n";
  for (const VtuArray& array : point_data) WriteArray(out, array, points.size());
  out << "</PointData>\n<CellData>\n";
  for (const VtuArray& array : cell_data) WriteArray(out, array, num_cells);
  out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void CheckArrays(const char* kind, const std::vector<VtuArray>& arrays, std::size_t count) {
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const VtuArray& array = arrays[i];
    if (array.name.empty()) {
      throw std::invalid_argument(std::string("WriteVtu: ") + kind + " array " + std::to_string(i) + " has no name");
    }
    const std::string label = std::string("WriteVtu: ") + kind + " array '" + array.name + "' has ";
    if (array.components < 1) {
      throw std::invalid_argument(label + std::to_string(array.components) + " components");
    }
    if (count > 0 && std::visit([](const auto* values) { return values == nullptr; }, array.values)) {
      throw std::invalid_argument(label + "no values");
    }
  }
}

void CheckCells(const std::vector<VtuCells>& cells, std::size_t num_points) {
  std::size_t first_cell = 0;
  for (const VtuCells& block : cells) {
    const std::size_t size = SizeOf(block.type);
    for (std::size_t i = 0; i < size * block.count; ++i) {
      if (block.vertices[i] >= 0 && static_cast<std::size_t>(block.vertices[i]) < num_points) continue;
      throw std::invalid_argument("WriteVtu: cell " + std::to_string(first_cell + i / size) + " has the point " +
                                  std::to_string(block.vertices[i]) + ", out of range 0.." +
                                  std::to_string(static_cast<std::int64_t>(num_points) - 1));
    }
    first_cell += block.count;
  }
}

}  // namespace

void WriteVtu(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
              const std::vector<VtuCells>& cells, const std::vector<VtuArray>& point_data,
              const std::vector<VtuArray>& cell_data) {
  CheckCells(cells, points.size());
  CheckArrays("point", point_data, points.size());
  CheckArrays("cell", cell_data, CountCells(cells));
  WriteFileAtomically(path, [&](std::ostream& out) { WriteContent(out, points, cells, point_data, cell_data); });
}

VtuCells CellsOf(const TetMesh& mesh) {
  return {VtuCellType::kTet, reinterpret_cast<const int*>(mesh.tets.data()), mesh.tets.size()};
}

void WriteVtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<VtuArray>& point_data) {
  std::vector<VtuArray> cell_data;
  if (!mesh.regions.empty()) cell_data.push_back({"region", 1, mesh.regions.data()});
  WriteVtu(path, mesh.points, {CellsOf(mesh)}, point_data, cell_data);
}

}  // namespace octupole
