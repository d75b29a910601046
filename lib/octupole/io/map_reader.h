#pragma once

#include <filesystem>

#include "octupole/maps/map_quality.h"

namespace octupole {

/// Reads a map as WriteHexEx writes it.
/// \throw std::runtime_error naming path, line and cause when the file cannot be read or is no map.
MeshMap ReadHexEx(const std::filesystem::path& path);

}  // namespace octupole
