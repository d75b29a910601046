#pragma once

#include "octupole/harmonics/harmonics.h"

namespace octupole {

/// The degree-4 harmonic of an octupole: the degree-4 part of a (x) a, scaled. A quadratic map that commutes with
/// rotations, takes a and -a to the same harmonic, and takes the reference to the reference, hence the octupole of
/// every frame to the unit degree-4 harmonic of the same frame (theory.md, section 8).
///
/// As functions on the sphere it is the degree-4 part of f^2 times -11/2 sqrt(4 pi / 21).
Hexadecapole HexadecapoleFromOctupole(const Octupole& a);

}  // namespace octupole
