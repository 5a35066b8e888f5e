// SPDX-License-Identifier: BSD-3-Clause
// The fleet behind cairn/fleet.h: all boats, period by period.
#pragma once

#include <cairn/fleet.h>

#include <vector>

#include "geometry/se2.hpp"
#include "sim/fleet_scene.hpp"
#include "sim/random.hpp"

namespace cairn::sim {

class Fleet {
 public:
  // `options` are checked already. Throws Error where they contradict each other.
  explicit Fleet(const cairn_fleet_options& options);

  const FleetScene& scene() const { return scene_; }
  std::size_t steps() const { return steps_; }

  // Throws Error (state) after the last step.
  void next(cairn_fleet_step& step);
  void rewind();

 private:
  SE2 moved(const SE2& T_map_boat, std::size_t boat) const;
  void look(std::size_t boat);
  void see(const Vector2& place, std::size_t boat, std::uint64_t id, Stream stream);

  cairn_fleet_options options_;
  FleetScene scene_;
  std::size_t steps_;
  double speed_, rate_;  // commanded

  std::size_t step_ = 0;                         // to be handed out next
  std::vector<SE2> poses_, moved_;               // T_map_boat at the step before, and at the one in the making
  std::vector<cairn_fleet_vehicle> vehicles_;    // handed out
  std::vector<cairn_fleet_sighting> sightings_;  // of all boats, one after the other
};

}  // namespace cairn::sim
