#include "octupole/vtu_writer.h"

#include <algorithm>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "octupole/atomic_file.h"

namespace octupole {
namespace {

/// Writes bytes in base64, in any number of pieces.
class Base64Stream {
 public:
  explicit Base64Stream(std::ostream& out) : out_(out) {}

  void Write(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
      pending_ = pending_ << 8 | bytes[i];
      if (++num_pending_ == 3) {
        Flush();
      }
    }
  }

  /// Ends the data with its padding.
  void Finish() {
    if (num_pending_ > 0) {
      const int num_missing = 3 - num_pending_;
      pending_ <<= 8 * num_missing;
      Flush();
      std::fill(buffer_.end() - num_missing, buffer_.end(), '=');
    }
    out_ << buffer_;
    buffer_.clear();
  }

 private:
  void Flush() {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr std::size_t kBufferSize = 1 << 16;
    if (buffer_.size() >= kBufferSize) {
      out_ << buffer_;
      buffer_.clear();
    }
    for (const int shift : {18, 12, 6, 0}) {
      buffer_ += kDigits[pending_ >> shift & 63];
    }
    pending_ = 0;
    num_pending_ = 0;
  }

  std::ostream& out_;
  std::string buffer_;
  std::uint32_t pending_ = 0;
  int num_pending_ = 0;
};

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

/// Writes a DataArray element. The data are the number of bytes, then the bytes.
void WriteArray(std::ostream& out, std::string_view type, const std::string& name, int components, const void* data,
                std::uint64_t num_bytes) {
  out << "<DataArray type=\"" << type << "\" Name=\"" << XmlEscaped(name) << '"';
  if (components > 1) {  // meshio makes a matrix of one column of an explicit 1
    out << " NumberOfComponents=\"" << components << '"';
  }
  out << " format=\"binary\">";
  Base64Stream base64(out);
  base64.Write(&num_bytes, sizeof(num_bytes));
  base64.Write(data, num_bytes);
  base64.Finish();
  out << "</DataArray>\n";
}

void WritePointArray(std::ostream& out, const VtuArray& array, std::size_t num_points) {
  const std::uint64_t num_values = num_points * array.components;
  if (const auto* doubles = std::get_if<const double*>(&array.values)) {
    WriteArray(out, "Float64", array.name, array.components, *doubles, num_values * sizeof(double));
  } else {
    WriteArray(out, "Int32", array.name, array.components, std::get<const std::int32_t*>(array.values),
               num_values * sizeof(std::int32_t));
  }
}

void WriteContent(std::ostream& out, const TetMesh& mesh, const std::vector<VtuArray>& point_data) {
  constexpr std::uint8_t kVtkTet = 10;
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double) && sizeof(int) == 4);
  const std::uint16_t one = 1;
  std::uint8_t low_byte;
  std::memcpy(&low_byte, &one, 1);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\""
      << (low_byte == 1 ? "LittleEndian" : "BigEndian") << "\" header_type=\"UInt64\">\n"
      << "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" << mesh.points.size() << "\" NumberOfCells=\""
      << mesh.tets.size() << "\">\n<Points>\n";
  WriteArray(out, "Float64", "Points", 3, mesh.points.data(), mesh.points.size() * sizeof(Eigen::Vector3d));
  out << "</Points>\n<Cells>\n";
  WriteArray(out, "Int32", "connectivity", 1, mesh.tets.data(), mesh.tets.size() * sizeof(std::array<int, 4>));
  std::vector<std::int64_t> offsets(mesh.tets.size());
  for (std::size_t t = 0; t < offsets.size(); ++t) {
    offsets[t] = 4 * static_cast<std::int64_t>(t + 1);
  }
  WriteArray(out, "Int64", "offsets", 1, offsets.data(), offsets.size() * sizeof(offsets[0]));
  const std::vector<std::uint8_t> types(mesh.tets.size(), kVtkTet);
  WriteArray(out, "UInt8", "types", 1, types.data(), types.size());
  out << "</Cells>\n<PointData>\n";
  for (const VtuArray& array : point_data) {
    WritePointArray(out, array, mesh.points.size());
  }
  out << "</PointData>\n<CellData>\n";
  if (!mesh.regions.empty()) {
    WriteArray(out, "Int32", "region", 1, mesh.regions.data(), mesh.regions.size() * sizeof(mesh.regions[0]));
  }
  out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void CheckArrays(const std::vector<VtuArray>& point_data) {
  for (std::size_t i = 0; i < point_data.size(); ++i) {
    const VtuArray& array = point_data[i];
    if (array.name.empty()) {
      throw std::invalid_argument("WriteVtu: point array " + std::to_string(i) + " has no name");
    }
    const std::string label = "WriteVtu: point array '" + array.name + "' has ";
    if (array.components < 1) {
      throw std::invalid_argument(label + std::to_string(array.components) + " components");
    }
    if (std::visit([](const auto* values) { return values == nullptr; }, array.values)) {
      throw std::invalid_argument(label + "no values");
    }
  }
}

}  // namespace

void WriteVtu(const std::filesystem::path& path, const TetMesh& mesh, const std::vector<VtuArray>& point_data) {
  CheckArrays(point_data);
  WriteFileAtomically(path, [&](std::ostream& out) { WriteContent(out, mesh, point_data); });
}

}  // namespace octupole
