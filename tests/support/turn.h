#pragma once

#include <Eigen/Geometry>

namespace octupole {

inline Eigen::Matrix3d Turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

}  // namespace octupole
