#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "octupole/readers/internal/mesh_readers.h"
#include "octupole/readers/internal/number_bytes.h"
#include "octupole/readers/internal/vtk_cells.h"

namespace octupole::internal {
namespace {

std::optional<NumberType> FindArrayType(std::string_view name) {
  constexpr std::pair<std::string_view, NumberType> kTypes[] = {
      {"Float32", NumberType::kFloat32}, {"Float64", NumberType::kFloat64}, {"Int8", NumberType::kInt8},
      {"UInt8", NumberType::kUInt8},     {"Int16", NumberType::kInt16},     {"UInt16", NumberType::kUInt16},
      {"Int32", NumberType::kInt32},     {"UInt32", NumberType::kUInt32},   {"Int64", NumberType::kInt64},
      {"UInt64", NumberType::kUInt64},
  };
  for (const auto& [type_name, type] : kTypes) {
    if (type_name == name) {
      return type;
    }
  }
  return std::nullopt;
}

/// The value of each base64 digit, else -1.
constexpr std::array<int, 256> MakeBase64Values() {
  std::array<int, 256> values = {};
  for (int& value : values) {
    value = -1;
  }
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<int>(i);
  }
  return values;
}

/// Takes bytes out of a text, where they are as they are or in base64. Several pieces of base64 may
/// follow each other, each with its padding.
class ByteSource {
 public:
  ByteSource(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// At most so many bytes are left.
  std::int64_t max_size() const {
    return static_cast<std::int64_t>(is_base64_ ? text_.size() / 4 * 3 + decoded_.size() : text_.size());
  }

  /// The next bytes, less than `count` if the text ends. Valid until the next call.
  std::string_view Next(std::size_t count) {
    if (!is_base64_) {
      const std::string_view bytes = text_.substr(0, count);
      text_.remove_prefix(bytes.size());
      return bytes;
    }
    decoded_.erase(0, num_taken_);
    while (decoded_.size() < count && (DecodeFullGroups((count - decoded_.size()) / 3) || DecodeGroup())) {
    }
    num_taken_ = std::min(count, decoded_.size());
    return {decoded_.data(), num_taken_};
  }

 private:
  static constexpr std::array<int, 256> kValues = MakeBase64Values();

  /// Decodes groups of four digits as long as nothing stands between them, at most so many; false if there are none.
  bool DecodeFullGroups(std::size_t max_count) {
    std::array<char, 3 * 1024> bytes;
    char* next = bytes.data();
    for (max_count = std::min({max_count, text_.size() / 4, bytes.size() / 3}); max_count > 0; --max_count) {
      const auto value = [&](int i) -> int { return kValues[static_cast<unsigned char>(text_[i])]; };
      if ((value(0) | value(1) | value(2) | value(3)) < 0) {
        break;
      }
      *next++ = static_cast<char>(value(0) << 2 | value(1) >> 4);
      *next++ = static_cast<char>(value(1) << 4 | value(2) >> 2);
      *next++ = static_cast<char>(value(2) << 6 | value(3));
      text_.remove_prefix(4);
    }
    decoded_.append(bytes.data(), next);
    return next != bytes.data();
  }

  /// Decodes four digits that may have white space between them and padding at the end; false if there are no more.
  bool DecodeGroup() {
    std::uint32_t bits = 0;
    int num_digits = 0;
    int num_padding = 0;
    std::size_t i = 0;
    for (; i < text_.size() && num_digits + num_padding < 4; ++i) {
      const int value = kValues[static_cast<unsigned char>(text_[i])];
      if (value >= 0 && num_padding == 0) {
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        ++num_digits;
      } else if (text_[i] == '=') {
        bits <<= 6;
        ++num_padding;
      } else if (value >= 0 || (text_[i] != '\n' && text_[i] != '\r' && text_[i] != ' ' && text_[i] != '\t')) {
        return false;
      }
    }
    text_.remove_prefix(i);
    if (num_digits < 2 || num_digits + num_padding < 4) {
      return false;
    }
    const char bytes[3] = {static_cast<char>(bits >> 16), static_cast<char>(bits >> 8), static_cast<char>(bits)};
    decoded_.append(bytes, static_cast<std::size_t>(num_digits) - 1);
    return true;
  }

  std::string_view text_;
  bool is_base64_;
  std::string decoded_;
  std::size_t num_taken_ = 0;
};

class VtuReader {
 public:
  /// `content`, if given, receives cells and arrays.
  explicit VtuReader(const NamedText& file, VtuContent* content = nullptr)
      : path_(file.path), with_other_volumes_(file.with_other_volumes), content_(content) {
    // What is appended may be raw bytes, which are no XML, so the XML ends before.
    const std::size_t end = file.text.find("<AppendedData");
    xml_ = file.text.substr(0, end);
    if (end != std::string_view::npos) {
      const std::size_t tag_end = std::min(file.text.find('>', end), file.text.size());
      appended_is_base64_ = file.text.substr(end, tag_end - end).find("base64") != std::string_view::npos;
      const std::size_t begin = std::min(file.text.find('_', tag_end), file.text.size() - 1) + 1;
      appended_ = file.text.substr(begin);
      xml_ += "</VTKFile>";
    }
    last_position_ = xml_.data();
  }

  ParsedMesh Read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer_inplace(xml_.data(), xml_.size(), pugi::parse_minimal, pugi::encoding_utf8);
    if (!parsed) {
      Fail(LineAt(xml_.data() + parsed.offset), std::string("this is no XML: ") + parsed.description());
    }
    const pugi::xml_node root = Child(document, "VTKFile");
    ReadHeader(root);
    for (const pugi::xml_node& piece : Child(root, "UnstructuredGrid").children("Piece")) {
      ReadPiece(piece);
    }
    if (result_.mesh.regions.size() != result_.mesh.tets.size()) {
      result_.mesh.regions.clear();  // not all pieces have some
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(int line, const std::string& message) const {
    throw std::runtime_error(path_ + ":" + std::to_string(line) + ": " + message);
  }

  [[noreturn]] void Fail(const pugi::xml_node& node, const std::string& message) const { Fail(LineAt(node), message); }

  int LineAt(const pugi::xml_node& node) const {
    return LineAt(xml_.data() + std::max<std::ptrdiff_t>(0, node.offset_debug()));
  }

  /// Counts on from the line that was asked for last, so that files of many pieces take no time.
  int LineAt(const char* position) const {
    last_line_ +=
        static_cast<int>(std::count(std::min(last_position_, position), std::max(last_position_, position), '\n') *
                         (position < last_position_ ? -1 : 1));
    last_position_ = position;
    return last_line_;
  }

  pugi::xml_node Child(const pugi::xml_node& node, const char* name) const {
    const pugi::xml_node child = node.child(name);
    if (!child) {
      Fail(node, std::string("the element ") + name + " is missing");
    }
    return child;
  }

  void ReadHeader(const pugi::xml_node& root) {
    if (const std::string_view type = root.attribute("type").value(); type != "UnstructuredGrid") {
      Fail(root, "a VTK file of type " + Quoted(type) + ", only UnstructuredGrid is read");
    }
    swap_ = (std::string_view(root.attribute("byte_order").value()) == "BigEndian") == IsLittleEndian();
    const std::string_view header_type = root.attribute("header_type").as_string("UInt32");
    if (header_type != "UInt32" && header_type != "UInt64") {
      Fail(root, "the header type " + Quoted(header_type) + " is neither UInt32 nor UInt64");
    }
    header_size_ = header_type == "UInt64" ? 8 : 4;
    compressor_ = root.attribute("compressor").value();
  }

  std::int64_t NextAttribute(const pugi::xml_node& node, const char* name, std::int64_t highest) const {
    const std::string_view text = node.attribute(name).value();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || value < 0 || value > highest) {
      Fail(node, Quoted(text) + " as " + name);
    }
    return value;
  }

  void ReadPiece(const pugi::xml_node& piece) {
    constexpr int kMaxInt = std::numeric_limits<int>::max();
    std::vector<Eigen::Vector3d>& points = result_.mesh.points;
    const std::size_t first_point = points.size();
    const std::int64_t num_points =
        NextAttribute(piece, "NumberOfPoints", kMaxInt - static_cast<std::int64_t>(first_point));
    const std::int64_t num_cells = NextAttribute(piece, "NumberOfCells", kMaxInt);
    if (num_points > 0) {
      ReadPoints(Child(Child(piece, "Points"), "DataArray"), num_points);
    }
    if (content_ != nullptr) {
      ReadArrays(piece.child("PointData"), num_points, &content_->point_arrays);
      ReadArrays(piece.child("CellData"), num_cells, &content_->cell_arrays);
    }
    if (num_cells == 0) {
      return;
    }
    const pugi::xml_node cells_node = Child(piece, "Cells");
    const pugi::xml_node connectivity = ArrayOfName(cells_node, "connectivity");
    const pugi::xml_node offsets = ArrayOfName(cells_node, "offsets");
    VtkCells cells;
    cells.with_other_volumes = with_other_volumes_;
    cells.types = ReadIntegers<int>(ArrayOfName(cells_node, "types"), num_cells);
    cells.ends = ReadIntegers<std::int64_t>(offsets, num_cells);
    std::int64_t previous = 0;
    for (const std::int64_t end : cells.ends) {
      if (end < previous) {
        Fail(offsets, "offset " + std::to_string(end) + " does not fit behind " + std::to_string(previous));
      }
      previous = end;
    }
    cells.connectivity = ReadIntegers<std::int64_t>(connectivity, previous);
    for (const pugi::xml_node& array : piece.child("CellData").children("DataArray")) {
      const std::optional<NumberType> type = FindArrayType(array.attribute("type").value());
      if (cells.regions.empty() && type && IsInteger(*type) && array.attribute("NumberOfComponents").as_int(1) == 1) {
        cells.regions = ReadIntegers<int>(array, num_cells);
      }
    }
    AddVtkCells(
        cells, first_point,
        [&](std::int64_t entry, const std::string& message) { FailAtEntry(connectivity, entry, message); }, &result_);
    if (content_ != nullptr) AddCells(cells, connectivity, static_cast<std::int64_t>(first_point), num_points);
  }

  void ReadArrays(const pugi::xml_node& data, std::int64_t count, std::map<std::string, std::vector<double>>* arrays) {
    for (const pugi::xml_node& array : data.children("DataArray")) {
      if (!FindArrayType(array.attribute("type").value())) continue;  // such as strings
      constexpr std::int64_t kMaxComponents = 1000;
      const std::int64_t components =
          array.attribute("NumberOfComponents") ? NextAttribute(array, "NumberOfComponents", kMaxComponents) : 1;
      std::vector<double>& numbers = (*arrays)[array.attribute("Name").value()];
      ReadNumbers(array, count * components, [&](auto x) { numbers.push_back(static_cast<double>(x)); });
    }
  }

  void AddCells(const VtkCells& piece, const pugi::xml_node& connectivity, std::int64_t first_point,
                std::int64_t num_points) {
    VtkCells& all = content_->cells;
    const auto first_entry = static_cast<std::int64_t>(all.connectivity.size());
    all.types.insert(all.types.end(), piece.types.begin(), piece.types.end());
    for (const std::int64_t end : piece.ends) all.ends.push_back(first_entry + end);
    for (const std::int64_t v : piece.connectivity) {
      if (v < 0 || v >= num_points) Fail(connectivity, "vertex index " + std::to_string(v) + " is out of range");
      all.connectivity.push_back(first_point + v);
    }
  }

  pugi::xml_node ArrayOfName(const pugi::xml_node& node, const char* name) const {
    const pugi::xml_node array = node.find_child_by_attribute("DataArray", "Name", name);
    if (!array) {
      Fail(node, std::string("the DataArray ") + name + " is missing");
    }
    return array;
  }

  void ReadPoints(const pugi::xml_node& array, std::int64_t num_points) {
    if (const int components = array.attribute("NumberOfComponents").as_int(3); components != 3) {
      Fail(array, "points of " + std::to_string(components) + " coordinates");
    }
    std::vector<Eigen::Vector3d>& points = result_.mesh.points;
    int i = 0;
    ReadNumbers(array, 3 * num_points, [&](auto x) {
      if (i == 0) {
        points.emplace_back();
      }
      points.back()[i] = static_cast<double>(x);
      if (!std::isfinite(points.back()[i])) {
        Fail(array,
             "point " + std::to_string(points.size() - 1) + " has the coordinate " + std::to_string(points.back()[i]));
      }
      i = (i + 1) % 3;
    });
  }

  template <typename Integer>
  std::vector<Integer> ReadIntegers(const pugi::xml_node& array, std::int64_t count) {
    std::vector<Integer> numbers;
    ReadNumbers(array, count, [&](auto number) {
      if constexpr (std::is_integral_v<decltype(number)>) {
        numbers.push_back(static_cast<Integer>(number));
        if (static_cast<decltype(number)>(numbers.back()) != number) {
          Fail(array, std::to_string(number) + " is too large");
        }
      } else {
        Fail(array, "real numbers where integers were expected");
      }
    });
    return numbers;
  }

  /// Calls take(number) for each of the numbers of a DataArray, which have to be `count`.
  template <typename Take>
  void ReadNumbers(const pugi::xml_node& array, std::int64_t count, const Take& take) {
    const std::string_view type_name = array.attribute("type").value();
    const std::optional<NumberType> type = FindArrayType(type_name);
    if (!type) {
      Fail(array, "the type " + Quoted(type_name) + " of a DataArray is not known");
    }
    const std::string_view format = array.attribute("format").as_string("ascii");
    if (format == "ascii") {
      TextTokenizer tokens = Tokens(array);
      tokens.CheckCount(count, "numbers", 2);
      for (std::int64_t i = 0; i < count; ++i) {
        IsInteger(*type) ? take(tokens.NextInteger("an integer")) : take(tokens.NextReal("a number"));
      }
      if (!tokens.AtEnd()) {
        tokens.NextWord();
        tokens.Fail("more than " + std::to_string(count) + " numbers");
      }
    } else if (format == "binary") {
      ForEachNumber(ReadBytes(array, ByteSource(array.child_value(), true), count, SizeOf(*type)), *type, swap_, take);
    } else if (format == "appended") {
      const auto offset =
          static_cast<std::size_t>(NextAttribute(array, "offset", static_cast<std::int64_t>(appended_.size())));
      ForEachNumber(ReadBytes(array, ByteSource(appended_.substr(offset), appended_is_base64_), count, SizeOf(*type)),
                    *type, swap_, take);
    } else {
      Fail(array, "the format " + Quoted(format) + " of a DataArray is none of ascii, binary and appended");
    }
  }

  TextTokenizer Tokens(const pugi::xml_node& array) const {
    const char* text = array.child_value();
    return TextTokenizer(path_, text, TextTokenizer::kNoComments, *text == '\0' ? LineAt(array) : LineAt(text));
  }

  /// The bytes of `count` numbers. Before them are their size, or for each compressed block its size.
  std::string ReadBytes(const pugi::xml_node& array, ByteSource source, std::int64_t count, int bytes_each) const {
    constexpr std::int64_t kLargestRatio = 1032;  // of deflate
    if (count / kLargestRatio > source.max_size()) {
      Fail(array, std::to_string(count) + " numbers announced, but only " + std::to_string(source.max_size()) +
                      " bytes follow");
    }
    const std::int64_t size = count * bytes_each;
    if (size == 0) {
      return "";
    }
    if (compressor_.empty()) {
      CheckSize(array, NextHeader(array, &source), size);
      return std::string(Next(array, &source, size));
    }
    if (compressor_ != "vtkZLibDataCompressor") {
      Fail(array, "data compressed by " + Quoted(compressor_) + " are not read, only by 'vtkZLibDataCompressor'");
    }
    const std::uint64_t num_blocks = NextHeader(array, &source);
    const std::uint64_t block_size = NextHeader(array, &source);
    const std::uint64_t last_size = NextHeader(array, &source);
    if (num_blocks == 0 || num_blocks > static_cast<std::uint64_t>(source.max_size()) || block_size == 0 ||
        num_blocks - 1 > static_cast<std::uint64_t>(size) / block_size || last_size > block_size) {
      Fail(array, std::to_string(num_blocks) + " blocks of " + std::to_string(block_size) + " bytes, the last of " +
                      std::to_string(last_size) + ", where " + std::to_string(size) + " bytes were expected");
    }
    const std::uint64_t true_last_size = last_size == 0 ? block_size : last_size;
    CheckSize(array, (num_blocks - 1) * block_size + true_last_size, size);
    std::vector<std::uint64_t> compressed_sizes(num_blocks);
    for (std::uint64_t& compressed_size : compressed_sizes) {
      compressed_size = NextHeader(array, &source);
    }
    std::string bytes;
    for (std::uint64_t i = 0; i < num_blocks; ++i) {
      const std::string_view compressed = Next(array, &source, compressed_sizes[i]);
      uLongf block = i + 1 < num_blocks ? block_size : true_last_size;
      const std::size_t begin = bytes.size();
      bytes.resize(begin + block);
      const uLongf expected = block;
      if (uncompress(reinterpret_cast<Bytef*>(bytes.data() + begin), &block,
                     reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()) != Z_OK ||
          block != expected) {
        Fail(array, "the compressed data are damaged");
      }
    }
    return bytes;
  }

  void CheckSize(const pugi::xml_node& array, std::uint64_t size, std::int64_t expected) const {
    if (size != static_cast<std::uint64_t>(expected)) {
      Fail(array, std::to_string(size) + " bytes of data where " + std::to_string(expected) + " were expected");
    }
  }

  std::string_view Next(const pugi::xml_node& array, ByteSource* source, std::uint64_t count) const {
    const std::string_view bytes = source->Next(count);
    if (bytes.size() < count) {
      Fail(array, "the data end too early");
    }
    return bytes;
  }

  std::uint64_t NextHeader(const pugi::xml_node& array, ByteSource* source) const {
    const std::string_view bytes = Next(array, source, header_size_);
    return header_size_ == 8 ? FromBytes<std::uint64_t>(bytes.data(), swap_)
                             : FromBytes<std::uint32_t>(bytes.data(), swap_);
  }

  [[noreturn]] void FailAtEntry(const pugi::xml_node& connectivity, std::int64_t entry,
                                const std::string& message) const {
    if (std::string_view(connectivity.attribute("format").as_string("ascii")) == "ascii") {
      TextTokenizer tokens = Tokens(connectivity);
      tokens.SkipWords(entry + 1);
      tokens.Fail(message);
    }
    Fail(connectivity, "entry " + std::to_string(entry) + ": " + message);
  }

  std::string path_;
  bool with_other_volumes_;
  VtuContent* content_;
  std::string xml_;
  mutable const char* last_position_ = nullptr;
  mutable int last_line_ = 1;
  std::string_view appended_;
  bool appended_is_base64_ = false;
  bool swap_ = false;
  std::string compressor_;
  std::size_t header_size_ = 4;
  ParsedMesh result_;
};

}  // namespace

ParsedMesh ReadVtu(const NamedText& file) { return VtuReader(file).Read(); }

VtuContent ReadVtuContent(const NamedText& file) {
  VtuContent content;
  content.parsed = VtuReader(file, &content).Read();
  return content;
}

VtuContent ReadVtuContent(const std::filesystem::path& path) {
  const FileContent file(path);
  if (file.text().substr(0, 512).find("<VTKFile") == std::string_view::npos) {
    throw std::runtime_error(path.string() + ": this is no VTU file");
  }
  return ReadVtuContent(NamedText{path.string(), file.text()});
}

}  // namespace octupole::internal
