#pragma once

#include <filesystem>

#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// Writes the spherical plot of a harmonic f as a surface for ParaView, a VTP file: the points |f(n)| n over the unit
/// sphere of n, with the point array `value` = f(n), whose sign tells the lobes apart. `resolution` is the number of
/// bands of latitude; each is cut into twice as many faces. Degrees 3 and 4.
///
/// \throw std::invalid_argument when h is not finite or `resolution` is less than 3.
/// \throw std::runtime_error naming the path and the cause if the file cannot be written.
template <int kDegree>
void WriteSphericalPlot(const std::filesystem::path& path, const Harmonic<kDegree>& h, int resolution);

}  // namespace octupole
