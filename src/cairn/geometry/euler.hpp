// SPDX-License-Identifier: BSD-3-Clause
// Conversion from and to roll, pitch and yaw, for callers. No state of the library holds Euler angles.
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

// Pitch lies in [-pi/2, pi/2]. At +-pi/2 roll and yaw turn about the same axis, and only their sum or difference is
// known: roll is set to 0 there.
inline Euler to_euler(const SO3& rotation) {
  constexpr double kLocked = 1e-12;  // cos(pitch) below this is rounding
  const Matrix3 R = rotation.matrix();
  const double cos_pitch = std::hypot(R(2, 1), R(2, 2));
  Euler angles;
  angles.pitch = std::atan2(-R(2, 0), cos_pitch);
  angles.roll = cos_pitch < kLocked ? 0 : std::atan2(R(2, 1), R(2, 2));
  // Yaw follows from R Rx(-roll) = Rz Ry, whose second column is (-sin(yaw), cos(yaw), 0). This is accurate near
  // +-pi/2 too, because yaw compensates the error of roll.
  const double c = std::cos(angles.roll), s = std::sin(angles.roll);
  angles.yaw = std::atan2(s * R(0, 2) - c * R(0, 1), c * R(1, 1) - s * R(1, 2));
  return angles;
}

}  // namespace cairn
