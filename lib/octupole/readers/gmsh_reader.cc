#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "octupole/readers/internal/mesh_readers.h"
#include "octupole/readers/internal/number_bytes.h"

namespace octupole::internal {
namespace {

enum class Kind { kPoint, kLine, kTriangle, kTet, kOther };

/// A type of elements, of which the corners are the first nodes.
struct ElementType {
  int number;
  int num_nodes;
  Kind kind;
  /// The plural under which the others are counted.
  const char* plural = nullptr;
};

constexpr ElementType kElementTypes[] = {
    {15, 1, Kind::kPoint},
    {1, 2, Kind::kLine},
    {8, 3, Kind::kLine},
    {26, 4, Kind::kLine},
    {27, 5, Kind::kLine},
    {28, 6, Kind::kLine},
    {4, 4, Kind::kTet},
    {11, 10, Kind::kTet},
    {29, 20, Kind::kTet},
    {30, 35, Kind::kTet},
    {31, 56, Kind::kTet},
    {2, 3, Kind::kTriangle, kTriangles},
    {9, 6, Kind::kTriangle, kTriangles},
    {20, 9, Kind::kTriangle, kTriangles},
    {21, 10, Kind::kTriangle, kTriangles},
    {22, 12, Kind::kTriangle, kTriangles},
    {23, 15, Kind::kTriangle, kTriangles},
    {24, 15, Kind::kTriangle, kTriangles},
    {25, 21, Kind::kTriangle, kTriangles},
    {3, 4, Kind::kOther, kQuadrilaterals},
    {10, 9, Kind::kOther, kQuadrilaterals},
    {16, 8, Kind::kOther, kQuadrilaterals},
    {36, 16, Kind::kOther, kQuadrilaterals},
    {5, 8, Kind::kOther, kHexahedra},
    {12, 27, Kind::kOther, kHexahedra},
    {17, 20, Kind::kOther, kHexahedra},
    {92, 64, Kind::kOther, kHexahedra},
    {93, 125, Kind::kOther, kHexahedra},
    {6, 6, Kind::kOther, kPrisms},
    {13, 18, Kind::kOther, kPrisms},
    {18, 15, Kind::kOther, kPrisms},
    {90, 40, Kind::kOther, kPrisms},
    {7, 5, Kind::kOther, kPyramids},
    {14, 14, Kind::kOther, kPyramids},
    {19, 13, Kind::kOther, kPyramids},
};

/// The indices of nodes by their numbers: in an array if they are as dense as is usual, else in a map.
class NodeIndices {
 public:
  void Reserve(int num_nodes) { dense_.assign(2 * static_cast<std::size_t>(num_nodes) + 1, kNone); }

  /// Returns false if there is a node of this number already.
  bool Add(std::int64_t number) {
    const int index = size_++;
    if (number < 0 || number >= static_cast<std::int64_t>(dense_.size())) {
      return sparse_.emplace(number, index).second;
    }
    const bool is_new = dense_[number] == kNone;
    dense_[number] = index;
    return is_new;
  }

  /// The index of a node, or -1.
  int Find(std::int64_t number) const {
    if (number >= 0 && number < static_cast<std::int64_t>(dense_.size())) {
      return dense_[number];
    }
    const auto node = sparse_.find(number);
    return node == sparse_.end() ? kNone : node->second;
  }

  int size() const { return size_; }

 private:
  static constexpr int kNone = -1;

  std::vector<int> dense_;
  std::unordered_map<std::int64_t, int> sparse_;
  int size_ = 0;
};

class GmshReader {
 public:
  explicit GmshReader(const NamedText& file)
      : tokens_(file.path, file.text), with_other_volumes_(file.with_other_volumes) {}

  ParsedMesh Read() {
    bool has_format = false;
    bool has_nodes = false;
    bool has_elements = false;
    std::optional<TextTokenizer> early_elements;
    while (!tokens_.AtEnd()) {
      const std::string section(tokens_.NextWord());
      const std::string end = "$End" + section.substr(1);
      if (section == "$MeshFormat") {
        ReadFormat();
        has_format = true;
      } else if (section == "$NOD") {
        tokens_.Fail("Gmsh format 1 is not read; save the mesh in format 2.2 or 4.1");
      } else if (section.front() != '$' || (!has_format && section != "$Comments")) {
        tokens_.Fail(Quoted(section) + " where " + (has_format ? "a section" : "the section $MeshFormat") +
                     " was expected");
      } else if (section == "$Nodes") {
        CheckIsFirst(!has_nodes, section);
        has_nodes = true;
        is_version_4_ ? ReadNodes4() : ReadNodes2();
      } else if (section == "$Elements" && has_nodes) {
        CheckIsFirst(!has_elements, section);
        has_elements = true;
        ReadElements();
      } else if (section == "$Entities" && is_version_4_) {
        ReadVolumeTags();
      } else {
        if (section == "$Elements") {
          CheckIsFirst(!has_elements, section);
          has_elements = true;
          early_elements = tokens_;
        }
        if (!tokens_.SkipBeyond(end)) {
          tokens_.Fail("the file ends before " + end);
        }
        continue;
      }
      if (const std::string_view word = tokens_.NextWord(); word != end) {
        tokens_.Fail(Quoted(word) + " where " + end + " was expected");
      }
    }
    if (early_elements) {
      tokens_ = *early_elements;
      ReadElements();
    }
    return std::move(result_);
  }

 private:
  void CheckIsFirst(bool is_first, const std::string& section) const {
    if (!is_first) {
      tokens_.Fail("a second section " + section);
    }
  }

  void ReadFormat() {
    const std::string version(tokens_.NextWord());
    if (version != "4.1" && version != "2" && version.substr(0, 2) != "2.") {
      tokens_.Fail("Gmsh format " + Quoted(version) + " is not read; save the mesh in format 2.2 or 4.1");
    }
    is_version_4_ = version == "4.1";
    const int file_type = tokens_.NextInt("the file type");
    if (file_type != 0 && file_type != 1) {
      tokens_.Fail("the file type " + std::to_string(file_type) + ", neither 0 for text nor 1 for binary");
    }
    const int size = tokens_.NextInt("the size of a number");
    if (file_type == 1) {
      if (size != 8) {
        tokens_.Fail("binary numbers of " + std::to_string(size) + " bytes, not 8");
      }
      is_binary_ = true;
      tokens_.BeginBinary();
      const int one = NextInt("the number 1 in binary");
      swap_ = one != 1;
      if (swap_ && one != 1 << 24) {
        tokens_.Fail("the number " + std::to_string(one) + " in binary where 1 was expected");
      }
    }
  }

  template <typename Number>
  Number NextBinary(const char* what) {
    return FromBytes<Number>(tokens_.NextBytes(1, sizeof(Number), what).data(), swap_);
  }

  int NextInt(const char* what) { return is_binary_ ? NextBinary<std::int32_t>(what) : tokens_.NextInt(what); }

  /// A number that is 8 bytes long in format 4.
  std::int64_t NextSize(const char* what) {
    return is_binary_ ? NextBinary<std::int64_t>(what) : tokens_.NextInteger(what);
  }

  /// The number of a node, in either format.
  std::int64_t NextNodeNumber() {
    constexpr const char* kWhat = "a node number";
    return is_binary_ && !is_version_4_ ? NextBinary<std::int32_t>(kWhat) : NextSize(kWhat);
  }

  Eigen::Vector3d NextNode() {
    if (!is_binary_) {
      return NextPoint(tokens_);
    }
    Eigen::Vector3d point;
    for (double& x : point) {
      x = NextBinary<double>("a coordinate");
      tokens_.CheckFinite(x, "a coordinate");
    }
    return point;
  }

  void Skip(std::int64_t count, int bytes_each) {
    is_binary_ ? void(tokens_.NextBytes(count, bytes_each, "the end of the section")) : tokens_.SkipWords(count);
  }

  void BeginNumbers() {
    if (is_binary_) {
      tokens_.BeginBinary();
    }
  }

  void AddNode(std::int64_t number) {
    if (!nodes_.Add(number)) {
      tokens_.Fail("a second node with the number " + std::to_string(number));
    }
  }

  void ReadNodes2() {
    const int num_nodes = tokens_.NextCount("nodes", 4);
    BeginNumbers();
    nodes_.Reserve(num_nodes);
    result_.mesh.points.reserve(num_nodes);
    for (int i = 0; i < num_nodes; ++i) {
      AddNode(NextNodeNumber());
      result_.mesh.points.push_back(NextNode());
    }
  }

  void ReadNodes4() {
    BeginNumbers();
    const std::int64_t num_blocks = NextSize("the number of blocks");
    const int bytes_each = is_binary_ ? 32 : 8;
    const int num_nodes = tokens_.CheckCount(NextSize("the number of nodes"), "nodes", bytes_each);
    Skip(2, 8);  // the smallest and largest number
    nodes_.Reserve(num_nodes);
    result_.mesh.points.reserve(num_nodes);
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      const int dimension = NextInt("a dimension");
      if (dimension < 0 || dimension > 3) {
        tokens_.Fail("an entity of dimension " + std::to_string(dimension));
      }
      NextInt("an entity number");
      const bool is_parametric = NextInt("0 or 1 for parametric") != 0;
      const int size = tokens_.CheckCount(NextSize("the number of nodes of a block"), "nodes of a block", bytes_each);
      for (int i = 0; i < size; ++i) {
        AddNode(NextNodeNumber());
      }
      for (int i = 0; i < size; ++i) {
        result_.mesh.points.push_back(NextNode());
        Skip(is_parametric ? dimension : 0, 8);
      }
    }
    CheckTotal("nodes", num_nodes, nodes_.size());
  }

  /// The first physical tag of every volume.
  void ReadVolumeTags() {
    BeginNumbers();
    std::array<int, 4> counts;
    for (int& count : counts) {
      count = tokens_.CheckCount(NextSize("a number of entities"), "entities", 2);
    }
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (int i = 0; i < counts[dimension]; ++i) {
        const int number = NextInt("an entity number");
        if (!is_binary_ && dimension < 3) {
          tokens_.SkipLine();
          continue;
        }
        Skip(dimension == 0 ? 3 : 6, 8);  // the bounding box
        std::int64_t num_tags = NextSize("a number of physical tags");
        if (num_tags > 0) {
          const int tag = NextInt("a physical tag");
          if (dimension == 3) {
            physical_tag_of_volume_[number] = tag;
          }
          --num_tags;
        }
        if (is_binary_) {
          Skip(num_tags, 4);
          Skip(dimension == 0 ? 0 : NextSize("a number of bounding entities"), 4);
        } else {
          tokens_.SkipLine();
        }
      }
    }
  }

  void ReadElements() {
    if (is_version_4_) {
      ReadElements4();
    } else {
      is_binary_ ? ReadBinaryElements2() : ReadElements2();
    }
  }

  int CheckNumTags(int num_tags) const {
    if (num_tags < 0) {
      tokens_.Fail(std::to_string(num_tags) + " as a number of tags");
    }
    return num_tags;
  }

  /// What an element belongs to.
  struct Tags {
    int region = 0;
    /// Its curve, surface or volume; 0 for none.
    int entity = 0;
  };

  /// The first is that of the physical group, the second that of the entity; those behind are of partitions.
  Tags NextTags2(int num_tags) {
    Tags tags;
    if (num_tags > 0) {
      tags.region = NextInt("a region tag");
      tags.entity = num_tags > 1 ? NextInt("an entity tag") : tags.region;
      if (tags.region == 0) tags.region = tags.entity;
      Skip(std::max(0, num_tags - 2), 4);
    }
    return tags;
  }

  void ReadElements2() {
    const int num_elements = tokens_.NextCount("elements", 4);
    for (int i = 0; i < num_elements; ++i) {
      tokens_.NextInteger("an element number");
      const int line = tokens_.line();
      const int type = tokens_.NextInt("an element type");
      const int num_tags = CheckNumTags(tokens_.NextInt("a number of tags"));
      ReadElementLine(line, type, NextTags2(num_tags));
    }
  }

  void ReadBinaryElements2() {
    const int num_elements = tokens_.NextCount("elements", 4);
    BeginNumbers();
    for (int i = 0; i < num_elements;) {
      const int type = NextInt("an element type");
      const int size = tokens_.CheckCount(NextInt("a number of elements"), "elements of a block", 8);
      const int num_tags = CheckNumTags(NextInt("a number of tags"));
      if (size < 1 || size > num_elements - i) {
        tokens_.Fail("a block of " + std::to_string(size) + " elements does not fit the " +
                     std::to_string(num_elements) + " announced");
      }
      for (int end = i + size; i < end; ++i) {
        NextInt("an element number");
        const Tags tags = NextTags2(num_tags);
        ReadElement(KnownType(type), tags);
      }
    }
  }

  void ReadElements4() {
    BeginNumbers();
    const std::int64_t num_blocks = NextSize("the number of blocks");
    const int bytes_each = is_binary_ ? 16 : 4;
    const int num_elements = tokens_.CheckCount(NextSize("the number of elements"), "elements", bytes_each);
    Skip(2, 8);  // the smallest and largest number
    std::int64_t total = 0;
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      NextInt("a dimension");
      const int entity = NextInt("an entity number");
      const int type = NextInt("an element type");
      const int size =
          tokens_.CheckCount(NextSize("the number of elements of a block"), "elements of a block", bytes_each);
      const auto physical = physical_tag_of_volume_.find(entity);
      const Tags tags = {physical == physical_tag_of_volume_.end() ? entity : physical->second, entity};
      for (int i = 0; i < size; ++i) {
        NextSize("an element number");
        is_binary_ ? ReadElement(KnownType(type), tags) : ReadElementLine(tokens_.line(), type, tags);
      }
      total += size;
    }
    CheckTotal("elements", num_elements, total);
  }

  const ElementType* FindType(int number) {
    if (last_type_ == nullptr || last_type_->number != number) {
      last_type_ = std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                                [&](const ElementType& type) { return type.number == number; });
      if (last_type_ == std::end(kElementTypes)) {
        last_type_ = nullptr;
      }
    }
    return last_type_;
  }

  const ElementType& KnownType(int number) {
    const ElementType* type = FindType(number);
    if (type == nullptr) {
      tokens_.Fail("elements of type " + std::to_string(number) + " are not known");
    }
    return *type;
  }

  int NextVertex() { return IndexOf(NextNodeNumber()); }

  int IndexOf(std::int64_t number) const {
    const int index = nodes_.Find(number);
    if (index < 0) {
      tokens_.Fail("node " + std::to_string(number) + " is not among the " + std::to_string(nodes_.size()) +
                   " nodes read");
    }
    return index;
  }

  int NumWantedCorners(const ElementType& type) const {
    return with_other_volumes_ ? NumVolumeCorners(type.plural) : 0;
  }

  /// Reads the nodes of an element.
  void ReadElement(const ElementType& type, const Tags& tags) {
    TetMesh& mesh = result_.mesh;
    int num_read = 0;
    switch (type.kind) {
      case Kind::kPoint:
        mesh.feature_points.push_back(NextVertex());
        num_read = 1;
        break;
      case Kind::kLine: {
        const int start = NextVertex();
        mesh.feature_edges.push_back({start, NextVertex()});
        num_read = 2;
        break;
      }
      case Kind::kTriangle: {
        ++result_.other_cells[type.plural];
        std::array<int, 3> triangle;
        std::generate(triangle.begin(), triangle.end(), [this] { return NextVertex(); });
        if (tags.entity != 0) {
          mesh.surface_triangles.push_back(triangle);
          mesh.surface_tags.push_back(tags.entity);
        }
        num_read = 3;
        break;
      }
      case Kind::kTet: {
        std::array<std::int64_t, 4> numbers;
        std::generate(numbers.begin(), numbers.end(), [this] { return NextNodeNumber(); });
        mesh.tets.push_back(MakeTet(tokens_, numbers, [this](std::int64_t number) { return IndexOf(number); }));
        mesh.regions.push_back(tags.region);
        num_read = 4;
        if (type.num_nodes == 10) {
          const std::array<int, 4> tet = mesh.tets.back();
          for (const auto& [a, b] : kGmshMidEdges) {
            mesh.mid_edge_nodes.push_back({NextVertex(), tet[a], tet[b]});
          }
          num_read = 10;
        } else {
          result_.curved_tets += type.num_nodes > 4;
        }
        break;
      }
      case Kind::kOther:
        ++result_.other_cells[type.plural];
        num_read = NumWantedCorners(type);
        if (num_read > 0) {
          std::array<int, 8>& corners = result_.other_volumes.emplace_back();
          corners.fill(-1);
          for (int i = 0; i < num_read; ++i) corners[i] = NextVertex();
        }
    }
    Skip(type.num_nodes - num_read, is_version_4_ ? 8 : 4);
  }

  /// Reads the nodes of an element that began on `line` to the end of this line. An element of any
  /// other length would be read as the next ones, so it is refused. Types that are not known are
  /// left out with their line.
  void ReadElementLine(int line, int number, const Tags& tags) {
    const ElementType* type = FindType(number);
    if (type == nullptr) {
      ++result_.other_cells["elements of other types"];
    } else if (type->kind == Kind::kOther && NumWantedCorners(*type) == 0) {
      ++result_.other_cells[type->plural];
    } else {
      ReadElement(*type, tags);
      if (tokens_.line() != line || !tokens_.AtLineEnd()) {
        tokens_.Fail("an element of type " + std::to_string(number) + " with too " +
                     (tokens_.line() != line ? "few" : "many") + " nodes");
      }
    }
    tokens_.SkipLine();
  }

  void CheckTotal(const std::string& what, std::int64_t announced, std::int64_t found) {
    if (announced != found) {
      tokens_.Fail(std::to_string(announced) + " " + what + " announced, but the blocks have " + std::to_string(found));
    }
  }

  TextTokenizer tokens_;
  bool with_other_volumes_;
  bool is_version_4_ = false;
  bool is_binary_ = false;
  bool swap_ = false;
  ParsedMesh result_;
  NodeIndices nodes_;
  const ElementType* last_type_ = nullptr;
  std::unordered_map<std::int64_t, int> physical_tag_of_volume_;
};

}  // namespace

ParsedMesh ReadGmsh(const NamedText& file) { return GmshReader(file).Read(); }

}  // namespace octupole::internal
