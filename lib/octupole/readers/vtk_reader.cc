#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "octupole/readers/internal/mesh_readers.h"
#include "octupole/readers/internal/number_bytes.h"
#include "octupole/readers/internal/vtk_cells.h"

namespace octupole::internal {
namespace {

/// The type of this name, or nothing if its values are no numbers.
std::optional<NumberType> FindType(std::string_view name) {
  constexpr std::pair<std::string_view, NumberType> kTypes[] = {
      {"float", NumberType::kFloat32},       {"double", NumberType::kFloat64},
      {"int", NumberType::kInt32},           {"unsigned_int", NumberType::kUInt32},
      {"long", NumberType::kInt64},          {"unsigned_long", NumberType::kUInt64},
      {"vtktypeint64", NumberType::kInt64},  {"vtktypeuint64", NumberType::kUInt64},
      {"vtktypeint32", NumberType::kInt32},  {"vtkIdType", NumberType::kInt32},  // whatever its size in memory
      {"short", NumberType::kInt16},         {"unsigned_short", NumberType::kUInt16},
      {"char", NumberType::kInt8},           {"signed_char", NumberType::kInt8},
      {"unsigned_char", NumberType::kUInt8},
  };
  for (const auto& [type_name, type] : kTypes) {
    if (type_name == name) {
      return type;
    }
  }
  return std::nullopt;
}

class VtkReader {
 public:
  explicit VtkReader(const NamedText& file) : path_(file.path), tokens_(file.path, file.text) {
    cells_.with_other_volumes = file.with_other_volumes;
  }

  ParsedMesh Read() {
    ReadHeader();
    // The regions come last; what is behind them is of no interest.
    while (cells_.regions.empty() && !tokens_.AtEnd()) {
      const std::string word(tokens_.NextWord());
      if (word == "POINTS") {
        CheckIsFirst(result_.mesh.points.empty(), word);
        ReadPoints();
      } else if (word == "CELLS") {
        CheckIsFirst(!first_cell_, word);
        ReadCells();
      } else if (word == "CELL_TYPES") {
        CheckIsFirst(cells_.types.empty(), word);
        ReadCellTypes();
      } else if (word == "CELL_DATA" || word == "POINT_DATA") {
        of_cells_ = word == "CELL_DATA";
        num_values_ = NextSize("a number of values");
      } else {
        ReadAttribute(word);
      }
    }
    for (const auto& [is_missing, section] :
         {std::pair(result_.mesh.points.empty(), "POINTS"), std::pair(!first_cell_, "CELLS"),
          std::pair(cells_.types.empty(), "CELL_TYPES")}) {
      if (is_missing) {
        throw std::runtime_error(path_ + ": the section " + section + " is missing or empty");
      }
    }
    AddVtkCells(
        cells_, 0, [this](std::int64_t entry, const std::string& message) { FailAtEntry(entry, message); }, &result_);
    return std::move(result_);
  }

 private:
  void ReadHeader() {
    constexpr std::string_view kMagic = "# vtk DataFile Version ";
    const std::string_view magic = tokens_.SkipLine();
    if (magic.substr(0, kMagic.size()) != kMagic) {
      tokens_.Fail("a legacy VTK file begins with '" + std::string(kMagic) + "'");
    }
    const char major = magic.size() > kMagic.size() ? magic[kMagic.size()] : '0';
    if (major < '2' || major > '5') {
      tokens_.Fail("VTK versions 2.0 to 5.1 are read, not " + Quoted(magic.substr(kMagic.size())));
    }
    // The title that follows may be empty or have empty lines around it, so look for the line after.
    std::string_view word = tokens_.NextWord();
    while ((word != "ASCII" && word != "BINARY") || !tokens_.AtLineEnd()) {
      tokens_.SkipLine();
      word = tokens_.NextWord();
    }
    is_binary_ = word == "BINARY";
    if (const std::string_view dataset = tokens_.NextWord(); dataset != "DATASET") {
      tokens_.Fail(Quoted(dataset) + " where DATASET was expected");
    }
    if (const std::string_view kind = tokens_.NextWord(); kind != "UNSTRUCTURED_GRID") {
      tokens_.Fail("a dataset of kind " + Quoted(kind) + ", only UNSTRUCTURED_GRID is read");
    }
  }

  void CheckIsFirst(bool is_first, const std::string& section) const {
    if (!is_first) {
      tokens_.Fail("a second section " + section);
    }
  }

  /// The bytes of numbers in a binary file, which begin on the next line.
  std::string_view NextBytes(std::int64_t count, NumberType type, const char* what) {
    tokens_.BeginBinary();
    return tokens_.NextBytes(count, SizeOf(type), what);
  }

  NumberType NextType() {
    const std::string_view name = tokens_.NextWord();
    const std::optional<NumberType> type = FindType(name);
    if (!type) {
      tokens_.Fail(Quoted(name) + " where a type of numbers was expected");
    }
    return *type;
  }

  void ReadPoints() {
    std::vector<Eigen::Vector3d>& points = result_.mesh.points;
    const int count = tokens_.NextCount("points", 3);
    const NumberType type = NextType();
    points.reserve(count);
    if (!is_binary_) {
      for (int i = 0; i < count; ++i) {
        points.push_back(NextPoint(tokens_));
      }
      return;
    }
    points.resize(count);
    double* next = points.empty() ? nullptr : points[0].data();
    ForEachNumber(NextBytes(3 * static_cast<std::int64_t>(count), type, "the end of the points"), type, swap_,
                  [&](auto x) {
                    tokens_.CheckFinite(static_cast<double>(x), "a coordinate");
                    *next++ = static_cast<double>(x);
                  });
  }

  template <typename Integer>
  std::vector<Integer> NextIntegers(int count, NumberType type, const char* what) {
    std::vector<Integer> numbers;
    const auto take = [&](auto number) {
      numbers.push_back(static_cast<Integer>(number));
      if (static_cast<decltype(number)>(numbers.back()) != number) {
        tokens_.Fail(std::to_string(number) + " is too large for " + what);
      }
    };
    if (!IsInteger(type)) {
      tokens_.Fail(std::string("real numbers where ") + what + " was expected");
    }
    if (is_binary_) {
      const std::string_view bytes = NextBytes(count, type, what);
      numbers.reserve(count);
      ForEachNumber(bytes, type, swap_, take);
      return numbers;
    }
    numbers.reserve(count);
    for (int i = 0; i < count; ++i) {
      take(tokens_.NextInteger(what));
    }
    return numbers;
  }

  void ReadCells() {
    const int num_cells = tokens_.NextCount("cells", 1);
    const int num_entries = tokens_.NextCount("cell entries", 1);
    if (TextTokenizer behind = tokens_; !behind.AtEnd() && behind.NextWord() == "OFFSETS") {
      tokens_ = behind;
      ReadCells5(num_cells, num_entries);
    } else {
      first_cell_ = tokens_;
      cells_.connectivity = NextIntegers<std::int64_t>(num_entries, NumberType::kInt32, "a vertex index");
      SplitCells(num_cells);
    }
  }

  /// Formats before 5: each cell's entries begin with their number.
  void SplitCells(int num_cells) {
    std::vector<std::int64_t>& entries = cells_.connectivity;
    const auto num_entries = static_cast<std::int64_t>(entries.size());
    std::int64_t read = 0;
    std::int64_t written = 0;
    cells_.ends.reserve(num_cells);
    has_leading_sizes_ = true;
    for (int c = 0; c < num_cells; ++c) {
      const std::int64_t size = read < num_entries ? entries[read] : -1;
      if (size < 0 || size >= num_entries - read) {
        FailAtWord(std::min(read, num_entries - 1), "cell " + std::to_string(c) + " does not fit the " +
                                                        std::to_string(num_entries) + " entries announced");
      }
      std::copy_n(entries.begin() + read + 1, size, entries.begin() + written);
      read += size + 1;
      written += size;
      cells_.ends.push_back(written);
    }
    if (read != num_entries) {
      tokens_.Fail("the cells have " + std::to_string(read) + " entries, but " + std::to_string(num_entries) +
                   " were announced");
    }
    entries.resize(written);
  }

  /// Format 5: where each cell begins, with one more for the end, then the vertices.
  void ReadCells5(int num_offsets, int num_entries) {
    cells_.ends = NextIntegers<std::int64_t>(num_offsets, NextType(), "an offset");
    std::vector<std::int64_t>& offsets = cells_.ends;
    for (int i = 0; i < num_offsets; ++i) {
      const std::int64_t previous = i == 0 ? 0 : offsets[i - 1];
      if (offsets[i] < previous || (i == 0 && offsets[0] != 0) || offsets[i] > num_entries) {
        tokens_.Fail("offset " + std::to_string(offsets[i]) + " does not fit behind " + std::to_string(previous) +
                     " and before " + std::to_string(num_entries));
      }
    }
    if (!offsets.empty()) {
      if (offsets.back() != num_entries) {
        tokens_.Fail("the last offset is " + std::to_string(offsets.back()) + ", but " + std::to_string(num_entries) +
                     " entries were announced");
      }
      offsets.erase(offsets.begin());
    }
    if (const std::string_view word = tokens_.NextWord(); word != "CONNECTIVITY") {
      tokens_.Fail(Quoted(word) + " where CONNECTIVITY was expected");
    }
    const NumberType type = NextType();
    first_cell_ = tokens_;
    cells_.connectivity = NextIntegers<std::int64_t>(num_entries, type, "a vertex index");
  }

  void ReadCellTypes() {
    const int count = tokens_.NextCount("cell types", 1);
    if (!first_cell_ || count != static_cast<int>(cells_.ends.size())) {
      tokens_.Fail(std::to_string(count) + " cell types for " + std::to_string(cells_.ends.size()) + " cells");
    }
    cells_.types = NextIntegers<int>(count, NumberType::kInt32, "a cell type");
  }

  /// Skips an array of values. In text that is left to the search for the next section.
  void SkipValues(std::int64_t count, std::string_view type_name) {
    if (!is_binary_) {
      return;
    }
    tokens_.BeginBinary();
    if (type_name == "bit") {
      tokens_.NextBytes((count + 7) / 8, 1, "the end of an array");
    } else if (const std::optional<NumberType> type = FindType(type_name)) {
      tokens_.NextBytes(count, SizeOf(*type), "the end of an array");
    } else {
      tokens_.Fail("an array of " + Quoted(type_name) + " is not read in binary VTK; save the mesh as ASCII");
    }
  }

  /// An array of the cells, if it is one integer each, gives the regions.
  void ReadValues(std::int64_t num_tuples, std::int64_t components, std::string_view type_name) {
    const std::optional<NumberType> type = FindType(type_name);
    if (of_cells_ && components == 1 && num_tuples == static_cast<std::int64_t>(cells_.types.size()) && type &&
        IsInteger(*type)) {
      cells_.regions = NextIntegers<int>(static_cast<int>(num_tuples), *type, "a cell's region tag");
    } else {
      SkipValues(num_tuples * components, type_name);
    }
  }

  int NextSize(const char* what) {
    const int size = tokens_.NextInt(what);
    if (size < 0) {
      tokens_.Fail(std::to_string(size) + " as " + what);
    }
    return size;
  }

  void ReadAttribute(const std::string& word) {
    if (word == "SCALARS") {
      tokens_.NextWord();  // the name
      const std::string type(tokens_.NextWord());
      const int components = tokens_.AtLineEnd() ? 1 : NextSize("a number of components");
      if (const std::string_view table = tokens_.NextWord(); table != "LOOKUP_TABLE") {
        tokens_.Fail(Quoted(table) + " where LOOKUP_TABLE was expected");
      }
      tokens_.NextWord();  // the name
      ReadValues(num_values_, components, type);
    } else if (word == "FIELD") {
      ReadField();
    } else if (word == "METADATA") {
      SkipMetadata();
    } else if (is_binary_) {
      SkipBinaryAttribute(word);
    }
  }

  void ReadField() {
    tokens_.NextWord();  // the name
    const int num_arrays = NextSize("a number of arrays");
    for (int i = 0; i < num_arrays && cells_.regions.empty(); ++i) {
      if (!is_binary_ && !of_cells_) {
        return;  // to the search for the next section
      }
      std::string name(tokens_.NextWord());
      if (name == "METADATA") {
        SkipMetadata();
        name = tokens_.NextWord();
      }
      const int components = NextSize("a number of components");
      const int num_tuples = NextSize("a number of tuples");
      const std::string type(tokens_.NextWord());
      ReadValues(num_tuples, components, type);
      if (!is_binary_ && cells_.regions.empty()) {
        if (!FindType(type)) {
          return;
        }
        tokens_.SkipWords(static_cast<std::int64_t>(num_tuples) * components);
      }
    }
  }

  /// Names of components and the like, up to an empty line.
  void SkipMetadata() {
    tokens_.SkipLine();
    while (tokens_.SkipLine().find_first_not_of(" \t\r") != std::string_view::npos) {
    }
  }

  void SkipBinaryAttribute(const std::string& word) {
    constexpr std::pair<std::string_view, int> kComponents[] = {
        {"VECTORS", 3}, {"NORMALS", 3}, {"TENSORS", 9}, {"TENSORS6", 6}, {"GLOBAL_IDS", 1}, {"PEDIGREE_IDS", 1}};
    const std::string name(tokens_.NextWord());
    if (word == "LOOKUP_TABLE") {
      SkipValues(4 * static_cast<std::int64_t>(NextSize("a number of colours")), "unsigned_char");
    } else if (word == "COLOR_SCALARS") {
      SkipValues(num_values_ * NextSize("a number of components"), "unsigned_char");
    } else if (word == "TEXTURE_COORDINATES") {
      const int components = NextSize("a number of components");
      SkipValues(num_values_ * components, tokens_.NextWord());
    } else {
      for (const auto& [attribute, components] : kComponents) {
        if (word == attribute) {
          return SkipValues(num_values_ * components, tokens_.NextWord());
        }
      }
      tokens_.Fail(Quoted(word) + " where a section was expected");
    }
  }

  /// Throws the message about a word of the cells.
  [[noreturn]] void FailAtWord(std::int64_t word, const std::string& message) const {
    if (!is_binary_) {
      TextTokenizer tokens = *first_cell_;
      tokens.SkipWords(word + 1);
      tokens.Fail(message);
    }
    first_cell_->Fail(message);
  }

  [[noreturn]] void FailAtEntry(std::int64_t entry, const std::string& message) const {
    const auto cell = std::upper_bound(cells_.ends.begin(), cells_.ends.end(), entry);
    const std::int64_t num_sizes = has_leading_sizes_ ? cell - cells_.ends.begin() + 1 : 0;
    FailAtWord(entry + num_sizes, message);
  }

  std::string path_;
  TextTokenizer tokens_;
  bool is_binary_ = false;
  const bool swap_ = IsLittleEndian();  // the files are big-endian
  ParsedMesh result_;
  VtkCells cells_;
  /// At the first word of the cells' vertices.
  std::optional<TextTokenizer> first_cell_;
  bool has_leading_sizes_ = false;
  bool of_cells_ = false;
  std::int64_t num_values_ = 0;
};

}  // namespace

ParsedMesh ReadVtk(const NamedText& file) { return VtkReader(file).Read(); }

}  // namespace octupole::internal
