// SPDX-License-Identifier: BSD-3-Clause
// The fleet behind cairn/fleet.h: moves all boats and makes their sightings, period by period.
#pragma once

#include <cairn/fleet.h>

#include <vector>

#include "geometry/se2.hpp"
#include "sim/fleet_scene.hpp"
#include "sim/random.hpp"

namespace cairn::sim {

class Fleet {
 public:
  // The fields of `options` have been checked. Throws Error if they contradict each other.
  explicit Fleet(const cairn_fleet_options& options);

  const FleetScene& scene() const { return scene_; }
  std::size_t steps() const { return steps_; }

  // Throws Error (state) after the last step.
  void next(cairn_fleet_step& step);
  void rewind();
  bool started() const { return step_ > 0; }
  // After a step: the boats, and the sightings of one of them, features first, then other boats.
  const std::vector<cairn_fleet_vehicle>& vehicles() const { return vehicles_; }
  const cairn_fleet_sighting* features_of(std::size_t boat) const;
  const cairn_fleet_sighting* vehicles_of(std::size_t boat) const {
    return features_of(boat) + vehicles_[boat].feature_count;
  }

 private:
  SE2 moved(const SE2& T_map_boat, std::size_t boat) const;
  void look(std::size_t boat);
  void see(const Vector2& place, std::size_t boat, std::uint64_t id, Stream stream);

  cairn_fleet_options options_;
  FleetScene scene_;
  std::size_t steps_;
  double speed_, rate_;  // commanded

  std::size_t step_ = 0;                         // number of the next step
  std::vector<SE2> poses_, moved_;               // T_map_boat at the last step, and at the step that is being made
  std::vector<cairn_fleet_vehicle> vehicles_;    // handed out to the caller
  std::vector<cairn_fleet_sighting> sightings_;  // of all boats, one boat after the other
};

}  // namespace cairn::sim
