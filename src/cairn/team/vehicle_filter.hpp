// SPDX-License-Identifier: BSD-3-Clause
// The filter of one vehicle, with its memory and its radar.
#pragma once

#include <vector>

#include "core/arena.hpp"
#include "sensor/range_bearing.hpp"
#include "slam/filter.hpp"

namespace cairn {

constexpr int kRadarSensor = 0;

// Observations of landmarks, then sightings of companions.
struct Scan {
  explicit Scan(const std::vector<Observation>& all) : landmarks(all.data()), landmark_count(all.size()) {}
  Scan(const Observation* first, std::size_t count, const std::vector<Observation>& companions)
      : landmarks(first), landmark_count(count), vehicles(companions.data()), vehicle_count(companions.size()) {}

  const Observation* landmarks;
  std::size_t landmark_count;
  const Observation* vehicles = nullptr;
  std::size_t vehicle_count = 0;
};

class VehicleFilter {
 public:
  VehicleFilter(const FilterOptions<SE2>& options, std::uint64_t vehicle, const RangeBearingParameters& radar);

  Filter<SE2>& filter() { return filter_; }
  const Filter<SE2>& filter() const { return filter_; }

  // Updates the filter by one scan of a sensor. Throws with nothing changed.
  void update(int sensor, const Scan& scan);

 private:
  Arena arena_;
  Filter<SE2> filter_;
  std::vector<Observation> scan_;  // landmarks, then vehicles
};

}  // namespace cairn
