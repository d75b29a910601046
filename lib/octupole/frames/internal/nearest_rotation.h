#pragma once

#include <Eigen/Geometry>

#include "octupole/harmonics/harmonics.h"

namespace octupole::internal {

struct NearestRotation {
  Eigen::Quaterniond rotation;
  /// How many times Newton's method climbed to a maximum: once where the first maximum is known to be the global one.
  int num_climbs;
};

/// The rotation R with the largest h . D(R) reference, for a unit h: see NearestFrame.
template <int kDegree>
NearestRotation FindNearestRotation(const Harmonic<kDegree>& h);

}  // namespace octupole::internal
