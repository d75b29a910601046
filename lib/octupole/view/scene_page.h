#pragma once

#include <filesystem>
#include <vector>

#include "octupole/view/scene.h"

namespace octupole {

/// \throw std::runtime_error saying how to get the page, where the library was built without it (docs/viewer.md).
void CheckScenePages();

/// Writes scenes side by side as one HTML file that needs nothing else, no network either: open it in a browser.
///
/// Positions are rounded to 1/65535 of the scene's largest extent, values to 1/65535 of the largest one. Texts may be
/// anything; they are data, never HTML.
///
/// \throw std::invalid_argument naming scene and part where sizes do not fit, indices are out of range or numbers are
/// not
///     finite, and when there is no scene.
/// \throw std::runtime_error as CheckScenePages(), and naming path and cause when the file cannot be written; an
/// existing
///     one stays as it was.
void WriteScenePage(const std::filesystem::path& path, const std::vector<Scene>& scenes);

}  // namespace octupole
