// SPDX-License-Identifier: BSD-3-Clause
// What of a fleet's square does not move: the coast line, the features, and where the boats start.
#pragma once

#include <cairn/fleet.h>

#include <vector>

#include "geometry/se2.hpp"

namespace cairn::sim {

struct FleetScene {
  std::vector<Vector2> coast;     // from west to east
  std::vector<Vector2> features;  // that with id 1 first
  std::vector<SE2> starts;        // T_map_boat, boat 1 first
};

// `options` are checked already. Throws Error where they contradict each other.
FleetScene make_scene(const cairn_fleet_options& options);

}  // namespace cairn::sim
