// SPDX-License-Identifier: BSD-3-Clause
// Pi, and angles wrapped to one turn.
#pragma once

#include <cmath>

namespace cairn {

inline constexpr double kPi = 3.14159265358979323846;

// The same angle in (-pi, pi].
inline double wrap_angle(double angle) {
  if (angle > -kPi && angle <= kPi) return angle;  // the common case, without rounding
  const double wrapped = std::remainder(angle, 2 * kPi);
  return wrapped <= -kPi ? wrapped + 2 * kPi : wrapped;
}

}  // namespace cairn
