// SPDX-License-Identifier: BSD-3-Clause
// Roll, pitch and yaw at the border of the library; no state holds them.
#pragma once

#include <cmath>

#include "geometry/so3.hpp"

namespace cairn {

// R = Rz(yaw) Ry(pitch) Rx(roll), rad.
struct Euler {
  double roll = 0, pitch = 0, yaw = 0;
};

inline SO3 from_euler(const Euler& angles) {
  return SO3::exp(Vector3(0, 0, angles.yaw)) * SO3::exp(Vector3(0, angles.pitch, 0)) *
         SO3::exp(Vector3(angles.roll, 0, 0));
}

// Pitch lies in [-pi/2, pi/2]. At +-pi/2 roll and yaw turn about one axis and only their sum or difference is known:
// roll is 0 there.
inline Euler to_euler(const SO3& rotation) {
  constexpr double kLocked = 1e-12;  // cos(pitch) below this is rounding
  const Matrix3 R = rotation.matrix();
  const double cos_pitch = std::hypot(R(2, 1), R(2, 2));
  Euler angles;
  angles.pitch = std::atan2(-R(2, 0), cos_pitch);
  angles.roll = cos_pitch < kLocked ? 0 : std::atan2(R(2, 1), R(2, 2));
  // Yaw from R Rx(-roll) = Rz Ry, whose second column is (-sin, cos, 0): as accurate near the lock as anywhere, for it
  // takes up what roll is off.
  const double c = std::cos(angles.roll), s = std::sin(angles.roll);
  angles.yaw = std::atan2(s * R(0, 2) - c * R(0, 1), c * R(1, 1) - s * R(1, 2));
  return angles;
}

}  // namespace cairn
