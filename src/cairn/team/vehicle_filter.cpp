// SPDX-License-Identifier: BSD-3-Clause
#include "team/vehicle_filter.hpp"

#include <algorithm>

namespace cairn {

VehicleFilter::VehicleFilter(const FilterOptions<SE2>& options, std::uint64_t vehicle,
                             const RangeBearingParameters& radar)
    : arena_(Filter<SE2>::arena_bytes(options)),
      filter_(arena_, options),
      scan_(static_cast<std::size_t>(options.max_observations)) {
  filter_.name_vehicle(vehicle);
  filter_.add(RangeBearing(radar));  // kRadarSensor
}

void VehicleFilter::update(int sensor, const std::vector<Observation>& landmarks,
                           const std::vector<Observation>& vehicles) {
  const std::size_t count = landmarks.size() + vehicles.size();
  if (count > scan_.size())
    throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %zu", count, scan_.size());
  std::copy(vehicles.begin(), vehicles.end(), std::copy(landmarks.begin(), landmarks.end(), scan_.begin()));
  filter_.update(sensor, scan_.data(), static_cast<Index>(landmarks.size()), static_cast<Index>(vehicles.size()));
}

}  // namespace cairn
