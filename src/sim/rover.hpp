// SPDX-License-Identifier: BSD-3-Clause
// How a rover stands on the ground, and what its wheels do when it moves.
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
  // Front left, front right, rear left, rear right; only of a rover on wheels.
  Vector3 contacts[4];
};

// On one point: z along the ground's normal, x along the heading, laid into the ground.
Stance stand_on_point(const Terrain& terrain, const Place& place);

// On four wheels. Throws Error (numerical) where the ground is too rough for that to have an answer.
Stance stand_on_wheels(const Terrain& terrain, const Place& place, double track, double wheelbase);

// Turning rates of the left and right wheels that a body velocity and rate ask for (Mars paper, eq. 1, z up).
Vector2 wheel_rates(double velocity_x, double rate_z, double radius, double track);

}  // namespace cairn::sim
