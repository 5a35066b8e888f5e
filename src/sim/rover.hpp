// SPDX-License-Identifier: BSD-3-Clause
// The pose of a rover that stands on the ground, and the rates of its wheels.
#pragma once

#include "geometry/se3.hpp"
#include "sim/terrain.hpp"

namespace cairn::sim {

// A place on the course, seen from above.
struct Place {
  double x, y, heading;
};

struct Stance {
  SE3 T_map_body;
  // Front left, front right, rear left, rear right. Set only for a rover on wheels.
  Vector3 contacts[4];
};

// A rover that touches the ground at one point: z is the normal of the ground, x is the heading projected onto the
// ground.
Stance stand_on_point(const Terrain& terrain, const Place& place);

// A rover on four wheels. Throws Error (numerical) if the ground is too rough for a solution.
Stance stand_on_wheels(const Terrain& terrain, const Place& place, double track, double wheelbase);

// Rates of the left and right wheels for a body velocity and rate (Mars paper, eq. 1, with z up).
Vector2 wheel_rates(double velocity_x, double rate_z, double radius, double track);

}  // namespace cairn::sim
