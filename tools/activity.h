#pragma once

#include <cstddef>
#include <string>

namespace octupole {

/// Remembers what the command is about to do, for OutOfMemoryMessage.
/// \param what "solving" and so on.
/// \param num_vertices of the mesh, 0 while it is not read.
void SetActivity(const std::string& what, std::size_t num_vertices = 0);

/// What to say of std::bad_alloc: during what, for how many vertices, and how much memory such a mesh needs.
std::string OutOfMemoryMessage();

}  // namespace octupole
