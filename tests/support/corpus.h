#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "test_files.h"

namespace octupole {

using Row = std::map<std::string, std::string>;  // column -> value

inline std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, '\t');) {
    fields.push_back(field);
  }
  return fields;
}

/// The rows of a table of tab-separated values whose first line names the columns.
inline std::vector<Row> ReadManifest(const std::filesystem::path& path) {
  std::istringstream stream(ReadText(path));
  std::vector<Row> rows;
  std::vector<std::string> columns;
  for (std::string line; std::getline(stream, line);) {
    line.erase(line.find_last_not_of("\r") + 1);
    const std::vector<std::string> fields = Split(line);
    if (columns.empty()) {
      columns = fields;
      continue;
    }
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < fields.size() && i < columns.size(); ++i) {
      row[columns[i]] = fields[i];
    }
  }
  return rows;
}

/// Tests of a corpus of good and damaged meshes. OCTUPOLE_CORPUS names its folder, with the subfolders bad/ and tet/
/// and a manifest.tsv in each.
class CorpusTest : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("OCTUPOLE_CORPUS");
    if (folder == nullptr) {
      GTEST_SKIP() << "OCTUPOLE_CORPUS is not set";
    }
    folder_ = folder;
  }

  std::filesystem::path folder_;
};

}  // namespace octupole
