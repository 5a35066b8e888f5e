// SPDX-License-Identifier: BSD-3-Clause
// Association of a submap's landmarks with the map's, for observations without ids (docs/association.md).
#pragma once

#include "map/global_map.hpp"

namespace cairn {

struct NamingOptions {
  bool joint = true;  // or nearest neighbour
  Index nodes = 2000;
  Index support = 3;  // fewer doubtful pairs than this are dropped together
  double gate_probability = 0.99, joint_gate_probability = 0.9999, new_probability = 0.9999;
};

struct NamingReport {
  std::size_t named = 0, ambiguous = 0;
  Index nodes = 0;
  bool exhausted = false;
};

// A landmark of the submap that is paired with a landmark of the map gets the id of that landmark. A landmark without a
// pair is ambiguous if it is near a landmark of the map, and is removed from the submap. All others keep their ids,
// which the map must not hold. The submap began at the map's base.
template <class Pose>
NamingReport name_landmarks(const GlobalMap<Pose>& map, const NamingOptions& options, Submap<Pose>& submap);

extern template NamingReport name_landmarks(const GlobalMap<SE2>&, const NamingOptions&, Submap<SE2>&);
extern template NamingReport name_landmarks(const GlobalMap<SE3>&, const NamingOptions&, Submap<SE3>&);

}  // namespace cairn
