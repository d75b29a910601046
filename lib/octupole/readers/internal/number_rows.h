#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace octupole::internal {

/// Visits the lines of a text file of numbers, each with the number of the line: numbers stand between commas,
/// semicolons or white space, '#' begins a comment, and the first line may name the columns instead.
/// \throw std::runtime_error "path:line: message" at what is no finite number, and when the file cannot be read.
void ForEachNumberRow(const std::filesystem::path& path,
                      const std::function<void(int line, const std::vector<double>& numbers)>& visit);

/// Throws std::runtime_error "path:line: message".
[[noreturn]] void FailAtLine(const std::filesystem::path& path, int line, const std::string& message);

}  // namespace octupole::internal
