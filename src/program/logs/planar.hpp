// SPDX-License-Identifier: BSD-3-Clause
// Poses of the plane, for readers of planar logs.
#pragma once

#include <cairn/cairn.h>

#include <array>
#include <cmath>

namespace cairn::program::logs {

// A pose of the plane as the library takes it.
inline cairn_pose planar_pose(double x, double y, double heading) {
  return {{x, y, 0}, {std::cos(0.5 * heading), 0, 0, std::sin(0.5 * heading)}};
}

// Pose of one frame of the plane in another one: m, rad, anticlockwise.
struct PlanarPose {
  double x = 0, y = 0, heading = 0;

  std::array<double, 2> apply(double px, double py) const {
    const double c = std::cos(heading), s = std::sin(heading);
    return {x + c * px - s * py, y + s * px + c * py};
  }
  PlanarPose compose(const PlanarPose& next) const {
    const std::array<double, 2> p = apply(next.x, next.y);
    return {p[0], p[1], std::remainder(heading + next.heading, 2 * 3.14159265358979323846)};
  }
  PlanarPose inverse() const {
    const std::array<double, 2> p = PlanarPose{0, 0, -heading}.apply(-x, -y);
    return {p[0], p[1], -heading};
  }
  cairn_pose pose() const { return planar_pose(x, y, heading); }
};

}  // namespace cairn::program::logs
