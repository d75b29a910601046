#include <stdexcept>
#include <unordered_map>

#include "octupole/mesh_readers.h"

namespace octupole::internal {
namespace {

/// The plural of elements that are left out, or null for points and lines.
const char* OtherCells(int type) {
  switch (type) {
    case 2:
    case 9:
    case 20:
    case 21:
      return kTriangles;
    case 3:
    case 10:
    case 16:
      return kQuadrilaterals;
    case 5:
    case 12:
    case 17:
    case 92:
      return kHexahedra;
    case 6:
    case 13:
    case 18:
    case 90:
      return kPrisms;
    case 7:
    case 14:
    case 19:
      return kPyramids;
    case 30:
    case 31:
      return "tetrahedra of order 4 or 5";
    default:
      return nullptr;
  }
}

/// The number of nodes of the tetrahedra that are read, of order 1 to 3, or 0.
int NumTetNodes(int type) { return type == 4 ? 4 : type == 11 ? 10 : type == 29 ? 20 : 0; }

class GmshReader {
 public:
  GmshReader(const std::string& path, std::string_view text) : tokens_(path, text) {}

  ParsedMesh Read() {
    bool is_version_4 = false;
    bool has_format = false;
    while (!tokens_.AtEnd()) {
      const std::string section(tokens_.NextWord());
      if (section == "$MeshFormat") {
        is_version_4 = ReadFormat();
        has_format = true;
      } else if (section == "$NOD") {
        tokens_.Fail("Gmsh format 1 is not read; save the mesh in format 2.2 or 4.1");
      } else if (section.front() != '$' || (!has_format && section != "$Comments")) {
        tokens_.Fail(Quoted(section) + " where " + (has_format ? "a section" : "the section $MeshFormat") +
                     " was expected");
      } else if (section == "$Nodes") {
        is_version_4 ? ReadNodes4() : ReadNodes2();
      } else if (section == "$Elements") {
        is_version_4 ? ReadElements4() : ReadElements2();
      } else if (section == "$Entities") {
        ReadVolumeTags();
      } else {
        SkipBeyond("$End" + section.substr(1));
        continue;
      }
      const std::string end = "$End" + section.substr(1);
      if (const std::string_view word = tokens_.NextWord(); word != end) {
        tokens_.Fail(Quoted(word) + " where " + end + " was expected");
      }
    }
    return std::move(result_);
  }

 private:
  /// Returns whether the format is 4.1 rather than 2.x.
  bool ReadFormat() {
    const std::string version(tokens_.NextWord());
    if (version != "4.1" && version != "2" && version.substr(0, 2) != "2.") {
      tokens_.Fail("Gmsh format " + Quoted(version) + " is not read; save the mesh in format 2.2 or 4.1");
    }
    if (tokens_.NextInt("the file type") != 0) {
      tokens_.Fail("binary Gmsh " + version + " is not read; save the mesh as ASCII");
    }
    tokens_.NextInt("the size of a number");
    return version == "4.1";
  }

  void SkipBeyond(const std::string& end) {
    while (!tokens_.AtEnd()) {
      if (tokens_.NextWord() == end) {
        return;
      }
    }
    tokens_.Fail("the file ends before " + end);
  }

  void AddNode(std::int64_t tag) {
    const int index = static_cast<int>(index_of_node_.size());
    if (!index_of_node_.emplace(tag, index).second) {
      tokens_.Fail("a second node with the number " + std::to_string(tag));
    }
  }

  void ReadNodes2() {
    const int num_nodes = tokens_.NextCount("nodes", 4);
    index_of_node_.reserve(num_nodes);
    result_.mesh.points.reserve(num_nodes);
    for (int i = 0; i < num_nodes; ++i) {
      AddNode(tokens_.NextInteger("a node number"));
      result_.mesh.points.push_back(NextPoint(tokens_));
    }
  }

  void ReadNodes4() {
    const std::int64_t num_blocks = tokens_.NextInteger("the number of blocks");
    const int num_nodes = tokens_.NextCount("nodes", 4);
    tokens_.SkipWords(2);  // the smallest and largest number
    index_of_node_.reserve(num_nodes);
    result_.mesh.points.reserve(num_nodes);
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      const int dimension = tokens_.NextInt("a dimension");
      tokens_.NextInteger("an entity number");
      const bool is_parametric = tokens_.NextInt("0 or 1 for parametric") != 0;
      const int size = tokens_.NextCount("nodes of a block", 4);
      for (int i = 0; i < size; ++i) {
        AddNode(tokens_.NextInteger("a node number"));
      }
      for (int i = 0; i < size; ++i) {
        result_.mesh.points.push_back(NextPoint(tokens_));
        tokens_.SkipWords(is_parametric ? dimension : 0);
      }
    }
    CheckTotal("nodes", num_nodes, index_of_node_.size());
  }

  /// The first physical tag of every volume.
  void ReadVolumeTags() {
    std::int64_t num_lower = 0;  // points, curves and surfaces: one line each
    for (int dimension = 0; dimension < 3; ++dimension) {
      num_lower += tokens_.NextCount("entities", 1);
    }
    const int num_volumes = tokens_.NextCount("volumes", 1);
    for (std::int64_t i = 0; i < num_lower; ++i) {
      tokens_.NextInteger("an entity number");
      tokens_.SkipLine();
    }
    for (int i = 0; i < num_volumes; ++i) {
      const std::int64_t volume = tokens_.NextInteger("a volume number");
      tokens_.SkipWords(6);  // the bounding box
      if (tokens_.NextInteger("a number of physical tags") > 0) {
        physical_tag_of_volume_[volume] = tokens_.NextInt("a physical tag");
      }
      tokens_.SkipLine();
    }
  }

  void ReadElements2() {
    const int num_elements = tokens_.NextCount("elements", 4);
    for (int i = 0; i < num_elements; ++i) {
      tokens_.NextInteger("an element number");
      const int line = tokens_.line();
      const int type = tokens_.NextInt("an element type");
      const std::int64_t num_tags = tokens_.NextInteger("a number of tags");
      int region = 0;
      if (num_tags > 0) {
        region = tokens_.NextInt("a region tag");
        tokens_.SkipWords(num_tags - 1);
      }
      ReadVertices(line, type, region);
    }
  }

  void ReadElements4() {
    const std::int64_t num_blocks = tokens_.NextInteger("the number of blocks");
    const int num_elements = tokens_.NextCount("elements", 2);
    tokens_.SkipWords(2);  // the smallest and largest number
    std::int64_t total = 0;
    for (std::int64_t b = 0; b < num_blocks; ++b) {
      tokens_.NextInt("a dimension");
      const int entity = tokens_.NextInt("an entity number");
      const int type = tokens_.NextInt("an element type");
      const int size = tokens_.NextCount("elements of a block", 2);
      const auto physical = physical_tag_of_volume_.find(entity);
      const int region = physical == physical_tag_of_volume_.end() ? entity : physical->second;
      for (int i = 0; i < size; ++i) {
        tokens_.NextInteger("an element number");
        ReadVertices(tokens_.line(), type, region);
      }
      total += size;
    }
    CheckTotal("elements", num_elements, total);
  }

  /// Reads an element that began on `line` to the end of this line. An element of any other length
  /// would be read as the next ones, so it is refused.
  void ReadVertices(int line, int type, int region) {
    const int num_nodes = NumTetNodes(type);
    if (num_nodes > 0) {
      result_.mesh.tets.push_back(NextTet(tokens_, [this](std::int64_t tag) {
        const auto node = index_of_node_.find(tag);
        if (node == index_of_node_.end()) {
          tokens_.Fail("node " + std::to_string(tag) + " is not among the " + std::to_string(index_of_node_.size()) +
                       " nodes read");
        }
        return node->second;
      }));
      result_.mesh.regions.push_back(region);
      result_.curved_tets += num_nodes > 4;
      tokens_.SkipWords(num_nodes - 4);
    } else if (const char* kind = OtherCells(type)) {
      ++result_.other_cells[kind];
    }
    if (tokens_.line() != line || (num_nodes > 0 && !tokens_.AtLineEnd())) {
      tokens_.Fail("an element of type " + std::to_string(type) + " with too " +
                   (tokens_.line() != line ? "few" : "many") + " nodes");
    }
    tokens_.SkipLine();
  }

  void CheckTotal(const std::string& what, std::int64_t announced, std::int64_t found) {
    if (announced != found) {
      tokens_.Fail(std::to_string(announced) + " " + what + " announced, but the blocks have " + std::to_string(found));
    }
  }

  TextTokenizer tokens_;
  ParsedMesh result_;
  std::unordered_map<std::int64_t, int> index_of_node_;
  std::unordered_map<std::int64_t, int> physical_tag_of_volume_;
};

}  // namespace

ParsedMesh ReadGmsh(const std::string& path, std::string_view text) { return GmshReader(path, text).Read(); }

}  // namespace octupole::internal
