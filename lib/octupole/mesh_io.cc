#include "octupole/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "octupole/mesh_readers.h"

namespace octupole {
namespace {

struct Format {
  std::string_view extension;
  std::string_view name;
  /// How such a file begins.
  std::string_view signature;
  internal::ParsedMesh (*read)(const std::string& path, std::string_view text);
};

constexpr Format kFormats[] = {
    {".mesh", "a Medit mesh", "MeshVersionFormatted", internal::ReadMedit},
    {".vtk", "a legacy VTK file", "# vtk DataFile", internal::ReadVtk},
    {".msh", "a Gmsh mesh", "$", internal::ReadGmsh},
};

/// Files that are seen under these extensions but hold something else.
constexpr std::pair<std::string_view, std::string_view> kOtherContents[] = {
    {"version https://git-lfs", "a Git LFS pointer (fetch the mesh with 'git lfs pull')"},
    {"MFEM mesh", "an MFEM mesh"},
    {"(", "an ANSYS Fluent mesh"},
    {"<", "an XML file"},
    {"OVM", "an OpenVolumeMesh file"},
};

bool StartsWith(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

const Format& FormatOfExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const Format& format : kFormats) {
    if (format.extension == extension) {
      return format;
    }
  }
  throw std::runtime_error(path.string() + ": the extension '" + extension +
                           "' is not one of .mesh (Medit), .vtk (legacy VTK), .msh (Gmsh)");
}

void CheckContent(const std::string& path, std::string_view text, const Format& format) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) {
    throw std::runtime_error(path + ": the file is empty");
  }
  text.remove_prefix(begin);
  if (StartsWith(text, format.signature)) {
    return;
  }
  const auto fail = [&](std::string_view content) {
    throw std::runtime_error(path + ": this is " + std::string(content) + ", not " + std::string(format.name) +
                             " as the extension says");
  };
  for (const auto& [signature, content] : kOtherContents) {
    if (StartsWith(text, signature)) {
      fail(content);
    }
  }
  for (const Format& other : kFormats) {
    if (StartsWith(text, other.signature)) {
      fail(other.name);
    }
  }
  constexpr std::size_t kSample = 4096;
  if (text.substr(0, kSample).find('\0') != std::string_view::npos) {
    fail("binary data");
  }
}

}  // namespace

TetMesh ReadTetMesh(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  const Format& format = FormatOfExtension(path);
  const std::string content = internal::ReadTextFile(path);
  std::string_view text = content;
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; StartsWith(text, kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  CheckContent(path.string(), text, format);
  internal::ParsedMesh parsed = format.read(path.string(), text);

  if (parsed.mesh.tets.empty()) {
    std::string others;
    for (const auto& [kind, count] : parsed.other_cells) {
      others += (others.empty() ? ", only " : ", ") + std::to_string(count) + " " + kind;
    }
    throw std::runtime_error(path.string() + ": no tetrahedra" + others);
  }
  if (warnings != nullptr) {
    for (const auto& [kind, count] : parsed.other_cells) {
      if (kind != internal::kTriangles && kind != internal::kQuadrilaterals && count > 0) {
        warnings->push_back(std::to_string(count) + " " + kind + " are left out");
      }
    }
    if (parsed.curved_tets > 0) {
      warnings->push_back(std::to_string(parsed.curved_tets) + " tetrahedra of higher order are read as their corners");
    }
  }
  return std::move(parsed.mesh);
}

}  // namespace octupole
