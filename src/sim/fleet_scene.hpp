// SPDX-License-Identifier: BSD-3-Clause
// The fixed part of a fleet's square: the coast line, the features, and the start poses of the boats.
#pragma once

#include <cairn/fleet.h>

#include <vector>

#include "geometry/se2.hpp"

namespace cairn::sim {

struct FleetScene {
  std::vector<Vector2> coast;     // from west to east
  std::vector<Vector2> features;  // the feature with id 1 is first
  std::vector<SE2> starts;        // T_map_boat; boat 1 is first
};

// The fields of `options` have been checked. Throws Error if they contradict each other.
FleetScene make_scene(const cairn_fleet_options& options);

}  // namespace cairn::sim
