// SPDX-License-Identifier: BSD-3-Clause
// Which of the map's landmarks those of a submap are, where observations bring no names (docs/association.md).
#pragma once

#include "map/global_map.hpp"

namespace cairn {

struct NamingOptions {
  bool joint = true;  // or nearest neighbour
  Index nodes = 2000;
  Index support = 3;  // doubtful pairs that are taken together
  double gate_probability = 0.99, joint_gate_probability = 0.9999, new_probability = 0.9999;
};

struct NamingReport {
  std::size_t named = 0, ambiguous = 0;
  Index nodes = 0;
  bool exhausted = false;
};

// Landmarks of the submap that the map knows get its ids for them; those that are near one of the map's and found no
// pair are taken out of the submap; all others keep theirs, which the map may not have. The submap began at the map's
// base.
template <class Pose>
NamingReport name_landmarks(const GlobalMap<Pose>& map, const NamingOptions& options, Submap<Pose>& submap);

extern template NamingReport name_landmarks(const GlobalMap<SE2>&, const NamingOptions&, Submap<SE2>&);
extern template NamingReport name_landmarks(const GlobalMap<SE3>&, const NamingOptions&, Submap<SE3>&);

}  // namespace cairn
