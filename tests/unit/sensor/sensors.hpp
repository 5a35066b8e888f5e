// SPDX-License-Identifier: BSD-3-Clause
// Sensors with non-default values of all parameters, for the tests of sensors.
#pragma once

#include <limits>

#include "sensor/stereo_camera.hpp"
#include "sensor/stereo_head.hpp"

namespace cairn::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline const Vector2 kNoMount = Vector2::Zero();

inline StereoHeadParameters mounted_head() {
  StereoHeadParameters p;
  p.platform << 0.3, -0.1, 1.2;
  p.stick << 0.15, 0.05, 0.2;
  p.R_stick_camera = SO3::exp(Vector3(0.1, 0.4, -0.2));
  return p;
}

inline StereoCameraParameters mounted_camera() {
  StereoCameraParameters p;
  p.fu = 480;
  p.fv = 510;
  p.cu = 330;
  p.cv = 250;
  p.baseline = 0.25;
  p.T_body_camera = SE3(p.T_body_camera.rotation() * SO3::exp(Vector3(0.1, -0.3, 0.05)), Vector3(0.4, 0.1, 1.1));
  return p;
}

}  // namespace cairn::test
