// SPDX-License-Identifier: BSD-3-Clause
// The filter of one vehicle, with its memory and its radar.
#pragma once

#include <vector>

#include "core/arena.hpp"
#include "sensor/range_bearing.hpp"
#include "slam/filter.hpp"

namespace cairn {

constexpr int kRadarSensor = 0;

class VehicleFilter {
 public:
  VehicleFilter(const FilterOptions<SE2>& options, std::uint64_t vehicle, const RangeBearingParameters& radar);

  Filter<SE2>& filter() { return filter_; }
  const Filter<SE2>& filter() const { return filter_; }

  // Updates the filter by one scan of a sensor: landmarks, then sightings of companions. Throws with nothing changed.
  void update(int sensor, const std::vector<Observation>& landmarks, const std::vector<Observation>& vehicles);

 private:
  Arena arena_;
  Filter<SE2> filter_;
  std::vector<Observation> scan_;  // landmarks, then vehicles
};

}  // namespace cairn
