#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "octupole/readers/tet_mesh_reader.h"
#include "test_files.h"

namespace octupole {

/// Reads texts through files, as ReadTetMesh() does.
class MeshIoTest : public testing::Test {
 protected:
  TetMesh Read(const std::string& name, const std::string& text) {
    WriteText(folder_ / name, text);
    warnings_.clear();
    return ReadTetMesh(folder_ / name, &warnings_);
  }

  /// The message of the error, without the folder.
  std::string Error(const std::string& name, const std::string& text) {
    WriteText(folder_ / name, text);
    return ErrorOf(name);
  }

  std::string ErrorOf(const std::string& name) {
    const std::string message = MessageOf<std::runtime_error>([&] { ReadTetMesh(folder_ / name); });
    const std::string prefix = folder_.path().string() + "/";
    EXPECT_EQ(message.substr(0, prefix.size()), prefix);
    return message.substr(std::min(prefix.size(), message.size()));
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

/// Every good text of these tests holds the points (0, 0, 0), (1, 0, 0), (0, 2.5, 0), (0, 0, 1),
/// (1, 1, -0.001) and two tetrahedra.
inline void ExpectTwoTets(const TetMesh& mesh) {
  EXPECT_THAT(mesh.points,
              testing::ElementsAre(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2.5, 0),
                                   Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 1, -0.001)));
  EXPECT_THAT(mesh.tets, testing::ElementsAre(std::array<int, 4>{0, 1, 2, 3}, std::array<int, 4>{4, 2, 1, 0}));
}

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t position = text.find(from);
  if (position == std::string::npos) {
    ADD_FAILURE() << "'" << from << "' is not in the text";
    return text;
  }
  return text.replace(position, from.size(), to);
}

inline std::string WithCrLf(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '\n' ? "\r\n" : std::string(1, c);
  }
  return result;
}

}  // namespace octupole
